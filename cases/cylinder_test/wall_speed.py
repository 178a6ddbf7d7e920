#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Print the radial speed dR/dt of the outer wall at a fixed place of the axis, as a streak camera sees it, where the
wall has moved by 6, 12.5 and 19 mm: from the gauges "wall_N" of a run of cylinder_test.

Usage: wall_speed.py RUN [PLACE_MM]
"""
import csv
import pathlib
import sys


def columns(path):
    """Numbers of a CSV file by the names of its columns, without units."""
    with path.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    return {name.split(" ")[0]: [float(row[name]) for row in rows] for name in rows[0]}


def interpolate(x, xs, ys):
    """Value at x of the polygon through the points (xs, ys), xs ascending; None beyond its ends."""
    for (a, b), (u, v) in zip(zip(xs, xs[1:]), zip(ys, ys[1:])):
        if a <= x <= b:
            return u + (v - u) * (x - a) / (b - a) if b > a else u
    return None


def wall(table, place):
    """(time, radius) of the wall at the place."""
    names = sorted({name.split(".")[0] for name in table if name.startswith("wall_")}, key=lambda n: int(n.split("_")[1]))
    path = []
    for i, time in enumerate(table["time"]):
        at = sorted((table[f"{name}.x"][i], table[f"{name}.y"][i]) for name in names)
        radius = interpolate(place, [x for x, _ in at], [y for _, y in at])
        if radius is not None:
            path.append((time, radius))
    return path


def main():
    """Print the speeds."""
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    place = 1e-3 * float(sys.argv[2]) if len(sys.argv) == 3 else 0.08
    path = wall(columns(pathlib.Path(sys.argv[1]) / "gauges.csv"), place)
    start = path[0][1]
    window = 0.6e-3  # m of travel on either side: a polygon of particles is rough
    for travel in (6e-3, 12.5e-3, 19e-3):
        times = [interpolate(start + travel + way, [r for _, r in path], [t for t, _ in path]) for way in (-window, window)]
        if None in times:
            print(f"{1e3 * travel:g} mm: the run ends before")
        else:
            print(f"{1e3 * travel:g} mm: {2 * window / (times[1] - times[0]):.0f} m/s")


if __name__ == "__main__":
    main()
