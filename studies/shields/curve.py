#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How does the critical diameter of a shield depend on the speed, by runs and by equations?

Usage: python3 -m studies.shields.curve SHIELD.toml STUDY [--whipple PROGRAM]

Reads limits.csv of a study that `whipple shield --limit` wrote and `whipple sweep` computed (it may be under way), and
writes curve.csv and curve.png into its folder: interval of each speed, which contains those of both cell sizes and the three
positions of the grid, and the equations from 1 to 12 km/s.
"""
import argparse
import csv
import json
import math
import pathlib
import sys
import tempfile
import tomllib

from matplotlib.figure import Figure

from report import style
from studies import commands

EQUATIONS = ("nno_1993", "nno_2001", "jsc_2011", "srl_2008")
SPEEDS = [1 + 0.25 * k for k in range(45)]  # km/s


def at_speeds(text, speeds):
    """Shield files with the speed of the projectile replaced. @throws SystemExit where its text is not found once"""
    velocity = tomllib.loads(text)["projectile"]["velocity"]
    old = f'"{velocity}"'
    if text.count(old) != 1:
        sys.exit(f"the speed of the projectile has to be written once, as {old} in double quotes: found {text.count(old)} times")
    return [text.replace(old, f'"{speed} km/s"') for speed in speeds]


def equations(whipple, shield, speeds):
    """Critical diameters in mm by speed and equation, where an equation applies."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "shield.toml"
        for text, speed in zip(at_speeds(shield.read_text(encoding="utf-8"), speeds), speeds):
            file.write_text(text, encoding="utf-8")
            found = json.loads(commands.call([whipple, "shield", file, "--json", "--quiet"]).stdout)[0]["equations"]
            rows.append((speed, {name: 1e3 * found[name]["critical_diameter"] for name in EQUATIONS
                                 if found[name]["critical_diameter"] is not None}))
    return rows


def limits(file):
    """Rows (speed in km/s, smallest and largest diameter in mm, verdict) of limits.csv, in the units of the written study;
    diameters are None where the study found no interval."""
    rows = []
    with open(file, newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            speed = next(value for name, value in row.items() if name.endswith("[m/s]"))
            ends = [2 * float(row[name]) for name in ("lower [mm]", "upper [mm]")]
            found = not any(math.isnan(end) for end in ends)
            rows.append((1e-3 * float(speed), *(ends if found else (None, None)), row["verdict"]))
    return sorted(rows)


def write_table(file, found, by_equation):
    """Writes one row per speed and kind of limit."""
    with open(file, "w", newline="", encoding="utf-8") as table:
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(["velocity [km/s]", "limit", "lower diameter [mm]", "upper diameter [mm]", "verdict"])
        for speed, lower, upper, verdict in found:
            writer.writerow([f"{speed:g}", "runs", *("" if end is None else f"{end:.4g}" for end in (lower, upper)), verdict])
        for speed, values in by_equation:
            for name, diameter in values.items():
                writer.writerow([f"{speed:g}", name, f"{diameter:.4g}", f"{diameter:.4g}", ""])


def draw(file, found, by_equation):
    """Draws the intervals of the runs over the curves of the equations."""
    style.apply()
    figure = Figure(figsize=(style.NARROW, 0.7 * style.NARROW), layout="constrained")
    axes = figure.add_subplot()
    for name in EQUATIONS:
        points = [(speed, values[name]) for speed, values in by_equation if name in values]
        if points:
            axes.plot(*zip(*points), label=name)
    intervals = [(speed, lower, upper) for speed, lower, upper, _ in found if lower is not None]
    for place, (speed, lower, upper) in enumerate(intervals):
        axes.plot([speed, speed], [lower, upper], color="black", linewidth=3, label="runs" if place == 0 else None)
    axes.set_xlabel("speed (km/s)")
    axes.set_ylabel("critical diameter (mm)")
    axes.legend()
    figure.savefig(file, dpi=200)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shield", type=pathlib.Path)
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    found = limits(arguments.study / "limits.csv")
    by_equation = equations(arguments.whipple, arguments.shield, SPEEDS)
    write_table(arguments.study / "curve.csv", found, by_equation)
    draw(arguments.study / "curve.png", found, by_equation)
    for speed, lower, upper, verdict in found:
        print(f"{speed:g} km/s: {verdict}" if lower is None else f"{speed:g} km/s: {lower:.3g} to {upper:.3g} mm")


if __name__ == "__main__":
    main()
