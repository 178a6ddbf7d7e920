#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fragments with and without cracks as velocity fields: do numbers, loose mass and failed mass converge with the cells?

Usage: studies/crack_fragments/crack_fragments.py [--long] [--table] [NAME...]

The rows are runs of cases/shell_fragmentation: the ring that coasts (ring.toml) with and without fields, by cell size and seed, and
the shell (section.toml) with softening in tension. --long: also those that take more than a few minutes each. --table runs nothing;
names choose rows. Runs lie in run/studies/crack_fragments; those that are there are kept. Printed: the rows
(docs/theory/analysis.md, section 3), mean and standard deviation over the seeds, and Mott's statistics with the scatter of the ring.
"""
import argparse
import csv
import dataclasses
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.measured import Measures  # noqa: E402
from report.pieces import masses_of_run, weibull_exponent  # noqa: E402
from studies.commands import call, cell_size  # noqa: E402
from studies.crack_fragments import mott  # noqa: E402

RUNS = ROOT / "run/studies/crack_fragments"
PERIMETER = {"ring": 2.0 * np.pi * 21e-3, "shell": 2.0 * np.pi * 22e-3}  # m, of the middle of the wall at the start
TEARING = "steel_45_tearing.toml"


@dataclasses.dataclass(frozen=True)
class Row:
    body: str
    fields: str
    cell: str  # mm
    seed: int = 1
    tearing: bool = False
    long: bool = False

    @property
    def name(self):
        return f"{self.body}_{'tearing_' if self.tearing else ''}{self.fields}_{self.cell}_seed_{self.seed}"

    @property
    def case(self):
        return ROOT / "cases/shell_fragmentation" / ("ring.toml" if self.body == "ring" else "section.toml")

    @property
    def assignments(self):
        number = 0 if self.body == "ring" else 1
        words = [f"domain.cell_size={self.cell} mm", f"body.{number}.failure.cracks={self.fields}",
                 f"body.{number}.failure_scatter.seed={self.seed}"]
        if self.tearing:
            words.append(f"body.{number}.material={TEARING}")
        if self.body == "shell":  # until all gaps are open
            words += ["time.end=40 us", "output.snapshot_every=4 us", 'domain.lower=["-90 mm","-90 mm"]', 'domain.upper=["90 mm","90 mm"]']
        return words


ROWS = [Row("ring", fields, cell, long=cell == "0.166667") for cell in ("0.666667", "0.333333", "0.166667") for fields in ("none", "fields")]
ROWS += [Row("ring", fields, "0.333333", seed) for fields in ("none", "fields") for seed in (2, 3, 4, 5)]
ROWS += [Row("ring", "fields", cell, tearing=True) for cell in ("0.666667", "0.333333")]
ROWS += [Row("shell", "none", "0.8", tearing=True), Row("shell", "fields", "0.8", tearing=True),
         Row("shell", "fields", "0.4", tearing=True, long=True), Row("shell", "fields", "0.2", tearing=True, long=True)]


def compute(row):
    """Runs and analyses a row unless that was done before."""
    folder = RUNS / row.name
    whipple = ROOT / "build/release/bin/whipple"
    if not (folder / "report/pieces_by_distance.csv").is_file():
        words = [word for text in row.assignments for word in ("--set", text)]
        call([whipple, "run", row.case, "-o", folder, "--force", "--quiet", "--threads", "1", *words])
        call([whipple, "analyse", folder, "--by-distance", "--radiographs", "1", "--quiet"])


def measure(row):
    """Values of a row: number of fragments, failed, loose, width of a crack in cells, numbers by distance, exponent; None if it was not
    computed."""
    folder = RUNS / row.name
    if not (folder / "report/pieces_by_distance.csv").is_file():
        return None
    single = Measures(folder).single
    number, failed = single[f"piece_count.{row.body}"], single[f"failed_fraction.{row.body}.whole"]
    with (folder / "report/pieces_by_distance.csv").open(newline="") as stream:
        distance = [float(line["pieces [1]"]) for line in csv.DictReader(stream) if line["body"] == row.body]
    width = failed * PERIMETER[row.body] / (number * cell_size(folder)) if number > 0 else np.nan
    return number, failed, single[f"loose_fraction.{row.body}"], width, distance, weibull_exponent(masses_of_run(folder, row.body))


def lines(rows):
    """Lines of the table, and of the means over seeds."""
    text = ["| body | failure | fields | cells mm | seed | failed % | fragments | width of a crack, cells | loose % | by distance | exponent b |",
            "| --- " * 11 + "|"]
    by_seed = {}
    for row in rows:
        found = measure(row)
        if found is None:
            continue
        number, failed, loose, width, distance, (b, error) = found
        failure = "tearing" if row.tearing else "plastic strain"
        text.append(f"| {row.body} | {failure} | {row.fields} | {float(row.cell):.3g} | {row.seed} | {100 * failed:.1f} | {number:g} | "
                    f"{width:.2f} | {100 * loose:.2f} | {', '.join(f'{n:g}' for n in distance)} | {b:.2f} +- {error:.2f} |")
        by_seed.setdefault((row.body, failure, row.fields, row.cell), []).append((number, 100 * loose))
    for (body, failure, fields, cell), values in by_seed.items():
        if len(values) > 1:
            numbers, loose = np.array(values).T
            text.append(f"{body}, {failure}, {fields}, {float(cell):.3g} mm, {len(values)} seeds: {numbers.mean():.1f} +- "
                        f"{numbers.std(ddof=1):.1f} fragments, loose {loose.mean():.2f} %")
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    chosen = [row for row in ROWS if row.name in arguments.names or not arguments.names]
    unknown = set(arguments.names) - {row.name for row in ROWS}
    if unknown:
        parser.error(f"no row {', '.join(sorted(unknown))}; rows: {', '.join(row.name for row in ROWS)}")
    if not arguments.table:
        for row in chosen:
            if arguments.long or not row.long or arguments.names:
                compute(row)
    print("\n".join(lines(chosen)))
    for delay in (0.0, 0.4e-6):
        numbers = np.array([mott.fragments(seed, delay=delay) for seed in range(1, 21)])
        print(f"Mott, unloading {1e6 * delay:g} us after the limit: {numbers.mean():.1f} +- {numbers.std(ddof=1):.1f}, 20 seeds")


if __name__ == "__main__":
    main()
