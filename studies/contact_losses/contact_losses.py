#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What contact takes from the resolved motion: a copper sphere on copper, of particles and of elements.

usage: contact_losses.py [--cells M]... [--table] [--folder run/studies/contact_losses] [--whipple EXE]

A sphere of 4 mm at 1 km/s on a block of 16 x 16 x 8 mm (a quarter of both between mirror planes), at 4 us. Elements are as large as the
cells (m), which hold 2 x 2 x 2 particles along their edges. Energies, J, of the whole: heat of contact, of friction, of the transfers and of
artificial viscosity, motion that the grid does not resolve, their sum without friction, plastic work. Runs of the same program are kept.
"""
import argparse
import csv
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import timed_run  # noqa: E402

CASE = """title = "copper sphere on copper"
[domain]
lower = ["0 mm", "0 mm", "-5 mm"]
upper = ["9 mm", "9 mm", "9 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry" }
[time]
end = "4 us"
[[body]]
name = "sphere"
material = "copper_johnson_cook.toml"
velocity = ["0 m/s", "0 m/s", "1 km/s"]
shape = { sphere = { center = ["0 mm", "0 mm", "-2 mm"], radius = "2 mm" } }
[[body]]
name = "block"
material = "copper_johnson_cook.toml"
shape = { box = { lower = ["0 mm", "0 mm", "0 mm"], upper = ["8 mm", "8 mm", "8 mm"] } }
"""
ELEMENTS = ["body.0.discretization.method=finite_elements", "body.1.discretization.method=finite_elements"]
WAYS = {"particles": [],
        "particles, impulses": ["contact.method=multi_field"],
        "particles, impulses, FLIP": ["transfer.particle_update=flip"],
        "elements": ELEMENTS,
        "elements on particles": ELEMENTS[:1],
        "particles on elements": ELEMENTS[1:]}
WHOLE = 4.0  # over the quarter
LOST = ("contact_heat", "transfer_heat", "viscous_heat", "unresolved_energy")


def row_of(folder, way, cell):
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    last = {name.split(" ")[0]: float(value) for name, value in zip(rows[0], rows[-1])}
    values = [last[name] for name in LOST] + [sum(last[name] for name in LOST), last["friction_heat"], last["plastic_work"]]
    return f"| {cell * 1e3:g} | {way} | " + " | ".join(f"{WHOLE * value:.1f}" for value in values) + f" | {last['energy_error']:.0e} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=float, action="append")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/contact_losses")
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    case = arguments.folder / "case.toml"
    case.write_text(CASE, encoding="utf-8")
    print("| cells, mm | way | contact | transfers | viscosity | unresolved | sum | friction | plastic work | energy error |\n" + "| --- " * 10 + "|")
    for cell in arguments.cells or [1e-3, 0.5e-3, 0.25e-3]:
        for way, settings in WAYS.items():
            folder = arguments.folder / f"{list(WAYS).index(way)}_{round(cell * 1e6)}_um"
            if timed_run(arguments, folder, lambda cell=cell, settings=settings: (case, [f"domain.cell_size={cell * 1e3:.12g} mm", *settings])):
                print(row_of(folder, way, cell), flush=True)


if __name__ == "__main__":
    main()
