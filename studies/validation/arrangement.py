# SPDX-License-Identifier: BSD-3-Clause
"""The bodies of a case at its start as a section, drawn from the case file alone: which body fills which point of a plane
through the domain. Shapes as in docs/manual/input_reference.md; distances in m."""
import math
import re
import tomllib
from dataclasses import dataclass

import numpy as np

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "km": 1e3}
ANGLES = {"rad": 1.0, "deg": math.pi / 180, "degree": math.pi / 180}
NONE = -1  # no body
COLUMNS = 240  # points across the picture
SMALL = 1e-9  # of the domain: beside a mirror plane, not on it


class Unknown(Exception):
    """Name a shape that is not drawn."""


def number(text, units=LENGTHS):
    """Return the value in SI of "3 mm"; a bare number is itself."""
    if isinstance(text, (int, float)):
        return float(text)
    value, unit = re.fullmatch(r"\s*([-+.\deE]+)\s*(\S*)\s*", text).groups()
    return float(value) * units[unit or next(iter(units))]


def vector(values):
    """Return three lengths; a section has two, at z = 0."""
    return [number(value) for value in values] + [0.0] * (3 - len(values))


def along(shape, points, base):
    """Return height above the base along the axis, and distance from it."""
    axis = "xyz".index(shape["axis"])
    offset = [p - b for p, b in zip(points, base)]
    return offset[axis], np.hypot(*(offset[i] for i in range(3) if i != axis))


def sphere(shape, points):
    return sum((p - c) ** 2 for p, c in zip(points, vector(shape["center"]))) <= number(shape["radius"]) ** 2


def box(shape, points):
    lower, upper = (list(map(number, shape[key])) for key in ("lower", "upper"))
    return np.logical_and.reduce([(a <= x) & (x <= b) for a, x, b in zip(lower, points, upper)])


def cylinder(shape, points):
    height, radius = along(shape, points, vector(shape["center"]))
    return (abs(height) <= number(shape["height"]) / 2) & (radius <= number(shape["radius"]))


def tube(shape, points):
    height, radius = along(shape, points, vector(shape["base"]))
    return ((0 <= height) & (height <= number(shape["height"])) & (number(shape["inner_radius"]) <= radius)
            & (radius <= number(shape["outer_radius"])))


def cone(shape, points):
    height, radius = along(shape, points, vector(shape["base"]))
    part = height / number(shape["height"])
    return (0 <= part) & (part <= 1) & (radius <= (1 - part) * number(shape["base_radius"]) + part * number(shape.get("top_radius", 0)))


def ogive(shape, points):
    height, radius = along(shape, points, vector(shape["base"]))
    shank, nose, wide = (number(shape[key]) for key in ("shank_length", "nose_length", "radius"))
    arc = (wide**2 + nose**2) / (2 * wide)  # radius of the arc, tangent to the shank
    tip = np.sqrt(np.maximum(arc**2 - (height - shank) ** 2, 0)) - (arc - wide)
    return (0 <= height) & (height <= shank + nose) & (radius <= np.where(height > shank, tip, wide))


def half_space(shape, points):
    return sum(n * (x - p) for n, x, p in zip(shape["normal"], points, vector(shape["point"]))) <= 0


def difference(shape, points):
    return inside(shape["from"], points) & ~np.logical_or.reduce([inside(other, points) for other in shape["minus"]])


def moved(shape, points):
    """Undo the translation and the turn about an axis through the origin (Rodrigues)."""
    x = [p - t for p, t in zip(points, vector(shape.get("translation", [0, 0, 0])))]
    size = math.hypot(*shape["axis"])
    n, angle = [a / size for a in shape["axis"]], -number(shape["angle"], ANGLES)
    cross = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]]
    dot = sum(a * b for a, b in zip(n, x))
    turned = [a * math.cos(angle) + c * math.sin(angle) + m * dot * (1 - math.cos(angle)) for a, c, m in zip(x, cross, n)]
    return inside(shape["shape"], turned)


SHAPES = {"sphere": sphere, "box": box, "cylinder": cylinder, "tube": tube, "cone": cone, "ogive": ogive,
          "half_space": half_space, "difference": difference, "moved": moved,
          "union": lambda shapes, points: np.logical_or.reduce([inside(shape, points) for shape in shapes])}


def inside(shape, points):
    """Return which points are in a shape. @raises Unknown"""
    (kind, keys), = shape.items()
    if kind not in SHAPES:
        raise Unknown(kind)
    return SHAPES[kind](keys, points)


@dataclass(frozen=True)
class Section:
    """Hold what a picture shows: names of the bodies, size in m, and rectangles (body, x, y, width, height) in cells of it."""
    bodies: list
    axes: str
    width: float
    height: float
    cells: tuple
    rectangles: list


def plane_of(domain):
    """Return (horizontal axis, vertical axis, point of the plane): across the shortest side of the domain, y first."""
    lower, upper = (vector(domain[key]) for key in ("lower", "upper"))
    sides = [b - a for a, b in zip(lower, upper)]
    across = 2 if len(domain["lower"]) == 2 else min((1, 0, 2), key=lambda i: sides[i])
    rest = sorted((i for i in range(3) if i != across), key=lambda i: -sides[i])
    if sides[rest[0]] == sides[rest[1]]:
        rest.sort()
    at = [0.0, 0.0, 0.0]
    if sides[across] > 0:
        middle = 0.0 if lower[across] <= 0 <= upper[across] else (lower[across] + upper[across]) / 2
        at[across] = min(max(middle, lower[across] + SMALL * sides[across]), upper[across] - SMALL * sides[across])
    return rest[0], rest[1], at


def section(path):
    """Return the section of a case file. @raises Unknown"""
    case = tomllib.loads(path.read_text(encoding="utf-8"))
    domain = case["domain"]
    bodies = [body for body in case["body"] if "shape" in body]  # others are bars, or what a mesh file holds
    lower, upper = (vector(domain[key]) for key in ("lower", "upper"))
    u, v, at = plane_of(domain)
    width, height = upper[u] - lower[u], upper[v] - lower[v]
    rows = max(round(COLUMNS * height / width), 1)
    across = lower[u] + (np.arange(COLUMNS) + 0.5) * width / COLUMNS
    points = [np.full((rows, COLUMNS), x) for x in at]
    points[u] = np.broadcast_to(across, (rows, COLUMNS))
    points[v] = np.broadcast_to((upper[v] - (np.arange(rows) + 0.5) * height / rows)[:, None], (rows, COLUMNS))
    fills = np.full((rows, COLUMNS), NONE)
    for k in reversed(range(len(bodies))):
        fills[inside(bodies[k]["shape"], points)] = k
    rectangles = merged([runs(line) for line in fills.tolist()])
    return Section([body["name"] for body in bodies], "xyz"[u] + "xyz"[v], width, height, (COLUMNS, rows), rectangles)


def runs(line):
    """Return {(first, count, body)} of the points of a line that a body fills."""
    found, begin = set(), 0
    for i in range(1, len(line) + 1):
        if i == len(line) or line[i] != line[begin]:
            if line[begin] != NONE:
                found.add((begin, i - begin, line[begin]))
            begin = i
    return found


def merged(lines):
    """Return rectangles of the runs that lines have in common."""
    rectangles, open_ = [], {}
    for j, line in enumerate([*lines, set()]):
        for run in [run for run in open_ if run not in line]:
            first, count, body = run
            rectangles.append((body, first, open_[run], count, j - open_.pop(run)))
        for run in line - open_.keys():
            open_[run] = j
    return sorted(rectangles)
