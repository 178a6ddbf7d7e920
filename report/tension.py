# SPDX-License-Identifier: BSD-3-Clause
"""Measures of tests of fracture, as the laboratory takes them: of a bar that is pulled from its plane of symmetry, x = 0, and
of a plate that a punch shears between itself and a die, which lies at a plane.

Force: of the plane on the bar (history.csv). Section: moving tracers from the axis to the surface, in the plane (gauges.csv).
The bar is torn when the force over the section that is left has fallen to half of its greatest value: in a deep neck the
force alone falls as far without a crack.
"""
import csv
import math
import re

from report.expectations import BadExpectation

AVERAGE = 4e-6  # s over which the force is a mean: a few passages of sound over a bar of centimetres


def columns(path, wanted=lambda name: True):
    """Columns of a table by their names without units, of those that are wanted."""
    if not path.is_file():
        return {}
    with path.open(newline="") as stream:
        rows = csv.reader(stream)
        places = [(i, name) for i, name in enumerate(head.split(" [")[0] for head in next(rows, [])) if wanted(name)]
        table = {name: [] for _, name in places}
        for row in rows:
            for i, name in places:
                table[name].append(float(row[i] or math.nan))
    return table


def at(time, times, values):
    """Value at a time, linear between the rows, that of the first or last beyond them."""
    if time <= times[0]:
        return values[0]
    for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:]):
        if time <= t1:
            return v0 + (v1 - v0) * (time - t0) / (t1 - t0) if t1 > t0 else v1
    return values[-1]


def forces(folder):
    """Times (s) and force of the plane on the bodies along -x (N), means over `AVERAGE`: pull of x = 0, push of x_upper."""
    history = columns(folder / "history.csv", lambda name: name in ("time", "wall_impulse_x"))
    times, impulses = history.get("time", []), history.get("wall_impulse_x", [])
    if not times or not impulses:
        return [], []
    edges = [AVERAGE * i for i in range(int(times[-1] / AVERAGE) + 1)]
    reached, row = [], 0
    for edge in edges:
        while row + 1 < len(times) and times[row + 1] < edge:
            row += 1
        reached.append(at(edge, times[row:row + 2], impulses[row:row + 2]))
    return ([0.5 * (a + b) for a, b in zip(edges, edges[1:])],
            [-(b - a) / AVERAGE for a, b in zip(reached, reached[1:])])


def section_of(folder, tracers):
    """Columns of gauges.csv, and the names of the tracers from the axis outwards."""
    table = columns(folder / "gauges.csv")
    names = [head[:-2] for head in table if re.fullmatch(re.escape(tracers) + r"_\d+\.y", head)]
    return table, sorted(names, key=lambda name: int(name.rpartition("_")[2]))


def time_of_rupture(folder, tracers):
    """When the pull over the section of the tracers has fallen to half of its greatest value; NaN if it never does."""
    table, names = section_of(folder, tracers)
    times, pulls = forces(folder)
    if not names or not pulls:
        return math.nan
    radii = table[f"{names[-1]}.y"]
    stresses = [pull / at(time, table["time"], radii) ** 2 for time, pull in zip(times, pulls)]
    greatest = stresses.index(max(stresses))
    return next((t for t, s in zip(times[greatest:], stresses[greatest:]) if s < 0.5 * stresses[greatest]), math.nan)


def neck_strain(folder, tracers):
    """ln(A0/A) of the section when the bar is torn."""
    table, names = section_of(folder, tracers)
    torn = time_of_rupture(folder, tracers)
    if not math.isfinite(torn):
        return math.nan
    radii = table[f"{names[-1]}.y"]
    return 2 * math.log(radii[0] / at(torn, table["time"], radii))


def elongation(folder, tracers, mark):
    """Relative elongation between the plane and a moving gauge when the bar is torn."""
    table, _ = section_of(folder, tracers)
    torn = time_of_rupture(folder, tracers)
    places = table.get(f"{mark}.x", [])
    return at(torn, table["time"], places) / places[0] - 1 if places and math.isfinite(torn) else math.nan


def first_failure(table, names):
    """Row and name of the tracer that fails first; None if none does."""
    found = [(next((i for i, f in enumerate(table[f"{name}.failed_fraction"]) if f > 0.5), None), name) for name in names]
    return min((f for f in found if f[0] is not None), default=None)


