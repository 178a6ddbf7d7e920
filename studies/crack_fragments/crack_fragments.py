#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fragments with and without cracks as velocity fields: do numbers, loose mass and failed mass converge with the cells?

Usage: studies/crack_fragments/crack_fragments.py [--long] [--table] [--whipple EXE] [NAME...]

The rows are runs of cases/shell_fragmentation: the ring that coasts (ring.toml) with and without fields, by cell size and seed; the same
unrolled as a bar of one cell across, which a crack parts without a way through a wall; and the shell with softening in tension, in plane
strain (section.toml) and as a slice in three dimensions (case.toml). --long: also those that take more than a few minutes each. --table
runs nothing; names choose rows. Runs lie in run/studies/crack_fragments; those of the same program and the same case are kept. Printed:
the rows (docs/theory/analysis.md, section 3), mean and standard deviation over the seeds, the energy of the cracks that tear, and Mott's
statistics with the scatter of the ring. Width of a crack: failed share times perimeter over the number of fragments. The energy is from
the damage D of all particles, whose work per volume is (2 D - D^2) Gamma/h in the law `tearing`, h a cell (docs/theory/material.md, 5.1).
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
from report.pieces import masses_of_run  # noqa: E402
from studies.fragment_statistics import weibull_exponent  # noqa: E402
from report.particles import particles_of  # noqa: E402
from studies.commands import cell_size, compute  # noqa: E402
from studies.crack_fragments import mott  # noqa: E402

RUNS = ROOT / "run/studies/crack_fragments"
LATE = (24, 28, 32, 36, 40)  # us, of the shell
ROOM = {"shell": ['domain.lower=["-90 mm","-90 mm"]', 'domain.upper=["90 mm","90 mm"]'],  # whole cells of every size of its rows
        "slice": ['domain.lower=["-96 mm","-96 mm","0 mm"]', 'domain.upper=["96 mm","96 mm","1.6 mm"]']}
CASE = {"ring": "ring.toml", "bar": "ring.toml", "shell": "section.toml", "slice": "case.toml"}
WALL = {"ring": 2e-3, "shell": 4e-3}  # m, thickness at the start, in plane strain
PERIMETER = {"ring": 2.0 * np.pi * 21e-3, "shell": 2.0 * np.pi * 22e-3, "slice": 2.0 * np.pi * 22e-3}
PERIMETER["bar"] = PERIMETER["ring"]  # m, of the middle of the wall
TEARING = {65: "steel_45_tearing.toml", 13: "steel_45_toughness.toml"}  # material by the energy of a crack, kJ/m^2


def bar_of(cell):
    """Assignments that make of the ring a bar of its length, one cell (mm) across, with free ends; scatter per length as in the ring of 2 mm."""
    half, ring = 500.0 * PERIMETER["ring"], 3.925e-4  # mm; m^3, reference volume of the ring
    return [f'body.0.shape={{ box = {{ lower = ["-{half:.6g} mm","-{cell / 2:.6g} mm"], upper = ["{half:.6g} mm","{cell / 2:.6g} mm"] }} }}',
            'body.0.expansion_rate=["4.0476e4 1/s","0 1/s","0 1/s"]', f"body.0.failure_scatter.reference_volume={ring * cell / 2:.6g} m^3",
            'domain.lower=["-180 mm","-4 mm"]', 'domain.upper=["180 mm","4 mm"]']


