#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a case over many positions of its lattice: what of a distribution belongs to the single run?

Usage: studies/fragment_ensemble/fragment_ensemble.py CASE:RUN [--resolution coarse] [--members 100]

Every member is the run with its lattice moved by a random part of a cell along the axes that the `offsets` of the case's [band]
name (docs/manual/expected_results.md); all else is equal. Runs of the same program and case are kept. Printed: mean over the members,
its standard error, standard deviation, and the interval that holds 95 % of the members; the numbers of fragments N(>m) at equal
steps of log m. Members lie in run/studies/fragment_ensemble.
"""
import argparse
import csv
import pathlib
import random
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import compute  # noqa: E402
from studies.validation.cases import BadExpectation, Measures  # noqa: E402
from studies.validation.execution import select  # noqa: E402
from studies.validation.variants import PLACE, placed  # noqa: E402

# Measures of the analysis (docs/manual/output.md) and the words of the table.
MEASURES = {"debris_fragments_resolved": "fragments of eight particles or more", "largest_fragment_over_projectile":
            "largest fragment over the mass of the projectile", "fragment_exponent": "exponent b of N(>m) ~ m^-b",
            "front_speed_over_impact_speed": "speed of the front over the impact speed"}


def offset(run, cell, generator):
    """Returns assignments that move the lattice by random parts of a cell, after the first of the band's offsets."""
    if not run.band or not run.band.offsets:
        raise BadExpectation(f"{run.case.name}: [band] has no offsets: the lattice cannot be moved")
    return [placed(PLACE.sub(lambda m: f"{{{m[1]} {m[2]} {generator.random():.6f} cell}} {m[4]}", text), cell)
            for text in run.band.offsets[0]]


def run_member(whipple, run, resolution, folder, assignments):
    """Runs and analyses a member unless that was done before."""
    command = ["run", run.case.file, "-o", folder, "--force", "--quiet", "--threads", "1"]
    for text in [*run.assignments(resolution), *assignments]:
        command += ["--set", text]
    compute(whipple, folder, [command, ["analyse", folder, "--quiet", *run.analyse]], sorted(run.case.file.parent.glob("*.toml")))
    for snapshot in folder.glob("*.hdf"):
        snapshot.unlink()


def numbers(folder):
    """Reads the measures of a member by name, and masses and numbers N(>=m) of its debris fragments."""
    with (folder / "report" / "fragment_distribution.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    return Measures(folder).single, np.array([[float(row["mass [kg]"]), float(row["number [1]"])] for row in rows]).reshape(-1, 2)


def number_above(distribution, mass):
    """Returns the number of fragments of at least a mass; `distribution`: masses in falling order, numbers up to each."""
    above = distribution[distribution[:, 0] >= mass]
    return above[-1, 1] if len(above) else 0.0


def statistics(values):
    """Returns mean, standard error of the mean, standard deviation and the bounds of the 95 % in the middle."""
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    if len(values) < 2:
        return (np.nan,) * 5
    spread = values.std(ddof=1)
    return (values.mean(), spread / np.sqrt(len(values)), spread, *np.quantile(values, (0.025, 0.975)))


def tables(members):
    """Returns the lines of both tables; `members`: what `numbers` returns of each."""
    lines = ["| | mean | standard error | standard deviation | 95 % of the members |", "| --- | --- | --- | --- | --- |"]
    for name, words in MEASURES.items():
        mean, error, spread, low, high = statistics([single.get(name, np.nan) for single, _ in members])
        lines.append(f"| {words} | {mean:.4g} | {error:.2g} | {spread:.2g} | {low:.4g} to {high:.4g} |")
    heaviest = max(distribution[0, 0] for _, distribution in members if len(distribution))
    lines += ["", "| mass m, g | N(>m), mean | standard deviation | 95 % of the members |", "| --- | --- | --- | --- |"]
    for mass in heaviest * 10.0 ** -np.arange(0.5, 4.01, 0.5):
        mean, _, spread, low, high = statistics([number_above(distribution, mass) for _, distribution in members])
        lines.append(f"| {1e3 * mass:.3g} | {mean:.4g} | {spread:.2g} | {low:.4g} to {high:.4g} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", metavar="CASE:RUN")
    parser.add_argument("--resolution", choices=("coarse", "normal", "fine"), default="coarse")
    parser.add_argument("--members", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--whipple", default="whipple")
    arguments = parser.parse_args()
    try:
        (case, run), *more = select([arguments.run])
        if more or arguments.members < 2:
            parser.error("one run as CASE:RUN and two members or more")
        generator, members = random.Random(arguments.seed), []
        top = ROOT / "run" / "studies" / "fragment_ensemble" / f"{case.name}.{run.name}.{arguments.resolution}"
        for i in range(arguments.members):
            moved = offset(run, run.cells(arguments.resolution), generator)
            folder = top / f"{arguments.seed}.{i + 1:03d}"
            run_member(arguments.whipple, run, arguments.resolution, folder, moved)
            members.append(numbers(folder))
            print(f"{i + 1} of {arguments.members}", end="\r", file=sys.stderr, flush=True)
    except BadExpectation as error:
        sys.exit(f"fragment_ensemble.py: error: {error}")
    print(f"{case.title}, {run.title}: {len(members)} members, cells of {run.cell_size[arguments.resolution]}\n")
    print("\n".join(tables(members)))


if __name__ == "__main__":
    main()
