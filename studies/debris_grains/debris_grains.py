#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the pieces of a debris cloud have a size of their own, or that of the cells?

usage: debris_grains.py [--cells 0.2 0.1 0.05] [--dimension axisymmetric|3d] [--size 0.48] [--end 3] [--folder run/studies/debris_grains]
                        [--threads N] [--whipple EXE]

A sphere of 2017-T4 of 3.175 mm strikes a sheet of 6061-T6 of 0.787 mm at 6.7 km/s (the first half of Ryan's shield); of the
sphere, `--end` us later: failed and loose shares, fragments, the largest one, and their size (cube root of the volume, in sections
square root of the area) at half of the mass in fragments. Without grains, with `failure_grains`, and with fields at cracks as
well. Runs that are there are not repeated.
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import call  # noqa: E402

DENSITY = 2780.0  # kg/m^3
RADIUS = 1.5875  # mm


def case_of(space, cell, keys, end):
    """Text of the case. space: three dimensions, a quarter; else a section. end: us."""
    side = cell * round(max(8, 2.5 * end) / cell)
    lower, upper = -cell * round(max(6, 2.5 * end) / cell), cell * round((5 + 7 * end) / cell)
    vector = (lambda x, *rest: "[" + ", ".join(f'"{value:.12g} {{unit}}"' for value in (x, *rest)) + "]")
    mm = (lambda x, r: vector(x, *([r] * (2 if space else 1))).format(unit="mm"))
    at_rest = ', "0 m/s"' * (2 if space else 1)
    return f"""title = "debris of a sphere"
[domain]
dimension = "{'3d' if space else 'axisymmetric'}"
lower = {mm(lower, 0)}
upper = {mm(upper, side)}
cell_size = "{cell} mm"
{'boundary = { y_lower = "symmetry", z_lower = "symmetry" }' if space else ''}
[time]
end = "{end:g} us"
[[body]]
name = "sphere"
material = "aluminium_2017_t4_mie_gruneisen.toml"
velocity = ["6.7 km/s"{at_rest}]
shape = {{ sphere = {{ center = {mm(-RADIUS, 0)}, radius = "{RADIUS} mm" }} }}
{keys}
[[body]]
name = "sheet"
material = "aluminium_6061_t6.toml"
shape = {{ box = {{ lower = {mm(0, -7 if space else 0)}, upper = {mm(0.787, 7)} }} }}
{keys}
[output]
snapshot_every = "1 us"
"""


def line(run, name, cell, space):
    """Row of the table."""
    with (run / "report/quantities.csv").open(newline="") as stream:
        single = {row["quantity"]: float(row["value"]) for row in csv.DictReader(stream)}
    with (run / "report/bodies.csv").open(newline="") as stream:
        bodies = {row["body part"]: row for row in csv.DictReader(stream)}
    whole = bodies["sphere whole"]
    total = float(whole["mass [kg]"])
    with (run / "report/fragments.csv").open(newline="") as stream:
        rows = [{key.split(" [")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
    own = [row for row in rows if row["body"] == 0]
    mass = np.array([row["mass"] for row in own for _ in range(int(row["copies"]))])
    if space:
        size = np.cbrt([row["mass"] / DENSITY for row in own for _ in range(int(row["copies"]))])
    else:  # a ring: its area is its volume over the way of its centre
        size = np.sqrt([row["mass"] / DENSITY / (2 * np.pi * max(row["radius"], 0.25e-3 * cell)) for row in own])
    order = np.argsort(size)
    half = size[order][np.searchsorted(np.cumsum(mass[order]), 0.5 * mass.sum())] if len(size) else np.nan
    return (f"| {cell:g} | {name} | {100 * float(whole['failed_fraction [1]']):.1f} | {100 * single['loose_fraction.sphere']:.1f} | "
            f"{len(mass)} | {100 * max(mass, default=0) / total:.1f} | {1e3 * half:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=float, nargs="+", default=[0.2, 0.1, 0.05], help="mm")
    parser.add_argument("--dimension", choices=["axisymmetric", "3d"], default="axisymmetric")
    parser.add_argument("--size", type=float, default=0.48, help="of the grains, mm")
    parser.add_argument("--end", type=float, default=3.0, help="us")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/debris_grains")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    space = arguments.dimension == "3d"
    grains = f'failure_grains = {{ size = "{arguments.size} mm", seed = 1 }}'
    variants = {"none": "", "grains": grains, "grains, cracks": grains + '\nfailure = { cracks = "fields" }'}
    print("| cells, mm | failure | failed, % | loose, % | fragments | largest, % | size at half of their mass, mm |")
    print("| --- " * 7 + "|")
    for cell in arguments.cells:
        for name, keys in variants.items():
            run = folder / f"{arguments.dimension}_{name.replace(', ', '_')}_{arguments.size}_{cell:g}_{arguments.end:g}"
            if not (run / "report/fragments.csv").is_file():
                case = folder / f"{run.name}.toml"
                case.write_text(case_of(space, cell, keys, arguments.end), encoding="utf-8")
                call([arguments.whipple, "run", case, "--output", run, "--force", "--quiet", "--threads", arguments.threads])
                call([arguments.whipple, "analyse", run])
            print(line(run, name, cell, space), flush=True)


if __name__ == "__main__":
    main()