@dataclasses.dataclass(frozen=True)
class Row:
    body: str
    fields: str
    cell: str  # mm
    seed: int = 1
    tearing: int = 0  # energy of a crack, kJ/m^2, 0: the law plastic_strain
    long: bool = False

    @property
    def name(self):
        law = {0: "", 65: "tearing_"}.get(self.tearing, f"tearing_{self.tearing}_")
        return f"{self.body}_{law}{self.fields}_{self.cell}_seed_{self.seed}"

    @property
    def failure(self):
        return f"`tearing`, {self.tearing} kJ/m2" if self.tearing else "`plastic_strain`"

    @property
    def label(self):
        return "cracks" if self.fields == "fields" else "none"

    @property
    def case(self):
        return ROOT / "cases/shell_fragmentation" / CASE[self.body]

    @property
    def part(self):
        """Name of the body that breaks."""
        return "ring" if self.body in ("ring", "bar") else "shell"

    @property
    def assignments(self):
        number = 0 if self.part == "ring" else 1
        words = [f"domain.cell_size={self.cell} mm", f"body.{number}.failure.cracks={self.fields}",
                 f"body.{number}.failure_scatter.seed={self.seed}"]
        if self.tearing:
            words += [f"body.{number}.material={TEARING[self.tearing]}", 'output.fields=["density","failed","damage"]']
        if self.body == "bar":
            words += bar_of(float(self.cell))
        if self.part == "shell":  # until all gaps are open
            words += ["time.end=40 us", "output.snapshot_every=4 us", *ROOM[self.body]]
        return words


ROWS = [Row("ring", fields, cell, long=cell == "0.166667") for cell in ("0.666667", "0.333333", "0.166667") for fields in ("none", "fields")]
ROWS += [Row("ring", fields, "0.333333", seed) for fields in ("none", "fields") for seed in (2, 3, 4, 5)]
ROWS += [Row("ring", "fields", "0.166667", seed, long=True) for seed in (2, 3, 4, 5)]
ROWS += [Row("ring", "fields", cell, tearing=energy) for energy in TEARING for cell in ("0.666667", "0.333333")]
ROWS += [Row("shell", "none", "0.8", tearing=65), Row("shell", "fields", "0.8", tearing=65),
         Row("shell", "fields", "0.4", tearing=65, long=True), Row("shell", "fields", "0.2", tearing=65, long=True),
         Row("shell", "fields", "0.8", tearing=13), Row("shell", "fields", "0.4", tearing=13, long=True)]
ROWS += [Row("bar", "fields", cell, seed) for cell in ("0.666667", "0.333333", "0.166667") for seed in (1, 2, 3, 4, 5)]
ROWS += [Row("slice", fields, cell, tearing=65, long=True) for cell in ("0.8", "0.533333") for fields in ("none", "fields")]


def run_row(row, whipple):
    """Runs and analyses a row unless that was done before."""
    folder = RUNS / row.name
    words = [word for text in row.assignments for word in ("--set", text)]
    compute(whipple, folder, [["run", row.case, "-o", folder, "--force", "--quiet", "--threads", "1", *words],
                              ["analyse", folder, "--by-distance", "--radiographs", "1", "--quiet"]],
            [row.case, *row.case.parent.glob("*.toml")])


def crack_energy(row):
    """Energy of the cracks of a row that tears over Gamma times the initial thickness of the wall and the number of fragments, each of
    which ends at one more crack; NaN of other laws. damage: D of its particles."""
    folder = RUNS / row.name
    found = particles_of(folder, row.part)
    if not row.tearing or row.body not in WALL or found is None or "damage" not in found:
        return np.nan
    damage, volume = found["damage"].astype(float), found["mass"] / mott.Ring.density  # of a metre along z
    area = ((2 * damage - damage**2) * volume).sum() / cell_size(folder)
    return area / (WALL[row.body] * Measures(folder).single[f"piece_count.{row.part}"])


@dataclasses.dataclass(frozen=True)
class Found:
    number: float
    failed: float
    loose: float
    width: float             # of a crack, cells
    by_distance: list
    exponent: tuple          # with its error
    over_time: list          # number at each of LATE
    energy: float            # of cracks, Gamma


def measure(row):
    """What a row shows; None if it was not computed."""
    folder = RUNS / row.name
    if not (folder / "report/pieces_by_distance.csv").is_file():
        return None
    measures = Measures(folder)
    single = measures.single
    number, failed = single[f"piece_count.{row.part}"], single[f"failed_fraction.{row.part}.whole"]
    with (folder / "report/pieces_by_distance.csv").open(newline="") as stream:
        distance = [float(line["pieces [1]"]) for line in csv.DictReader(stream) if line["body"] == row.part]
    width = failed * PERIMETER[row.body] / (number * cell_size(folder)) if number > 0 else np.nan
    numbers = dict(zip(np.round(1e6 * np.array(measures.series["time"])), measures.series[f"piece_count.{row.part}"]))
    return Found(number, failed, single[f"loose_fraction.{row.part}"], width, distance, weibull_exponent(masses_of_run(folder, row.part)),
                 [numbers.get(time, np.nan) for time in LATE], crack_energy(row))


