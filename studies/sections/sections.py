#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Axisymmetric sections beside three dimensions at equal cells: Taylor bar, rod into a block, plug out of a plate.

usage: sections.py [PROBLEM]... [--grid 0|1]... [--table] [--folder run/studies/sections] [--whipple EXE]

  bar    cases/taylor_bar_copper_227: length and diameter of the impact end
  rod    tungsten alloy, 4 mm in diameter, 20 mm long, 1.5 km/s, into a cylinder of 4340 steel, 32 mm in diameter, 30 mm long: depth, speed of what is left
  plug   4340 steel cylinder, 8 mm in diameter, 16 mm long, 600 m/s, through 3 mm of aluminium 2024-T3: speed of cylinder and plate

The same particles per cell in both; three dimensions are a quarter between two mirror planes. Default numbers otherwise. Each run
takes one thread; user time is that of the process. Runs of the same program are kept; --table prints what is there.
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.measured import Measures  # noqa: E402
from studies.commands import timed_run  # noqa: E402

SECTION = ["domain.dimension=axisymmetric", "domain.axis=z"]

IMPACT = """title = "{title}"
[domain]
lower = ["0 mm", "0 mm", "{low} mm"]
upper = ["{width} mm", "{width} mm", "{high} mm"]
cell_size = "{cell} mm"
boundary = {{ x_lower = "symmetry", y_lower = "symmetry" }}
[time]
end = "{end} us"
[[body]]
name = "{name}"
material = "{projectile}"
velocity = ["0 m/s", "0 m/s", "{speed} m/s"]
shape = {{ cylinder = {{ center = ["0 mm", "0 mm", "{centre} mm"], axis = "z", radius = "{radius} mm", height = "{length} mm" }} }}
[[body]]
name = "{target}"
material = "{struck}"
shape = {{ cylinder = {{ center = ["0 mm", "0 mm", "{middle} mm"], axis = "z", radius = "{span} mm", height = "{depth} mm" }} }}
[output]
snapshot_every = "{every} us"
fields = ["pressure", "density", "plastic_strain", "failed"]
"""

PROBLEMS = {
    "bar": {"cells": [0.8, 0.4], "measures": {"length.bar": ("length, mm", 1e3, 3), "foot_diameter.bar": ("impact end, mm", 1e3, 3)}},
    "rod": {"cells": [1.0, 0.7],
            "measures": {"penetration_depth.rod": ("depth, mm", 1e3, 2), "mean_velocity.rod": ("mean speed of the rod, m/s", 1.0, 1)},
            "case": {"title": "rod into a block", "low": -24, "high": 42, "width": 24, "end": 30, "name": "rod",
                     "projectile": "tungsten_nickel_iron_mie_gruneisen.toml", "speed": 1500, "radius": 2, "length": 20, "centre": -10, "target": "block",
                     "struck": "steel_4340_mie_gruneisen.toml", "span": 16, "depth": 30, "middle": 15, "every": 10}},
    "plug": {"cells": [0.75, 0.5],
             "measures": {"mean_velocity.cylinder": ("speed of the cylinder, m/s", 1.0, 1), "mean_velocity.plate": ("mean speed of the plate, m/s", 1.0, 2)},
             "case": {"title": "plug out of a plate", "low": -18, "high": 48, "width": 27, "end": 60, "name": "cylinder",
                      "projectile": "steel_4340_mie_gruneisen.toml", "speed": 600, "radius": 4, "length": 16, "centre": -8, "target": "plate",
                      "struck": "aluminium_2024_t3_sheet_mie_gruneisen.toml", "span": 24, "depth": 3, "middle": 1.5, "every": 10}},
}


def case_of(problem, cell, folder):
    """Writes the case of a problem. @returns its path and the settings of its cells"""
    if problem == "bar":
        return ROOT / "cases/taylor_bar_copper_227/case.toml", [f"domain.cell_size={cell} mm"]
    text = IMPACT.format(cell=cell, **PROBLEMS[problem]["case"])
    path = folder / f"{problem}_{cell}.toml"
    path.write_text(text, encoding="utf-8")
    return path, []


def run_of(arguments, problem, cell, dimension):
    """Runs a problem unless it is there. @returns folder, its record or None"""
    folder = arguments.folder / f"{problem}_{round(cell * 1e3)}_um_{dimension}"

    def prepare():
        case, settings = case_of(problem, cell, arguments.folder)
        return case, settings + (SECTION if dimension == "section" else [])

    return folder, timed_run(arguments, folder, prepare)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("problem", nargs="*", choices=[*PROBLEMS, []])
    parser.add_argument("--grid", type=int, choices=(0, 1), action="append")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/sections")
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    print("| problem | cells, mm | measure | section | three dimensions | difference | user s |\n" + "| --- " * 7 + "|")
    for problem in arguments.problem or PROBLEMS:
        for grid in arguments.grid or (0, 1):
            cell = PROBLEMS[problem]["cells"][grid]
            runs = [run_of(arguments, problem, cell, dimension) for dimension in ("section", "quarter")]
            if any(kept is None or kept["code"] != 0 for _, kept in runs):
                print(f"| {problem} | {cell:g} | " + ", ".join("not run" if kept is None else f"ended with {kept['code']}" for _, kept in runs) + " | | | | |")
                continue
            both = [Measures(folder).single for folder, _ in runs]
            times = "; ".join(f"{kept['seconds']:.0f}" for _, kept in runs)
            for name, (title, factor, digits) in PROBLEMS[problem]["measures"].items():
                a, b = (values[name] * factor for values in both)
                print(f"| {problem} | {cell:g} | {title} | {a:.{digits}f} | {b:.{digits}f} | {a - b:+.{digits}f} | {times} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
