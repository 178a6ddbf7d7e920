#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the lattice decide where a ring fails first? With partial volumes at its faces and with whole particles.

Usage: studies/crack_fragments/staircase.py [--whipple EXE]

The ring that coasts (cases/shell_fragmentation/ring.toml), three seeds of its scatter, until half a per cent of its particles have failed.
Whole particles make a staircase of a circle, whose steps repeat every 45 degrees: R8 = |mean of exp(8 i phi)| over the angles phi of the
failed particles, and R4 of exp(4 i phi), are 1 if all lie at the same step, and about 1/sqrt(number) if no direction is preferred. Runs
lie in run/studies/crack_fragments; those of the same program and the same case are kept.
"""
import argparse
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402
from studies.commands import compute  # noqa: E402
from studies.crack_fragments.crack_fragments import RUNS  # noqa: E402

CASE = ROOT / "cases/shell_fragmentation/ring.toml"
END, EVERY = 20.0, 0.5  # us
FAILED = 0.005          # of the particles


def harmonic(angles, order):
    """Size of the mean of exp(i order phi) over angles (rad): 1 where all are equal but for multiples of 2 pi/order."""
    return abs(np.exp(1j * order * np.asarray(angles)).mean())


def first_failures(folder):
    """Time (us) of the first snapshot in which enough has failed, and the angles (rad) of the failed particles."""
    for time in np.arange(0.0, END + 0.5 * EVERY, EVERY):
        found = particles_of(folder, "ring", 1e-6 * (time + 0.1 * EVERY))
        own = found["failed"] > 0
        if own.mean() > FAILED:
            return time, np.arctan2(found["position"][own, 1], found["position"][own, 0])
    sys.exit(f"{folder}: less than {100 * FAILED:g} % of the ring has failed by {END:g} us")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"))
    arguments = parser.parse_args()
    print("| particles | cells mm | seed | first failures at, us | number | R4 | R8 | 1/sqrt(number) |\n" + "| --- " * 8 + "|")
    for cell in ("0.666667", "0.333333"):
        for partial, label in (("true", "partial volumes"), ("false", "whole")):
            for seed in (1, 2, 3):
                folder = RUNS / f"staircase_{cell}_{partial}_{seed}"
                words = [f"domain.cell_size={cell} mm", f"body.0.discretization.partial_volumes={partial}",
                         f"body.0.failure_scatter.seed={seed}", f"time.end={END:g} us", f"output.snapshot_every={EVERY:g} us"]
                settings = [word for text in words for word in ("--set", text)]
                compute(arguments.whipple, folder, [["run", CASE, "-o", folder, "--force", "--quiet", "--threads", "1", *settings]],
                        [CASE, *CASE.parent.glob("*.toml")])
                time, angles = first_failures(folder)
                print(f"| {label} | {float(cell):.3g} | {seed} | {time:g} | {len(angles)} | {harmonic(angles, 4):.2f} | "
                      f"{harmonic(angles, 8):.2f} | {len(angles) ** -0.5:.2f} |", flush=True)


if __name__ == "__main__":
    main()
