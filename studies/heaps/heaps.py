#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Angle of repose of a slope without cohesion, and exponent of the run-out of dry columns over their aspect ratio.

usage: heaps.py repose|exponent [--cells M]... [--per-cell N]... [--table] [--folder run/studies/heaps] [--threads N] [--whipple EXE]

repose    cases/slope_failure with cohesions of 0.1 kPa and 0: the slope of the line through the surface between a quarter and three
          quarters of the height that is left between the ground ahead and the crest, and the surface at 30 m, 15 s after the weight
          begins to act. Plane flow without dilation on this cone has sin(phi) = sqrt(3) sin(20 deg) 2/(3 + sin(20 deg)).
exponent  cases/dry_columns of a = 0.4, 0.7, 1 and 1.5: run-out over radius at 1 % of the mass, (r - R)/R, and the slope of its
          logarithm over that of a, over all four and over the last three.
Cells (m) are those of the case and twice them; particles of a cell along a direction 2 and 3, which moves the lattice. Runs of the
same program and the same case are kept; --table runs nothing.
"""
import argparse
import math
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402
from studies.commands import compute  # noqa: E402

ASPECTS = (0.4, 0.7, 1.0, 1.5)
RADIUS = 0.1  # m, of the columns


def run_of(arguments, name, case, settings, body):
    """Particles of a body at the end of a run of a case with settings; none if it is not there and nothing is to be run."""
    run = arguments.folder / name
    if not arguments.table:
        run.parent.mkdir(parents=True, exist_ok=True)
        words = [word for setting in settings for word in ("--set", setting)]
        compute(arguments.whipple, run,
                [["run", case / "case.toml", "-o", run, "--force", "--quiet", "--threads", arguments.threads, *words]],
                [case / "case.toml", *case.glob("s*.toml")])
    return particles_of(run, body)


def surface(particles, cell, across):
    """Centres of columns one cell wide, and the height of the highest particle of each."""
    column = np.floor(particles["position"][:, 0] / across).astype(int)
    found = sorted(set(column))
    return (np.array(found) + 0.5) * across, np.array([particles["position"][column == c, 2].max() for c in found])


def repose(arguments):
    case = ROOT / "cases/slope_failure"
    soil = (case / "soil.toml").read_text(encoding="utf-8")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    sine = 2 * math.sqrt(3) * math.sin(math.radians(20)) / (3 + math.sin(math.radians(20)))
    print(f"plane flow of this cone: {math.degrees(math.asin(sine)):.2f} deg\n")
    print("| cohesion, kPa | cells, m | particles per cell | angle, deg | surface at 30 m, m | crest, m |\n" + 6 * "| --- " + "|")
    for cohesion in (0.1, 0.0):
        file = arguments.folder / f"soil_{cohesion:g}.toml"
        file.write_text(soil.replace('cohesion = "10 kPa"', f'cohesion = "{cohesion:g} kPa"'), encoding="utf-8")
        for cell in arguments.cells or [2.0, 1.0]:
            for per_cell in arguments.per_cell or [2, 3]:
                settings = [f"domain.cell_size='{cell:g} m'", f"domain.upper=['110 m', '{cell:g} m', '25 m']",
                            f"body.0.shape.union.0.box.upper=['110 m', '{cell:g} m', '0 m']",
                            f"body.0.shape.union.1.difference.from.box.upper=['50 m', '{cell:g} m', '20 m']",
                            f"body.0.material='{file}'",
                            f"body.0.discretization.per_cell={per_cell ** 3}"]
                found = run_of(arguments, f"repose_{cohesion:g}_{cell:g}_{per_cell}", case, settings, "ground")
                if found is None:
                    continue
                x, z = surface(found, cell, cell)
                z = z + 0.5 * cell / per_cell
                crest, ahead = z[x < 5].mean(), z[x > 100].mean()
                middle = (z < ahead + 0.75 * (crest - ahead)) & (z > ahead + 0.25 * (crest - ahead))
                slope = np.polyfit(x[middle], z[middle], 1)[0]
                print(f"| {cohesion:g} | {cell:g} | {per_cell}^3 | {math.degrees(math.atan(-slope)):.2f} | "
                      f"{np.interp(30.0, x, z):.2f} | {crest:.2f} |", flush=True)


def exponent(arguments):
    case = ROOT / "cases/dry_columns"
    print("| cells, mm | particles per cell | " + " | ".join(f"a = {a:g}" for a in ASPECTS)
          + " | exponent, all | exponent, a >= 0.7 |\n" + 8 * "| --- " + "|")
    for cell in arguments.cells or [0.008, 0.004]:
        for per_cell in arguments.per_cell or [2, 3]:
            outs = []
            for a in ASPECTS:
                height = a * RADIUS
                top = math.ceil((height + 0.02) / 0.008) * 0.008
                settings = [f"domain.cell_size='{cell:g} m'", f"domain.upper=['0.496 m', '0.496 m', '{top:g} m']",
                            f"body.0.shape.cylinder.center=['0 m', '0 m', '{0.5 * height:g} m']",
                            f"body.0.shape.cylinder.height='{height:g} m'",
                            f"body.0.discretization.per_cell={per_cell ** 3}"]
                found = run_of(arguments, f"column_{a:g}_{cell:g}_{per_cell}", case, settings, "sand")
                if found is None:
                    break
                radius = np.linalg.norm(found["position"][:, :2], axis=1)
                order = np.argsort(-radius)
                beyond = np.cumsum(found["mass"][order])
                front = radius[order][np.searchsorted(beyond, 0.01 * beyond[-1])]
                outs.append((front - RADIUS) / RADIUS)
            if len(outs) == len(ASPECTS):
                fits = [np.polyfit(np.log(ASPECTS[n:]), np.log(outs[n:]), 1)[0] for n in (0, 1)]
                print(f"| {1e3 * cell:g} | {per_cell}^2 | " + " | ".join(f"{out:.3f}" for out in outs)
                      + f" | {fits[0]:.3f} | {fits[1]:.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("repose", "exponent"))
    parser.add_argument("--cells", type=float, action="append")
    parser.add_argument("--per-cell", type=int, action="append")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/heaps")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"))
    arguments = parser.parse_args()
    {"repose": repose, "exponent": exponent}[arguments.what](arguments)


if __name__ == "__main__":
    main()
