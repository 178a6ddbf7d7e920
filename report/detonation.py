# SPDX-License-Identifier: BSD-3-Clause
"""Measures of detonations and jets: deviation from an exact profile, speed of a front, speed of a jet."""
import csv
import json
import math
import statistics
import tomllib

from report.wall_speed import interpolate


def snapshot_at(folder, time=math.inf):
    """Name of the file with the particles at the last snapshot of a run until a time (s), and its time; None without any."""
    series = sorted(folder.glob("*.particles.hdf.series"))
    files = json.loads(series[0].read_text())["files"] if series else []
    until = [(float(entry["time"]), entry["name"]) for entry in files if float(entry["time"]) <= time * (1.0 + 1e-6)]
    if not until:
        return None
    newest, name = max(until)
    return name, newest


def particles_of(folder, body, time=math.inf):
    """Fields of the particles of a body at the last snapshot until a time (s) and, as "position" and "x", their places (m); None
    without any.
    """
    from report.files import open_hdf5

    newest = snapshot_at(folder, time)
    if newest is None or not (folder / "run.toml").is_file():
        return None
    bodies = [entry["name"] for entry in tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["body"]]
    if body not in bodies:
        return None
    with open_hdf5(folder / newest[0]) as file:
        data = file["VTKHDF"]["PointData"]
        own = data["body"][:] == bodies.index(body)
        places = file["VTKHDF"]["Points"][:][own]
        return {name: data[name][:][own] for name in data} | {"position": places, "x": places[:, 0]}


def profile(path, field):
    """Places (m), ascending, and values of a field in a table of an exact solution: columns "x [m]" and "FIELD [UNIT]"."""
    with path.open(newline="") as stream:
        lines = [line for line in stream if not line.startswith("#")]
    rows = [{head.split(" [")[0]: float(cell) for head, cell in row.items()} for row in csv.DictReader(lines)]
    return [row["x"] for row in rows], [row[field] for row in rows]


def profile_error(folder, body, field, table):
    """Sum of m |f - f_exact| over that of m |f_exact|, of the particles of a body at the last snapshot, m their mass, within the
    places of the table: of a field of equal cells of a Lagrangian code the L1 error. Of a velocity its component along x. NaN
    where there is none.
    """
    import numpy as np

    found = particles_of(folder, body)
    if found is None or field not in found:
        return math.nan
    places, exact = profile(table, field)
    own = (found["x"] >= places[0]) & (found["x"] <= places[-1])
    value = found[field][own, 0] if found[field].ndim > 1 else found[field][own]
    mass = found["mass"][own]
    wanted = np.interp(found["x"][own], places, exact)
    scale = (mass * np.abs(wanted)).sum()
    return float((mass * np.abs(value - wanted)).sum() / scale) if scale > 0.0 else math.nan


def arrivals(path, tracers, fraction):
    """Times (s) and places (m) at which a front passes moving tracers along x, in the order of the places, from gauges.csv:
    when the pressure of each first exceeds a fraction of the median of what they reach, and where they began.
    """
    if not path.is_file():
        return []
    with path.open(newline="") as stream:
        rows = [{head.split(" [")[0]: float(cell or math.nan) for head, cell in row.items()} for row in csv.DictReader(stream)]
    names = sorted({head.split(".")[0] for head in rows[0] if head.startswith(f"{tracers}_")}) if rows else []
    of_tracer = {name: [row[f"{name}.pressure"] for row in rows] for name in names}
    level = fraction * statistics.median(max(pressures) for pressures in of_tracer.values()) if names else 0.0
    passed = []
    for name, pressures in of_tracer.items():
        first = next((i for i, p in enumerate(pressures) if p > level), 0)
        if level > 0.0 and first > 0:
            time = interpolate(level, pressures[first - 1:first + 1], [row["time"] for row in rows[first - 1:first + 1]])
            passed.append((time, rows[0][f"{name}.x"]))
    return sorted(passed, key=lambda arrival: arrival[1])


def arrival_speed(path, tracers):
    """Speed (m/s) along x of a front that passes moving tracers: slope by least squares of the places where they began over
    the times at which the pressure of each first exceeds half of the median of what they reach.
    """
    passed = arrivals(path, tracers, 0.5)
    if len(passed) < 3:
        return math.nan
    middle, centre = (sum(values) / len(passed) for values in zip(*passed))
    return sum((t - middle) * (x - centre) for t, x in passed) / sum((t - middle) ** 2 for t, _ in passed)


