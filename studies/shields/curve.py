#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How does the critical diameter of a shield depend on the speed, by runs and by equations?

Usage: python3 -m studies.shields.curve SHIELD.toml STUDY... [--whipple PROGRAM] [--output PREFIX]

Reads limits.csv of studies that `whipple shield --limit` wrote and `whipple sweep` computed (they may be under way), and
writes PREFIX.csv and PREFIX.png (default: curve in the folder of the first): interval of each speed, which contains those of both cell sizes
and the positions of the grid in all of them, and the equations from 1 to 12 km/s. Beside them the measured normal shots on this shield (shots.csv), and the melted
fraction of the debris of its sphere and bumper, where clouds.csv has it; on the right the shots with the same sphere and bumper on walls of all
thicknesses, with the outcomes of their sections, and the thinnest wall that holds by the equations.
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
from studies.shields import page

EQUATIONS = ("nno_1993", "nno_2001", "jsc_2011", "srl_2008")
SPEEDS = [1 + 0.25 * k for k in range(45)]  # km/s
WALLS = [0.2 * k for k in range(4, 41)]  # mm
CLOSE = 0.02  # by which a measured shield may differ
ONSET, MELTED = 0.1, 0.5  # melted fraction of the debris that is marked


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


def walls(whipple, shield):
    """Thinnest walls in mm that stop the sphere of a shield by an equation, at the speeds: lists of (speed, thickness) by equation."""
    own = tomllib.loads(shield.read_text(encoding="utf-8"))
    sphere, bumper, wall = own["projectile"], own["shield"]["bumper"][0], own["shield"]["wall"]
    diameter = length(sphere["diameter"])
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "shots.csv"
        file.write_text("shot,sphere,diameter [mm],angle [degree],velocity [km/s],bumper,bumper thickness [mm],spacing [mm],wall,wall thickness [mm]\n" + "".join(
            f"{speed:g} {thickness:.4g},{sphere['alloy']},{diameter:g},0,{speed:g},{bumper['alloy']},{length(bumper['thickness']):g},"
            f"{length(bumper['spacing']):g},{wall['alloy']},{thickness:g}\n" for speed in SPEEDS for thickness in WALLS), encoding="utf-8")
        for entry in json.loads(commands.call([whipple, "shield", file, "--json", "--quiet"]).stdout):
            speed, thickness = 1e-3 * entry["sphere"]["velocity"], 1e3 * entry["wall"]["thickness"]
            for name in EQUATIONS:
                limit = entry["equations"][name]["critical_diameter"]
                if limit is not None and 1e3 * limit >= diameter:
                    thinnest = found.setdefault(name, {})
                    thinnest[speed] = min(thickness, thinnest.get(speed, thickness))
    return {name: sorted(values.items()) for name, values in found.items()}


def length(text):
    """Length in mm of a text with its unit, mm or cm."""
    value, unit = text.split()
    return float(value) * {"mm": 1.0, "cm": 10.0}[unit]


def shots_on(shield):
    """Normal shots of shots.csv with the spheres and bumpers of a shield and its spacing, with the outcome of their section: speed, thickness of
    the wall (mm), failed, outcome or None."""
    own = tomllib.loads(shield.read_text(encoding="utf-8"))
    sphere, bumper, wall = own["projectile"], own["shield"]["bumper"][0], own["shield"]["wall"]
    wanted = {"diameter [mm]": length(sphere["diameter"]), "bumper thickness [mm]": length(bumper["thickness"]), "spacing [mm]": length(bumper["spacing"])}
    alloys = {"sphere": sphere["alloy"], "bumper": bumper["alloy"], "wall": wall["alloy"]}
    outcomes = {row["shot"]: row["outcome"] for row in page.read_csv(page.HERE / "outcomes.csv") if row["model"] == "section"}
    return [(float(row["velocity [km/s]"]), float(row["wall thickness [mm]"]), row["result"] == "P", outcomes.get(f"{row['source']}/{row['shot']}"))
            for row in page.read_csv(page.HERE / "shots.csv") if float(row["angle [degree]"]) == 0 and all(row[key] == word for key, word in alloys.items())
            and all(abs(float(row[key]) / value - 1) < CLOSE for key, value in wanted.items())]


def melted(shield):
    """Melted fraction of the debris of the sphere and bumper of a shield by cell size: lists of (speed, share)."""
    own = tomllib.loads(shield.read_text(encoding="utf-8"))
    diameter, thickness = length(own["projectile"]["diameter"]), length(own["shield"]["bumper"][0]["thickness"])
    found = {}
    for row in page.read_csv(page.HERE / "clouds.csv"):
        if abs(float(row["diameter [mm]"]) / diameter - 1) < CLOSE and abs(float(row["bumper [mm]"]) / thickness - 1) < CLOSE:
            found.setdefault(float(row["cell size [mm]"]), []).append((float(row["velocity [km/s]"]), float(row["debris melted"])))
    return {cell: sorted(points) for cell, points in sorted(found.items())}


def reached(points, share):
    """Speed at which a share is reached between two points, None if it is not."""
    for (slow, less), (fast, more) in zip(points, points[1:]):
        if less < share <= more:
            return slow + (fast - slow) * (share - less) / (more - less)
    return None


