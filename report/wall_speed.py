# SPDX-License-Identifier: BSD-3-Clause
"""Radial speed of a driven wall at a fixed place of the axis, as a streak camera sees it: from tracers along the wall.

The slope dR/dt of the wall at the place is not the radial velocity of the material there, which moves along the axis, too.
"""
import csv
import math

WINDOW = 0.6e-3  # m of travel on either side of the wanted one: a polygon through particles is rough


def interpolate(x, xs, ys):
    """Value at x of the polygon through the points (xs, ys), xs ascending; NaN beyond its ends."""
    for a, b, u, v in zip(xs, xs[1:], ys, ys[1:]):
        if a <= x <= b:
            return u + (v - u) * (x - a) / (b - a) if b > a else u
    return math.nan


def path_of_wall(path, tracers, place):
    """Times and radii (s, m) of the wall at a place of the x axis (m), from gauges.csv of a run."""
    with path.open(newline="") as stream:
        rows = [{head.split(" [")[0]: cell for head, cell in row.items()} for row in csv.DictReader(stream)]
    names = sorted({head.split(".")[0] for head in rows[0] if head.startswith(f"{tracers}_")}) if rows else []
    times, radii = [], []
    for row in rows:
        places = sorted((x, y) for x, y in ((float(row[f"{name}.x"]), float(row[f"{name}.y"])) for name in names)
                        if math.isfinite(x) and math.isfinite(y))  # tracers that have left the domain have no place
        radius = interpolate(place, [x for x, _ in places], [y for _, y in places])
        if math.isfinite(radius):
            times.append(float(row["time"]))
            radii.append(radius)
    return times, radii


def wall_speed(path, tracers, place, travel):
    """dR/dt (m/s) where the wall has moved outwards by `travel` (m) at the place; NaN if it does not, or no tracer is there."""
    if not path.is_file():
        return math.nan
    times, radii = path_of_wall(path, tracers, place)
    if not radii:
        return math.nan
    reached = [interpolate(radii[0] + travel + way, radii, times) for way in (-WINDOW, WINDOW)]
    return 2 * WINDOW / (reached[1] - reached[0]) if all(map(math.isfinite, reached)) else math.nan