def run_distance(path, tracers, start):
    """Distance (m) from the place `start`, where a shock enters an explosive, to where it has become a detonation: there the
    front, which speeds up, passes from tracer to tracer faster than the mean of its least speed and of that over the last
    quarter of the tracers. NaN if its last speed is not a quarter above the least, as it is where nothing detonates.
    """
    passed = arrivals(path, tracers, 0.05)
    if len(passed) < 8:
        return math.nan
    speeds = [(b[1] - a[1]) / (b[0] - a[0]) if b[0] > a[0] else math.inf for a, b in zip(passed, passed[2:])]
    places = [after[1] for after in passed[1:-1]]
    quarter = passed[-(len(passed) // 4) - 1:]
    last, least = (quarter[-1][1] - quarter[0][1]) / (quarter[-1][0] - quarter[0][0]), min(speeds)
    if not last > 1.25 * least:
        return math.nan
    middle = 0.5 * (last + least)
    after_least = speeds.index(least)
    found = next((i for i in range(after_least, len(speeds)) if speeds[i] >= middle), None)
    if found is None:
        return math.nan
    if found == after_least:
        return places[found] - start
    return interpolate(middle, speeds[found - 1:found + 1], places[found - 1:found + 1]) - start


def peak_of_gauge(path, column):
    """Largest value of a column of gauges.csv and the time (s) at which it first comes half way to it from where it began; NaN
    without it."""
    if not path.is_file():
        return math.nan, math.nan
    with path.open(newline="") as stream:
        rows = [{head.split(" [")[0]: float(cell or math.nan) for head, cell in row.items()} for row in csv.DictReader(stream)]
    values = [row.get(column, math.nan) for row in rows]
    found = [value for value in values if math.isfinite(value)]
    if not found:
        return math.nan, math.nan
    half = 0.5 * (found[0] + max(found))
    return max(found), next(row["time"] for row, value in zip(rows, values) if value >= half)


def jet_speed(folder, body, fraction):
    """Velocity along x (m/s) that a fraction of the mass of a body exceeds at the last snapshot, of what is left of it."""
    found = particles_of(folder, body)
    if found is None or len(found["mass"]) == 0:
        return math.nan
    order = found["velocity"][:, 0].argsort()[::-1]
    reached = found["mass"][order].cumsum() >= fraction * found["mass"].sum()
    return float(found["velocity"][order[reached.argmax()], 0])


def jet_gap(folder, body, fraction):
    """Fraction of the cells along x that hold none of a body, over the length of its jet at the last snapshot: what is faster than a
    quarter of the speed that a fraction of its mass exceeds, less this fraction, which is ahead of the rest.
    """
    import numpy as np

    found, tip = particles_of(folder, body), jet_speed(folder, body, fraction)
    if math.isnan(tip):
        return math.nan
    cell = float(tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["domain"]["cell_size"].split()[0])
    order = found["x"].argsort()[::-1]
    behind = found["mass"][order].cumsum() >= fraction * found["mass"].sum()
    own = order[behind & (found["velocity"][order, 0] >= 0.25 * tip)]
    cells = np.unique(np.floor(found["x"][own] / cell))
    return float(1.0 - len(cells) / (cells[-1] - cells[0] + 1.0))


def jet_fraction(folder, body, time, speed):
    """Fraction of the jet in the mass of a body that turns into jet and slug between a time (s) and the last snapshot: of what loses
    half of its initial velocity along y, towards the plane of symmetry, what moves along x faster than a speed (m/s), that of
    the place where the flow parts. Differences of masses: how the jet began does not count. NaN where nothing turns.
    """
    before, after = particles_of(folder, body, time), particles_of(folder, body)
    if before is None or after is None:
        return math.nan
    entries = tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["body"]
    towards = float(next(entry["velocity"][1] for entry in entries if entry["name"] == body).split()[0])

    def jet_and_turned(found):
        jet, turned = found["velocity"][:, 0] > speed, abs(found["velocity"][:, 1]) < 0.5 * abs(towards)
        return found["mass"][jet].sum(), found["mass"][turned].sum()

    (jet_0, turned_0), (jet_1, turned_1) = jet_and_turned(before), jet_and_turned(after)
    return float((jet_1 - jet_0) / (turned_1 - turned_0)) if turned_1 > turned_0 else math.nan
