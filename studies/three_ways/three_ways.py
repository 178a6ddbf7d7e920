#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Particles, elements with deletion, and elements that become particles, at equal spacing.

usage: three_ways.py [--cells M]... [--end S] [--table] [--folder run/studies/three_ways] [--whipple EXE]

Case: cases/long_rod_oblique_plate (75 mm x 5 mm tungsten alloy, 9 mm of steel at 60 degrees, 2.5 km/s). Elements are as large as the
cells (m), which hold 2 x 2 x 2 particles along their edges. Elements are deleted beyond the plastic strain at which the case converts
them (0.6), and beyond 2. All ways of a spacing are run one after the other on one thread by one program: user seconds of the process.
Columns: steps, least and largest step (without those shortened to meet an output), user time, mass deleted of rod and plate,
length of the rod over that at the start, its speed over that of the impact, at the end of the case. A second table gives what the
finest grid says of each way with its band from all grids (docs/theory/uncertainty.md). Runs of the same program are kept.
"""
import argparse
import csv
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.measured import Measures  # noqa: E402
from studies.commands import timed_run  # noqa: E402
from studies.validation.bands import grid_study  # noqa: E402

CASE = ROOT / "cases/long_rod_oblique_plate/case.toml"
WAYS = {"particles": ["body.0.discretization.method=particles", "body.1.discretization.method=particles"],
        "elements that become particles": [],
        "elements, deleted beyond 0.6": [f"body.{b}.{key}" for b in (0, 1) for key in
                                         ("discretization.method=finite_elements", "element_range.beyond=remove", "element_range.plastic_strain=0.6")],
        "elements, deleted beyond 2": [f"body.{b}.{key}" for b in (0, 1) for key in
                                       ("discretization.method=finite_elements", "element_range.beyond=remove", "element_range.plastic_strain=2")]}


def run_of(arguments, way, cell):
    folder = arguments.folder / f"{list(WAYS).index(way)}_{round(cell * 1e6)}_um"
    settings = [f"domain.cell_size={cell * 1e3:.12g} mm", *WAYS[way], *([f"time.end={arguments.end} s"] if arguments.end else [])]
    return folder, timed_run(arguments, folder, lambda: (CASE, settings))


COLUMNS = ("deleted, g", "length", "speed")


def row_of(folder, kept, way, cell):
    """The row of a run, and its values of COLUMNS."""
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.split(" ")[0] for name in rows[0]]
    column = {name: [float(row[names.index(name)]) for row in rows[2:]] for name in ("dt", "dt_bound", "step", "time")}
    last = dict(zip(names, rows[-1]))
    free = [dt for dt, bound in zip(column["dt"], column["dt_bound"]) if bound not in (6.0, 9.0)]  # not first, not output time
    removed = float(last.get("removed_mass", 0.0)) * 1e3
    values = [removed, math.nan, math.nan]
    if kept["code"] == 0:
        single = Measures(folder).single
        values[1:] = [single.get(name, math.nan) for name in ("residual_length_ratio.rod", "residual_speed_ratio.rod")]
    end = "" if kept["code"] == 0 else f" (ended with {kept['code']} at {column['time'][-1] * 1e6:.1f} us)"
    row = (f"| {cell * 1e3:g} | {way}{end} | {int(column['step'][-1])} | {min(free) * 1e9:.2f} | {max(free) * 1e9:.2f} | {kept['seconds']:.0f} | "
           f"{removed:.2f} | {' | '.join(f'{value:.3f}' for value in values[1:])} | {float(last['energy_error']):.0e} |")
    return row, values


def of_all_grids(found):
    """Rows of what the grids say of each way: value of the finest, band, order or why there is none."""
    rows = ["| way | " + " | ".join(COLUMNS) + " |\n" + "| --- " * (1 + len(COLUMNS)) + "|"]
    for way, values in found.items():
        studies = [grid_study([(cell, of_cell[k]) for cell, of_cell in values.items()]) for k in range(len(COLUMNS))]
        cells = ["0" if study.value == study.band == 0.0 else f"{study.value:.3f} +- {study.band:.2g} ({study.state}" +
                 (f", order {study.order:.1f})" if study.converged and study.order > 0 else ")") for study in studies]
        rows.append(f"| {way} | " + " | ".join(cells) + " |")
    return "\n".join(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=float, action="append")
    parser.add_argument("--end", type=float)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/three_ways")
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    print("| cells, mm | way | steps | least step, ns | largest, ns | user s | deleted, g | length | speed | energy error |\n" + "| --- " * 10 + "|")
    found = {}
    for cell in arguments.cells or [1e-3, 0.7e-3, 0.5e-3]:
        for way in WAYS:
            folder, kept = run_of(arguments, way, cell)
            if kept is not None:
                row, found.setdefault(way, {})[cell] = row_of(folder, kept, way, cell)
                print(row, flush=True)
    print("\n" + of_all_grids(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
