#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What do velocity fields at cracks change in cases that have no string of failed particles to cure: bars, spall, debris clouds, rings?

Usage: studies/crack_fragments/fields_in_cases.py [--table] [--whipple EXE] [NAME...]

Every row is a run of a case with and without `failure.cracks = "fields"`. --table runs nothing; names choose rows. Runs lie in
run/studies/fields_in_cases; those of the same program, words and case files are kept. Printed: the measures of the rows, failed and
loose shares, the largest error of energy and momentum, and the time of a step.
"""
import argparse
import dataclasses
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.expectations import Case  # noqa: E402
from report.measured import Measures  # noqa: E402
from studies.commands import compute  # noqa: E402

RUNS = ROOT / "run/studies/fields_in_cases"
FIELDS = ("none", "fields")


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    case: str              # file in cases/
    bodies: tuple          # names of the bodies whose cracks part, in the order of the case
    measures: tuple        # of the report
    run: str = ""          # of expected.toml; empty: the case as it stands
    cell: str = ""         # mm; empty: that of the run
    assignments: tuple = ()

    @property
    def file(self):
        return ROOT / "cases" / self.case

    def words(self, fields):
        """Assignments of the run with these fields."""
        words = Case(self.file.parent / "expected.toml").run_of(self.run).assignments("normal") if self.run else []
        words += [f"domain.cell_size={self.cell} mm"] if self.cell else []
        return [*words, *self.assignments, *(f"body.{n}.failure.cracks={fields}" for n in range(len(self.bodies)))]


BAR = ("length.bar", "foot_diameter.bar")
SPALL = ("pullback.target", "spall_thickness.target")
CLOUD = ("front_speed_over_impact_speed", "largest_fragment_over_projectile", "radial_speed_over_impact_speed")
SLICE = ("domain.dimension=3d", 'domain.lower=["-60 mm","-60 mm","0 mm"]', 'domain.upper=["60 mm","60 mm","2 mm"]',
         'domain.boundary={ z_lower = "symmetry", z_upper = "symmetry" }', "time.end=32 us",
         'body.0.shape={ tube = { base = ["0 mm", "0 mm", "0 mm"], axis = "z", height = "2 mm", inner_radius = "20 mm", '
         'outer_radius = "22 mm" } }', "body.0.failure_scatter.reference_volume=785 mm^3")
# A quarter costs a quarter; the report counts the pieces of the whole. The table of decision 20 is older: there it counted those of a half,
# doubled by hand.
QUARTER = ('domain.lower=["0 mm","0 mm"]', 'domain.upper=["90 mm","90 mm"]', "time.end=36 us", "output.snapshot_every=4 us",
           'domain.boundary={ x_lower = "symmetry", y_lower = "symmetry" }', "body.1.material=steel_45_tearing.toml")
ROWS = [Row(f"bar_{run}", "taylor_bars/case.toml", ("bar",), BAR, run=f"{run}_axisymmetric") for run in ("cu_z1_210", "cu_z5_225")]
ROWS += [Row(f"spall_{run}", "plate_impact_spall/case.toml", ("flyer", "target"), SPALL, run=run)
         for run in ("500_m_s", "copper_308", "titanium_653")]
ROWS += [Row(f"cloud_{cell}", "piekutowski_clouds/case.toml", ("sphere", "bumper"), CLOUD, run="t_D_0_163_axisymmetric", cell=cell)
         for cell in ("0.2", "0.1")]
ROWS += [Row(f"ring_3d_{float(cell):.3g}", "shell_fragmentation/ring.toml", ("ring",), ("piece_count.ring",), cell=cell, assignments=SLICE)
         for cell in ("0.6666666666667", "0.5", "0.3333333333333")]
ROWS += [Row(f"shell_quarter_{cell}", "shell_fragmentation/section.toml", ("charge", "shell"), ("piece_count.shell",), cell=cell,
             assignments=QUARTER) for cell in ("0.8", "0.4", "0.2")]


def run_row(row, fields, whipple):
    """Runs and analyses a row unless that was done before."""
    folder = RUNS / f"{row.name}_{fields}"
    words = [word for text in row.words(fields) for word in ("--set", text)]
    compute(whipple, folder, [["run", row.file, "-o", folder, "--force", "--quiet", "--threads", "1", *words],
                              ["analyse", folder, "--radiographs", "1", "--quiet"]], sorted(row.file.parent.glob("*.toml")))


def line(row, fields):
    """Line of the table; none if the row was not computed."""
    folder = RUNS / f"{row.name}_{fields}"
    if not (folder / "report/quantities.csv").is_file():
        return []
    single = Measures(folder).single
    profile = json.loads((folder / "profile.json").read_text(encoding="utf-8"))
    per_step = 1e9 * profile["wall_seconds"] / profile["steps"] / profile["particles"]
    values = "; ".join(f"{name} {single[name]:.5g}" for name in row.measures if name in single)
    of = row.bodies[-1] if not row.name.startswith("cloud") else "sphere"
    failed, loose = (100.0 * single[f"{kind}.{of}{part}"] for kind, part in (("failed_fraction", ".whole"), ("loose_fraction", "")))
    return [f"| {row.name} | {fields} | {values} | {failed:.3f} | {loose:.2f} | {single['energy_error']:.1e} | "
            f"{single['momentum_error']:.1e} | {per_step:.0f} |"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - {row.name for row in ROWS}
    if unknown:
        parser.error(f"no row {', '.join(sorted(unknown))}; rows: {', '.join(row.name for row in ROWS)}")
    print("| row | fields | measures | failed % | loose % | energy | momentum | ns per particle and step |")
    print("| --- " * 8 + "|")
    for row in ROWS:
        for fields in FIELDS:
            if arguments.names and row.name not in arguments.names:
                continue
            if not arguments.table:
                run_row(row, fields, arguments.whipple)
            print("\n".join(line(row, fields)), end="\n" if line(row, fields) else "", flush=True)


if __name__ == "__main__":
    main()
