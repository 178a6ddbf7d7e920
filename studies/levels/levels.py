#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A region of small cells beside small and large cells everywhere (docs/theory/levels.md, 6).

usage: levels.py [section] [crater] [shield] [shock]... [--grid 0|1]... [--table] [--folder run/studies/levels] [--whipple EXE]

  section cases/aluminium_crater as an axisymmetric section
  crater  cases/aluminium_crater: sphere of 0.5 g into a thick block at 6 km/s
  shield  cases/whipple_shield: bumper, cloud and wall, with the middle of both in the region
  shock   column without strength onto a plane at 1000, 500 and 250 m/s, whose shock crosses the change to larger and to smaller cells

Each run takes one thread, those of a grid one after the other; user time is that of the process, memory its largest resident size.
Particle-steps count the particles that take part. Runs of the same program are kept; --table prints what is there.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.measured import Measures  # noqa: E402
from studies.commands import timed_run  # noqa: E402

REGIONS = {
    "crater": [(("0 mm", "0 mm", "-40 mm"), ("28 mm", "28 mm", "28 mm")), (("0 mm", "0 mm", "-40 mm"), ("48 mm", "48 mm", "4 mm"))],
    "shield": [(("0 mm", "0 mm", "-30 mm"), ("44 mm", "44 mm", "160 mm"))],
}
REGIONS["section"] = REGIONS["crater"]
CASES = {"section": ROOT / "cases/aluminium_crater/case.toml", "crater": ROOT / "cases/aluminium_crater/case.toml", "shield": ROOT / "cases/whipple_shield/case.toml"}
CELLS = {"section": [0.5, 0.25, 0.125], "crater": [1.0, 0.7], "shield": [0.7, 0.5]}  # mm, the small ones
MEASURES = {
    "crater": {"crater_depth.block": ("depth, mm", 1e3, 2), "crater_diameter.block": ("diameter, mm", 1e3, 2)},
    "shield": {"mean_velocity.sphere": ("sphere, m/s", 1.0, 1), "mean_velocity.bumper": ("bumper, m/s", 1.0, 1), "mean_velocity.wall": ("wall, m/s", 1.0, 2)},
}
MEASURES["section"] = MEASURES["crater"]
SECTION = ["domain.dimension=axisymmetric", "domain.axis=z"]
WAYS = ("small", "two sizes", "large")
COLUMN = """title = "column"
[domain]
dimension = "plane_strain"
lower = ["-40 mm", "0 mm"]
upper = ["40 mm", "1 mm"]
cell_size = "{cell} mm"
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", y_upper = "symmetry" }}
{region}
[time]
end = "7 us"
[[body]]
name = "column"
material = "aluminium_mie_gruneisen"
velocity = ["-{speed} m/s", "0 m/s"]
shape = {{ box = {{ lower = ["-40 mm", "0 mm"], upper = ["10 mm", "1 mm"] }} }}
[output]
snapshot_every = "7 us"
fields = ["mass", "internal_energy"]
"""


def region_text(boxes):
    """The lines of a case that name regions."""
    lines = []
    for lower, upper in boxes:
        corners = (", ".join(f'"{x}"' for x in corner) for corner in (lower, upper))
        lines.append("[[domain.refinement]]\nlower = [{}]\nupper = [{}]\n".format(*corners))
    return "".join(lines)


def mixed_of(arguments, case, settings):
    """Part of the particles at the start that has functions of both sizes."""
    command = [str(arguments.whipple), "check", str(case), "--json", *[word for setting in settings for word in ("--set", setting)]]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return max((level["mixed_particles"] for level in found.get("levels", [])), default=0) / found["particles"]


def run_of(arguments, problem, cell, way):
    """Runs a problem unless it is there. @returns folder, its record or None, and prepare() that returns the case and its settings"""
    folder = arguments.folder / f"{problem}_{round(cell * 1e3)}_um_{way.replace(' ', '_')}"

    def prepare():
        text = CASES[problem].read_text(encoding="utf-8")
        if way == "two sizes":
            head, mark, rest = text.partition("[time]")
            text = head + region_text(REGIONS[problem]) + mark + rest
        path = folder.with_suffix(".toml")
        path.write_text(text, encoding="utf-8")
        return path, [f"domain.cell_size={2 * cell if way == 'large' else cell} mm", "output.snapshot_every=1 us", *(SECTION if problem == "section" else [])]

    return folder, timed_run(arguments, folder, prepare), prepare