def hull(studies):
    """Rows of `limits` of several studies as one: of each speed the interval that contains all, with all verdicts; None where one has none."""
    found = {}
    for row in (row for study in studies for row in study):
        found.setdefault(row[0], []).append(row)
    return [(speed, *((min(row[1] for row in rows), max(row[2] for row in rows)) if all(row[1] is not None for row in rows) else (None, None)),
             "; ".join(dict.fromkeys(row[3] for row in rows))) for speed, rows in sorted(found.items())]


def write_table(file, found, by_equation, shares):
    """Writes one row per speed and kind of limit, and those of the melted fraction of the debris."""
    with open(file, "w", newline="", encoding="utf-8") as table:
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(["velocity [km/s]", "limit", "lower diameter [mm]", "upper diameter [mm]", "verdict"])
        for speed, lower, upper, verdict in found:
            writer.writerow([f"{speed:g}", "runs", *("" if end is None else f"{end:.4g}" for end in (lower, upper)), verdict])
        for speed, values in by_equation:
            for name, diameter in values.items():
                writer.writerow([f"{speed:g}", name, f"{diameter:.4g}", f"{diameter:.4g}", ""])
        for cell, points in shares.items():
            for speed, share in points:
                writer.writerow([f"{speed:g}", f"melted fraction of the debris, {cell:g} mm", "", "", f"{share:.4g}"])


def draw(file, found, by_equation, shares, shots, thinnest, shield):
    """Draws the intervals of the runs over the curves of the equations, and the shots with the same sphere beside them."""
    own = tomllib.loads(shield.read_text(encoding="utf-8"))
    diameter, thickness = length(own["projectile"]["diameter"]), length(own["shield"]["wall"]["thickness"])
    style.apply()
    figure = Figure(figsize=(style.WIDTH, 0.45 * style.WIDTH), layout="constrained")
    axes, beside = figure.subplots(1, 2)
    for name in EQUATIONS:
        points = [(speed, values[name]) for speed, values in by_equation if name in values]
        if points:
            line, = axes.plot(*zip(*points), label=name)
            beside.plot(*zip(*thinnest[name]), color=line.get_color(), label=name)
    intervals = [(speed, lower, upper) for speed, lower, upper, _ in found if lower is not None]
    for place, (speed, lower, upper) in enumerate(intervals):
        axes.plot([speed, speed], [lower, upper], color="black", linewidth=3, label="runs" if place == 0 else None)
    mark_shots(axes, [(speed, diameter, failed, outcome) for speed, wall, failed, outcome in shots if abs(wall / thickness - 1) < CLOSE])
    mark_shots(beside, [(speed, wall, failed, outcome) for speed, wall, failed, outcome in shots])
    if shares:
        cell = min(shares)
        for panel in (axes, beside):
            for share, dashes in ((ONSET, ":"), (MELTED, "--")):
                if speed := reached(shares[cell], share):
                    panel.axvline(speed, color="#999999", linestyle=dashes, linewidth=0.8, label=f"{100 * share:.0f} % of the debris melted")
    axes.set_ylabel("critical diameter (mm)")
    beside.set_ylabel(f"thinnest wall for {diameter:g} mm (mm)")
    for panel in (axes, beside):
        panel.set_xlabel("speed (km/s)")
        panel.set_xlim(1, 10)
        panel.set_ylim(0, None)
    axes.legend(fontsize=5)
    figure.savefig(file, dpi=160)


def mark_shots(axes, points):
    """Marks measured shots: crosses failed, circles held; those whose section has the other verdict in red."""
    for speed, value, failed, outcome in points:
        wrong = outcome is not None and outcome != "undecided" and (outcome in page.DEFEATS) != failed
        axes.plot(speed, value, marker="x" if failed else "o", fillstyle="none", linestyle="none", markersize=4,
                  color="#d55e00" if wrong else "#000000" if outcome else "#777777")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shield", type=pathlib.Path)
    parser.add_argument("study", type=pathlib.Path, nargs="+")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    parser.add_argument("--output", type=pathlib.Path)
    arguments = parser.parse_args()
    output = arguments.output or arguments.study[0] / "curve"
    found = hull([limits(study / "limits.csv") for study in arguments.study])
    by_equation = equations(arguments.whipple, arguments.shield, SPEEDS)
    shares = melted(arguments.shield)
    write_table(output.with_suffix(".csv"), found, by_equation, shares)
    draw(output.with_suffix(".png"), found, by_equation, shares, shots_on(arguments.shield), walls(arguments.whipple, arguments.shield), arguments.shield)
    for speed, lower, upper, verdict in found:
        print(f"{speed:g} km/s: {verdict}" if lower is None else f"{speed:g} km/s: {lower:.3g} to {upper:.3g} mm")
    for cell, points in shares.items():
        told = ", ".join(f"{100 * share:.0f} % from {speed:.2f} km/s" for share in (ONSET, MELTED) if (speed := reached(points, share)))
        print(f"melted fraction of the debris in cells of {cell:g} mm: {told}")


if __name__ == "__main__":
    main()
