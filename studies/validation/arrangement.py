# SPDX-License-Identifier: BSD-3-Clause
"""The bodies of a case at its start as a section, drawn from the case file alone: which body fills which point of a plane
through the domain. Shapes as in docs/manual/input_reference.md; distances in m. Bodies of other files than label images,
generated ones and bars are named instead."""
import gzip
import math
import pathlib
import re
import tomllib
from dataclasses import dataclass

import numpy as np

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "micron": 1e-6, "nm": 1e-9, "km": 1e3, "inch": 0.0254, "in": 0.0254,
           "mil": 2.54e-5, "ft": 0.3048, "foot": 0.3048}
ANGLES = {"rad": 1.0, "radian": 1.0, "deg": math.pi / 180, "degree": math.pi / 180, "degrees": math.pi / 180}
NONE = -1  # no body
COLUMNS = 240  # points across the picture
MOST_COPIES = 1000  # of an array: more are finer than the picture
SMALL = 1e-9  # of the domain: beside a mirror plane, not on it


class Unknown(Exception):
    """Tell what of a body is not drawn."""


def number(text, units=LENGTHS):
    """Return the value in SI of "3 mm"; a bare number is itself. @raises Unknown"""
    if isinstance(text, (int, float)):
        return float(text)
    found = re.fullmatch(r"\s*([-+.\d]+(?:[eE][-+]?\d+)?)\s*(\S*)\s*", text)
    unit = (found[2] or next(iter(units))) if found else None
    if unit not in units:
        raise Unknown(f'the quantity "{text}"')
    return float(found[1]) * units[unit]


def vector(values):
    """Return three lengths; a section has two, at z = 0."""
    return [number(value) for value in values] + [0.0] * (3 - len(values))


def minus(points, place):
    return [x - p for x, p in zip(points, place)]


def ahead(shape, points):
    """Return height above the base along the axis, and the coordinates along the two axes behind it: of z, x and y."""
    axis = "xyz".index(shape.get("axis", "z"))
    offset = minus(points, vector(shape["base"]))
    return offset[axis], offset[(axis + 1) % 3], offset[(axis + 2) % 3]


def along(shape, points, base):
    """Return height above the base along the axis, and distance from it."""
    axis = "xyz".index(shape.get("axis", "z"))
    offset = minus(points, base)
    return offset[axis], np.hypot(*(offset[i] for i in range(3) if i != axis))


def in_polygon(first, second, x, y):
    """Return the points from which a ray crosses the boundary an odd number of times."""
    found = np.zeros(np.shape(x), dtype=bool)
    corners = list(zip(map(number, first), map(number, second)))
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        if ay != by:
            found ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    return found


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
    shank, nose, wide = number(shape.get("shank_length", 0.0)), number(shape["nose_length"]), number(shape["radius"])
    arc = (wide**2 + nose**2) / (2 * wide)  # radius of the arc, tangent to the shank
    tip = np.sqrt(np.maximum(arc**2 - (height - shank) ** 2, 0)) - (arc - wide)
    return (0 <= height) & (height <= shank + nose) & (radius <= np.where(height > shank, tip, wide))


def half_space(shape, points):
    return sum(n * x for n, x in zip(shape["normal"], minus(points, vector(shape["point"])))) <= 0


def prism(shape, points):
    height, x, y = ahead(shape, points)
    sector = 2 * math.pi / shape["sides"]
    angle = np.arctan2(y, x)
    from_face = angle - sector * np.round(angle / sector)
    return (0 <= height) & (height <= number(shape["height"])) & (np.hypot(x, y) * np.cos(from_face) <= number(shape["inner_radius"]))


def extrude(shape, points):
    height, x, y = ahead(shape, points)
    return (0 <= height) & (height <= number(shape["height"])) & in_polygon(shape["first"], shape["second"], x, y)


def revolve(shape, points):
    height, radius = along(shape, points, vector(shape["base"]))
    return in_polygon(shape["radius"], shape["along"], radius, height)


def difference(shape, points):
    return inside(shape["from"], points) & ~np.logical_or.reduce([inside(other, points) for other in shape["minus"]])


def intersection(shapes, points):
    return np.logical_and.reduce([inside(shape, points) for shape in shapes])


def union(shapes, points):
    return np.logical_or.reduce([inside(shape, points) for shape in shapes])


def moved(shape, points):
    """Undo the translation and the turn about an axis through the centre (Rodrigues)."""
    center = vector(shape.get("center", []))
    x = minus(minus(points, vector(shape.get("translation", []))), center)
    axis = shape.get("axis", [0.0, 0.0, 1.0])
    size = math.hypot(*axis)
    n, angle = [a / size for a in axis], -number(shape.get("angle", 0.0), ANGLES)
    cross = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]]
    dot = sum(a * b for a, b in zip(n, x))
    return inside(shape["shape"], [a * math.cos(angle) + c * math.sin(angle) + m * dot * (1 - math.cos(angle)) + o
                                   for a, c, m, o in zip(x, cross, n, center)])