def history(folder):
    """Columns of history.csv by their names without units."""
    with (folder / "history.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    return {name.split(" [")[0]: [row[name] for row in rows] for name in rows[0]}


def print_problem(arguments, problem):
    measures = MEASURES[problem]
    print(f"| cells, mm | way | {' | '.join(title for title, _, _ in measures.values())} | particles | mixed at first | steps | user time, s | memory, MiB | shocks at change |")
    print("| " + " | ".join(["---"] * (8 + len(measures))) + " |")
    for grid, cell in enumerate(CELLS[problem]):
        if arguments.grid and grid not in arguments.grid:
            continue
        for way in WAYS:
            folder, kept, prepare = run_of(arguments, problem, cell, way)
            if kept is None:
                continue
            if kept["code"] != 0:
                print(f"| {cell:g} | {way} | ended with code {kept['code']} |")
                continue
            measured, rows = Measures(folder), history(folder)
            values = [f"{measured.single.get(name, math.nan) * scale:.{digits}f}" for name, (_, scale, digits) in measures.items()]
            mixed = mixed_of(arguments, *prepare()) if way == "two sizes" else 0.0
            counted = rows.get("shocks_at_change", ["-"])[-1]
            print(f"| {cell:g} | {way} | {' | '.join(values)} | {rows['particles'][-1]} | {mixed:.2f} | {rows['step'][-1]} | {kept['seconds']:.0f} | "
                  f"{kept['memory'] / 2**20:.0f} | {counted} |", flush=True)


def profile_of(arguments, speed, cell, boxes, name):
    """Runs a column. @returns (distance from the plane before the impact, mm; specific internal energy, J/kg) of its particles"""
    folder = arguments.folder / f"shock_{speed}_{name}"

    def prepare():
        path = folder.with_suffix(".toml")
        path.write_text(COLUMN.format(cell=cell, speed=speed, region=region_text(boxes)), encoding="utf-8")
        return path, []

    if timed_run(arguments, folder, prepare) is None:
        return None
    table = folder / "last"
    if not table.exists():
        subprocess.run([str(arguments.whipple), "export", str(folder), "-o", str(table), "--format", "csv", "--last", "--quiet",
                        "--fields", "mass,internal_energy"], check=True)
    with next(table.glob("*.csv")).open(newline="") as stream:
        rows = [{key.split(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(stream)]
    place = next(key for key in rows[0] if key in ("x", "position_x", "position.x", "Points:0", "position:0", "position_0"))
    rows.sort(key=lambda row: float(row[place]))
    total, profile = 0.0, []
    for row in rows:
        profile.append((total, float(row["internal_energy"])))
        total += float(row["mass"])
    return [(50.0 * before / total, energy) for before, energy in profile]


def mean_between(profile, first, last):
    inside = [energy for at, energy in profile if first <= at < last]
    return sum(inside) / len(inside)


def print_shock(arguments):
    """Mean energy in windows after the shock, kJ/kg: behind the change by more than 6 coarse cells, within 6 of it, beyond."""
    small, large = 0.125, 0.25
    print("| speed, m/s | change | window | small cells, kJ/kg | large cells | two sizes | two sizes less small |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for speed in (1000, 500, 250):
        uniform = {cell: profile_of(arguments, speed, cell, [], f"uniform_{round(1e3 * cell)}") for cell in (small, large)}
        # The column moves to the change, which is 20 mm from the plane: the shock meets it in material that was farther away.
        shock = 5328.0 + 1.338 * speed
        met = 20.0 * shock / (shock - speed)
        for name, box in (("to large", (("-40 mm", "0 mm"), ("-20 mm", "1 mm"))), ("to small", (("-20 mm", "0 mm"), ("40 mm", "1 mm")))):
            profile = profile_of(arguments, speed, small, [box], name.replace(" ", "_"))
            if profile is None or None in uniform.values():
                continue
            for window, (first, last) in {"before": (-12, -3), "within 6 cells": (-1.5, 1.5), "beyond": (3, 12)}.items():
                values = [mean_between(p, met + first, met + last) / 1e3 for p in (uniform[small], uniform[large], profile)]
                print(f"| {speed} | {name} | {window} | {values[0]:.2f} | {values[1]:.2f} | {values[2]:.2f} | {values[2] - values[0]:+.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problems", nargs="*", default=[])
    parser.add_argument("--grid", type=int, nargs="*", default=[])
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/levels")
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    arguments.folder = arguments.folder.resolve()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for problem in arguments.problems or [*CASES, "shock"]:
        print(f"\n{problem}\n")
        if problem == "shock":
            print_shock(arguments)
        else:
            print_problem(arguments, problem)


if __name__ == "__main__":
    main()
