#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Why does the internal energy that a debris cloud keeps rise with finer cells?

usage: released_heat.py [--cells 0.4 0.2 0.1] [--table] [--folder run/studies/released_heat] [--threads N] [--whipple EXE]

Section of cases/copper_disk_on_aluminium at 10 us (cells in mm: 28, 56 and 112 across the disk): with the materials of the library,
and without their strength. Energies in J of a quarter of the problem, as the case has it; failed and melted
fraction of the copper. Runs of the same program and the same materials are kept; --table runs nothing.
"""
import argparse
import csv
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import compute  # noqa: E402

CASE = ROOT / "cases/copper_disk_on_aluminium/case.toml"
NAMES = ("copper", "aluminium")  # of the disk, of the plate
LEFT_OUT = {"library": "", "no strength": '[strength]\nmodel = "none"\nsource = "left out"\n'}
COLUMNS = ("internal_energy", "plastic_work", "viscous_work", "unresolved_energy", "kinetic_energy")


def materials_of(variant, folder):
    """Files of disk and plate, with what the variant leaves out."""
    files = []
    for name in NAMES:
        file = folder / f"{name}_{variant.replace(' ', '_')}.toml"
        file.write_text(f'base = "{name}"\nname = "{name}, {variant}"\nsource = "{name} of the library"\n{LEFT_OUT[variant]}', encoding="utf-8")
        files.append(file)
    return files


def last_row(run):
    """Quantities of the last row of history.csv, by name without unit."""
    with (run / "history.csv").open(newline="") as stream:
        *_, row = csv.DictReader(stream)
    return {name.split(" [")[0]: float(value) for name, value in row.items() if name != "dt_bound [1]"}


def failed_fraction(run):
    """Of the copper, by mass."""
    with (run / "report/bodies.csv").open(newline="") as stream:
        return next(float(row["failed_fraction [1]"]) for row in csv.DictReader(stream) if row["body part"] == "disk whole")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=float, nargs="+", default=[0.4, 0.2, 0.1], help="mm")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/released_heat")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    print("| materials | cells, mm | internal | plastic work | viscous work | unresolved | kinetic | copper failed, % | copper not solid, % |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for variant in LEFT_OUT:
        for cell in arguments.cells:
            run = folder / f"{variant.replace(' ', '_')}_{cell:g}"
            if not arguments.table:
                files = materials_of(variant, folder)
                sets = ["domain.dimension=axisymmetric", "domain.axis=z", f"domain.cell_size={cell:g} mm",
                        *(f"body.{n}.material={file}" for n, file in enumerate(files))]
                compute(arguments.whipple, run, [["run", CASE, "--output", run, "--force", "--quiet", "--threads", arguments.threads,
                                                  *(word for entry in sets for word in ("--set", entry))], ["analyse", run]], [CASE, *files])
            if (run / "report/bodies.csv").is_file():
                row = last_row(run)
                disk = {phase: row[f"mass_{phase}.disk"] for phase in ("solid", "melting", "liquid", "vapour")}
                print(f"| {variant} | {cell:g} | {' | '.join(f'{row[name] / 4:.0f}' for name in COLUMNS)} | {100 * failed_fraction(run):.1f} | "
                      f"{100 * (1 - disk['solid'] / sum(disk.values())):.2f} |", flush=True)


if __name__ == "__main__":
    main()
