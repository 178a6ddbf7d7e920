#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a shell or ring: into how many pieces does it break, and how are their masses distributed?

Usage: studies/shell_fragmentation/shell_fragmentation.py RUN... [--body shell]

Of the last snapshot of each run, as `whipple analyse` measured it (docs/theory/analysis.md, section 3). Masses follow
N(>m) = N exp(-(m/m_c)^b): b by maximum likelihood (the Weibull distribution), with its standard error. Runs of one cell size,
which differ in the seed, are also taken together.
"""
import argparse
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.measured import Measures  # noqa: E402
from report.expectations import BadExpectation  # noqa: E402
from report.pieces import masses_of_run  # noqa: E402
from studies.fragment_statistics import joined, weibull_exponent  # noqa: E402
from studies.commands import cell_size  # noqa: E402


def line(name, masses, failed, loose):
    b, error = weibull_exponent(masses)
    return (f"| {name} | {masses.number} | {1e3 * masses.mean:.4g} | {1e3 * masses.largest:.4g} | {b:.2f} +- {error:.2f} | "
            f"{100 * failed:.1f} | {100 * loose:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    parser.add_argument("--body", default="shell")
    arguments = parser.parse_args()
    print("| run | fragments | mean mass, g | largest, g | exponent b | failed, % | in no fragment, % |")
    print("| --- " * 7 + "|")
    by_cell = {}
    for folder in arguments.runs:
        try:
            measures = Measures(folder).single
        except BadExpectation as error:
            sys.exit(str(error))
        shares = measures[f"failed_fraction.{arguments.body}.whole"], measures[f"loose_fraction.{arguments.body}"]
        masses = masses_of_run(folder, arguments.body)
        print(line(folder.name, masses, *shares))
        by_cell.setdefault(cell_size(folder), []).append((masses, *shares))
    for cell, found in by_cell.items():
        if len(found) > 1:
            name = f"all of {1e3 * cell:.4g} mm: {len(found)}"
            print(line(name, joined([masses for masses, _, _ in found]), *np.mean([rest for _, *rest in found], axis=0)))


if __name__ == "__main__":
    main()
