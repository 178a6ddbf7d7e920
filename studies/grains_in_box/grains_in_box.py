#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two hundred grains fall into a box: balances, the heap, and what a velocity field for each of them costs.

usage: grains_in_box.py fall|cost [--at S] [--cells MM]... [--seeds N]... [--fields N]... [--table] [--folder run/studies/grains_in_box]
                        [--threads N] [--whipple EXE]

200 discs of rubber of 10 mm (plane strain, neo-Hookean, 1000 kg/m^3, G 0.4 MPa, K 0.8 MPa, with pressures and shear as the discs have
them) lie in a loose pattern with small displacements from a seed, and fall by their weight into a box of 160 mm with a rough base and
smooth sides. Friction between grains 0.3.

fall  0.25 s later, or at another time before: height of the centre of mass and of the top over the base, energies as parts of the work of gravity, errors of energy
      and momentum over the whole run, steps, fields.
cost  The same discs in contact groups 1, 2, ..., which bond where they meet, for 300 steps from the dense end of `fall`'s pattern
      (a hexagonal packing with gaps of a tenth of a cell, at rest): processor time of a step and memory against the number of
      velocity fields, 1 to 200.
Runs of the same program and the same case are kept; --table runs nothing.
"""
import argparse
import csv
import json
import pathlib
import resource
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import compute  # noqa: E402

RADIUS, WIDTH, GRAINS = 5.0, 160.0, 200  # mm, mm
END = 0.25  # s
MATERIAL = """name = "soft grains"
group = "verification"
source = "made up: soft enough for long steps"
note = "Grains of rubber"

[eos]
model = "mie_gruneisen"
source = "K = rho c0^2"
reference_density = "1000 kg/m^3"
hugoniot_intercept = "28.2843 m/s"
hugoniot_slope = 0.001
gruneisen = 0.001
heat_capacity = "1000 J/(kg K)"