def scaled(shape, points):
    center = vector(shape.get("center", []))
    factors = [*shape["factors"], 1.0][:3]  # of a section two
    return inside(shape["shape"], [x / f + c for x, f, c in zip(minus(points, center), factors, center)])


def array(shape, points):
    if shape["count"] > MOST_COPIES:
        raise Unknown(f"array of {shape['count']}")
    step, found = vector(shape["step"]), False
    for i in range(shape["count"]):
        found = found | inside(shape["shape"], minus(points, [i * s for s in step]))
    return found


def labels(path):
    """Return the labels of an image by x, y, z, the position of the first and the edges of a voxel, in units of the image.
    Read NRRD with attached bytes along the axes, compressed or not. @raises ValueError"""
    head, _, data = pathlib.Path(path).read_bytes().partition(b"\n\n")
    keys = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line)
    if keys["type"] != "uint8" or keys["encoding"] not in ("raw", "gzip"):
        raise ValueError(f'an image of {keys["type"]}, {keys["encoding"]}')
    sizes = [int(size) for size in keys["sizes"].split()]
    edges = np.array([[float(x) for x in row.split(",")] for row in re.findall(r"\(([^)]*)\)", keys["space directions"])])
    if np.count_nonzero(edges - np.diag(np.diag(edges))):
        raise ValueError("an image across the axes")
    values = np.frombuffer(gzip.decompress(data) if keys["encoding"] == "gzip" else data, dtype=np.uint8)
    origin = [float(x) for x in keys["space origin"].strip("()").split(",")]
    return values.reshape(sizes, order="F"), origin, np.diag(edges)


def image(shape, points):
    values, origin, edges = labels(shape["file"])
    at = [np.rint((x / number(shape["unit"]) - o) / e).astype(int) for x, o, e in zip(points, origin, edges)]
    within = np.logical_and.reduce([(i >= 0) & (i < n) for i, n in zip(at, values.shape)])
    found = values[tuple(np.clip(i, 0, n - 1) for i, n in zip(at, values.shape))]
    return within & np.isin(found, shape["values"])


SHAPES = {"sphere": sphere, "box": box, "cylinder": cylinder, "tube": tube, "cone": cone, "ogive": ogive, "prism": prism,
          "half_space": half_space, "extrude": extrude, "revolve": revolve, "difference": difference,
          "intersection": intersection, "union": union, "moved": moved, "scaled": scaled, "array": array,
          "image": image}


def inside(shape, points):
    """Return which points are in a shape. @raises Unknown"""
    (kind, keys), = shape.items()
    if kind not in SHAPES:
        raise Unknown(kind)
    try:
        return SHAPES[kind](keys, points)
    except (LookupError, TypeError, ValueError, OSError) as fault:
        raise Unknown(f"{kind} with other keys ({fault})") from fault


def located(shape, folder):
    """Return a shape, or a part of one, with the paths of its files from that of the case."""
    if isinstance(shape, list):
        return [located(part, folder) for part in shape]
    if not isinstance(shape, dict):
        return shape
    return {key: str(folder / value) if key == "file" else located(value, folder) for key, value in shape.items()}


def filled(body, points):
    """Return which points a body fills. @raises Unknown"""
    if "shape" not in body:
        raise Unknown("bars" if "bar" in body else "mesh of a file")
    return inside(body["shape"], points)


@dataclass(frozen=True)
class Section:
    """Hold what a picture shows: names of the bodies, size in m, rectangles (body, x, y, width, height) in cells of it; and
    what it does not show, "name (kind)"."""
    bodies: list
    left_out: list
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
    """Return the section of a case file. @raises Unknown  if not even its domain is understood"""
    case = located(tomllib.loads(path.read_text(encoding="utf-8")), path.parent)
    domain = case["domain"]
    lower, upper = (vector(domain[key]) for key in ("lower", "upper"))
    u, v, at = plane_of(domain)
    width, height = upper[u] - lower[u], upper[v] - lower[v]
    rows = max(round(COLUMNS * height / width), 1)
    across = lower[u] + (np.arange(COLUMNS) + 0.5) * width / COLUMNS
    points = [np.full((rows, COLUMNS), x) for x in at]
    points[u] = np.broadcast_to(across, (rows, COLUMNS))
    points[v] = np.broadcast_to((upper[v] - (np.arange(rows) + 0.5) * height / rows)[:, None], (rows, COLUMNS))
    drawn, left_out = {}, []
    for body in case["body"]:
        try:
            drawn[body["name"]] = filled(body, points)
        except Unknown as why:
            left_out.append(f"{body['name']} ({why})")
    left_out += ["loads"] if "load" in case else []
    fills = np.full((rows, COLUMNS), NONE)
    for k, mask in reversed(list(enumerate(drawn.values()))):
        fills[mask] = k
    rectangles = merged([runs(line) for line in fills.tolist()])
    return Section(list(drawn), left_out, "xyz"[u] + "xyz"[v], width, height, (COLUMNS, rows), rectangles)


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
