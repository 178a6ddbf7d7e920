#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a shell or ring: into how many pieces does it break, and how are their masses distributed?

Usage: studies/shell_fragmentation/shell_fragmentation.py RUN... [--body shell] [--link 1.5]

Of the last snapshot of each run: pieces of the body's particles that have not failed, connected where they are closer than
`link` cells (stretched material has parted to more than a cell, a crack opens to several); failed particles are dust. The mean
mass is that of pieces of more than three particles. Masses follow N(>m) = N exp(-(m/m_c)^b): b by maximum likelihood (the
Weibull distribution), with its standard error. Runs of one cell size, which differ in the seed, are also taken together.
"""
import argparse
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.pieces import LINK, fragments_of, weibull_exponent  # noqa: E402

def line(name, masses, dust, small):
    b, error = weibull_exponent(masses)
    mean = masses.mean() if len(masses) else np.nan
    return (f"| {name} | {len(masses)} | {1e3 * mean:.4g} | {1e3 * max(masses, default=np.nan):.4g} | {b:.2f} +- {error:.2f} | "
            f"{100 * dust:.1f} | {100 * small:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    parser.add_argument("--body", default="shell")
    parser.add_argument("--link", type=float, default=LINK)
    arguments = parser.parse_args()
    print("| run | pieces | mean mass, g | largest, g | exponent b | dust, % | pieces of 1 to 3 particles, % |")
    print("| --- " * 7 + "|")
    by_cell = {}
    for folder in arguments.runs:
        cell, masses, dust, small = fragments_of(folder, arguments.body, arguments.link)
        print(line(folder.name, masses, dust, small))
        by_cell.setdefault(cell, []).append((masses, dust, small))
    for cell, found in by_cell.items():
        if len(found) > 1:
            name = f"all of {1e3 * cell:.4g} mm: {len(found)}"
            print(line(name, np.concatenate([masses for masses, _, _ in found]), *np.mean([rest for _, *rest in found], axis=0)))


if __name__ == "__main__":
    main()