def failure_strain(folder, tracers):
    """Equivalent plastic strain of the point of the section that fails first, at its failure."""
    table, names = section_of(folder, tracers)
    found = first_failure(table, names)
    return table[f"{found[1]}.plastic_strain"][found[0]] if found else math.nan


def failure_triaxiality(folder, tracers):
    """Mean over equivalent stress of that point, averaged over its plastic strain."""
    table, names = section_of(folder, tracers)
    found = first_failure(table, names)
    if not found:
        return math.nan
    row, name = found
    xx, yy, zz, xy, yz, zx = (table[f"{name}.stress_{c}"] for c in ("xx", "yy", "zz", "xy", "yz", "zx"))
    strain, total = table[f"{name}.plastic_strain"], 0.0
    for i in range(1, row):
        mean = (xx[i] + yy[i] + zz[i]) / 3
        shear = xy[i] ** 2 + yz[i] ** 2 + zx[i] ** 2
        equivalent = math.sqrt(1.5 * ((xx[i] - mean) ** 2 + (yy[i] - mean) ** 2 + (zz[i] - mean) ** 2 + 2 * shear))
        total += (strain[i] - strain[i - 1]) * (mean / equivalent if equivalent > 0 else 0.0)
    reached = strain[max(row - 1, 0)]
    return total / reached if reached > 0 else math.nan


def peak_stress(folder, radius):
    """Greatest pull over the area that the section has at first (Pa)."""
    _, pulls = forces(folder)
    return max(pulls, default=math.nan) / (math.pi * radius**2)


def shear_strength(folder, radius, thickness):
    """Greatest force on the die over the area of the cut through the plate, 2 pi R t (Pa)."""
    return max(forces(folder)[1], default=math.nan) / (2 * math.pi * radius * thickness)


def shear_stroke(folder, mark, thickness):
    """Path of the punch over the thickness when the force has fallen to half of its greatest value; NaN if it never does."""
    times, pushes = forces(folder)
    table = columns(folder / "gauges.csv", lambda name: name in ("time", f"{mark}.x"))
    if not pushes or not table.get(f"{mark}.x"):
        return math.nan
    greatest = pushes.index(max(pushes))
    cut = next((t for t, push in zip(times[greatest:], pushes[greatest:]) if push < 0.5 * pushes[greatest]), math.nan)
    places = table[f"{mark}.x"]
    return (at(cut, table["time"], places) - places[0]) / thickness if math.isfinite(cut) else math.nan


def measure(name, folder, place, travel=None):
    """The measure `name`: KIND.TRACERS, elongation.TRACERS.GAUGE, or, of a punch with a gauge, shear_strength.GAUGE and
    shear_stroke.GAUGE. BadExpectation: it names no tracers or gauge, or none that are there."""
    kind, *of = name.split(".")
    of_gauge = kind in ("shear_strength", "shear_stroke")
    if len(of) != (2 if kind == "elongation" else 1):
        raise BadExpectation(f"measure {name!r}: expected {kind}."
                             f"{'TRACERS.GAUGE' if kind == 'elongation' else 'GAUGE' if of_gauge else 'TRACERS'}")
    if kind == "peak_stress":
        return peak_stress(folder, place)
    table, names = section_of(folder, of[0])
    needed = [(of[-1], f"{of[-1]}.x" in table)] if of_gauge or kind == "elongation" else []
    for part, there in needed + ([] if of_gauge else [(f"{of[0]}_1, {of[0]}_2, ...", names)]):
        if table and not there:
            raise BadExpectation(f"measure {name!r}: {folder / 'gauges.csv'} has no {part}")
    if kind == "shear_strength":
        return shear_strength(folder, place, travel)
    if kind == "shear_stroke":
        return shear_stroke(folder, of[0], travel)
    return {"elongation": elongation, "neck_strain": neck_strain, "failure_strain": failure_strain,
            "failure_triaxiality": failure_triaxiality}[kind](folder, *of)


KINDS = ("peak_stress", "elongation", "neck_strain", "failure_strain", "failure_triaxiality", "shear_strength", "shear_stroke")