[constitutive]
model = "neo_hookean"
source = "made up"
shear_modulus = "0.4 MPa"
"""


def centres(seed, dense, cell):
    """Centres of the discs, mm: a loose pattern with displacements from a seed, or a hexagonal packing with gaps of a tenth of a cell."""
    generator = np.random.default_rng(seed)
    pitch = 2 * RADIUS + (0.1 * cell if dense else 1.4)
    rise = pitch * (np.sqrt(0.75) if dense else 1.0)
    found = []
    for row in range(GRAINS):
        shift = 0.5 * pitch * (row % 2)
        across = int((WIDTH - 2 * RADIUS - shift) // pitch) + 1
        for n in range(across):
            place = np.array([RADIUS + shift + n * pitch, RADIUS + 0.5 * cell + row * rise])
            found.append(place if dense else place + generator.uniform(0.0, 0.6, 2))
            if len(found) == GRAINS:
                return found


def case_of(cell, seed, dense=False, groups=GRAINS, end=END):
    """A case; with `groups` the discs belong to so many contact groups in turn."""
    places = centres(seed, dense, cell)
    top = max(place[1] for place in places) + RADIUS + 4 * cell
    text = [f'title = "Grains in a box"\n[domain]\ndimension = "plane_strain"\nlower = ["0 mm", "0 mm"]\n'
            f'upper = ["{WIDTH:g} mm", "{np.ceil(top / cell) * cell:g} mm"]\ncell_size = "{cell:g} mm"\n'
            f'boundary = {{ x_lower = "separating", x_upper = "separating", y_lower = "friction" }}\nfriction = 0.5\n'
            f'[time]\nend = "{end:g} s"\n[gravity]\nacceleration = ["0 m/s^2", "-9.81 m/s^2"]\n'
            f'[contact]\nmethod = "{"none" if groups == 1 else "multi_field"}"\nfriction = 0.3\n'
            f'[output]\nsnapshot_every = "{end:g} s"\nhistory_every = 20\n']
    for n, (x, y) in enumerate(places):
        group = f'contact_group = "group {n % groups}"\n' if groups > 1 else ""
        text.append(f'[[body]]\nname = "g{n:03}"\nmaterial = "grains.toml"\n{group}'
                    f'shape = {{ cylinder = {{ center = ["{x:.4f} mm", "{y:.4f} mm", "0 mm"], radius = "{RADIUS:g} mm", '
                    f'height = "1 m", axis = "z" }} }}\n')
    return "".join(text)


def done(arguments, run, text, *words):
    """Makes the run of a case, unless it is there or nothing is to be run; returns whether it is there."""
    case = arguments.folder / f"{run.name}.toml"
    if not arguments.table:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        (arguments.folder / "grains.toml").write_text(MATERIAL, encoding="utf-8")
        case.write_text(text, encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        compute(arguments.whipple, run,
                [["run", case, "-o", run, "--force", "--quiet", "--threads", arguments.threads, *words]], [case])
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if used > 0.2:  # it ran now
            (run / "processor_time").write_text(f"{used}\n", encoding="utf-8")
    return (run / "history.csv").is_file()


def history(run):
    """Columns of history.csv by name."""
    with open(run / "history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name.split(" [")[0]: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def fall(arguments):
    parts = {"kinetic": "kinetic_energy", "unresolved": "unresolved_energy", "elastic": "elastic_energy", "compression": "volume_energy",
             "viscosity": "viscous_heat", "contact": "contact_heat", "friction": "friction_heat", "transfers": "transfer_heat"}
    print(f"| cells, mm | seed | particles | steps | centre of mass, mm | {' | '.join(parts)} | error of energy | error of momentum |\n"
          + (7 + len(parts)) * "| --- " + "|")
    for cell in arguments.cells or [2.5, 2.0]:
        for seed in arguments.seeds or [1]:
            run = arguments.folder / f"fall_{cell:g}_{seed}"
            if not done(arguments, run, case_of(cell, seed)):
                continue
            h = history(run)
            h = {name: column[h["time"] <= arguments.at] for name, column in h.items()}
            start, weight = np.mean(centres(seed, False, cell), axis=0)[1], h["mass"][0] * 9.81
            work = h["total_energy"] - h["total_energy"][0]
            fallen = -1e3 * work[-1] / weight
            print(f"| {cell:g} | {seed} | {h['particles'][-1]:.0f} | {h['step'][-1]:.0f} | {start - abs(fallen):.2f} | "
                  + " | ".join(f"{(h[name][-1] - h[name][0]) / work[-1]:.4f}" for name in parts.values())
                  + f" | {np.abs(h['energy_error']).max():.1e} | {np.abs(h['momentum_error']).max():.1e} |", flush=True)


def cost(arguments):
    print("| cells, mm | fields | processor time of a step, ms | over that of one field | contact, % | particles and grid, MB |\n"
          + 6 * "| --- " + "|")
    for cell in arguments.cells or [2.5]:
        alone = None
        for fields in arguments.fields or [1, 2, 8, 32, 64, 128, 200]:
            run = arguments.folder / f"cost_{cell:g}_{fields}"
            if not done(arguments, run, case_of(cell, 1, True, fields, 0.004)):
                continue
            h, profile = history(run), json.loads((run / "profile.json").read_text(encoding="utf-8"))
            stages = {stage["stage"]: stage["seconds"] for stage in profile["stages"]}
            step = 1e3 * float((run / "processor_time").read_text(encoding="utf-8")) / h["step"][-1]
            alone = alone or step
            print(f"| {cell:g} | {fields} | {step:.2f} | {step / alone:.2f} | "
                  f"{100 * stages.get('contact', 0.0) / sum(stages.values()):.0f} | {profile['bytes_of_first_rank'] / 1e6:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("fall", "cost"))
    parser.add_argument("--at", type=float, default=END)
    parser.add_argument("--cells", type=float, action="append")
    parser.add_argument("--seeds", type=int, action="append")
    parser.add_argument("--fields", type=int, action="append")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/grains_in_box")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"))
    arguments = parser.parse_args()
    {"fall": fall, "cost": cost}[arguments.what](arguments)


if __name__ == "__main__":
    main()