def ring_lines(found):
    """Table of the rings, and means over seeds."""
    text = ["| failure | fields | cells mm | seed | failed % | fragments | width of a crack, cells | loose % | by distance | exponent b |",
            "| --- " * 10 + "|"]
    by_seed = {}
    for row, f in found:
        text.append(f"| {row.failure} | {row.label} | {float(row.cell):.3g} | {row.seed} | {100 * f.failed:.1f} | {f.number:g} | "
                    f"{f.width:.2f} | {100 * f.loose:.2f} | {joined(f.by_distance)} | {f.exponent[0]:.2f} +- {f.exponent[1]:.2f} |")
        by_seed.setdefault((row.failure, row.label, row.cell), []).append((f.number, 100 * f.loose))
    for (failure, label, cell), values in by_seed.items():
        if len(values) > 1:
            numbers, loose = np.array(values).T
            text.append(f"{failure}, {label}, {float(cell):.3g} mm, {len(values)} seeds: {numbers.mean():.1f} +- "
                        f"{numbers.std(ddof=1):.1f} fragments, loose {loose.mean():.2f} %")
    return text


def shell_lines(found):
    """Table of the shells: the mean fragment in mm of the initial perimeter, of a slice as if no crack ran around."""
    text = [f"| | Gamma, kJ/m2 | fields | cells mm | failed % | fragments at {joined(LATE)} us | loose % | by distance, 40 us | mean, mm of perimeter | "
            "exponent b |", "| --- " * 10 + "|"]
    for row, f in found:
        mean = 1e3 * PERIMETER[row.body] * (1 - f.loose) / f.number if f.number > 0 else np.nan
        kind = "slice" if row.body == "slice" else "section"
        text.append(f"| {kind} | {row.tearing} | {row.label} | {float(row.cell):.3g} | {100 * f.failed:.1f} | {joined(f.over_time)} | {100 * f.loose:.2f} | "
                    f"{joined(f.by_distance)} | {mean:.2f} | {f.exponent[0]:.2f} +- {f.exponent[1]:.2f} |")
    return text


def joined(numbers):
    return ", ".join(f"{number:g}" for number in numbers)


def lines(rows):
    """What was found of the rows that were computed."""
    found = [(row, f) for row in rows if (f := measure(row)) is not None]
    text = []
    for bodies, table in ((("ring",), ring_lines), (("bar",), ring_lines), (("shell", "slice"), shell_lines)):
        own = [(row, f) for row, f in found if row.body in bodies]
        text += [f"{' and '.join(bodies)}:", *table(own), ""] if own else []
    return text + [f"{row.name}: energy of a crack {f.energy:.2f} Gamma per area" for row, f in found if np.isfinite(f.energy)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"))
    arguments = parser.parse_args()
    chosen = [row for row in ROWS if row.name in arguments.names or not arguments.names]
    unknown = set(arguments.names) - {row.name for row in ROWS}
    if unknown:
        parser.error(f"no row {', '.join(sorted(unknown))}; rows: {', '.join(row.name for row in ROWS)}")
    if not arguments.table:
        for row in chosen:
            if arguments.long or not row.long or arguments.names:
                run_row(row, arguments.whipple)
    print("\n".join(lines(chosen)))
    for delay in (0.0, 0.4e-6):
        numbers = np.array([mott.fragments(seed, delay=delay) for seed in range(1, 21)])
        print(f"Mott, unloading {1e6 * delay:g} us after the limit: {numbers.mean():.1f} +- {numbers.std(ddof=1):.1f}, 20 seeds")


if __name__ == "__main__":
    main()
