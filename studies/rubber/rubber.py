#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rubber that keeps its volume: inflation against the closed form, and the checkerboard of the pressure.

usage: rubber.py inflation|checkerboard [--cells N]... [--folder run/studies/rubber] [--threads N] [--whipple EXE]

inflation     a hollow cylinder (plane strain) and a hollow sphere of neo-Hookean rubber, outer radius 20 mm, inner one 10 mm, bulk over shear
              modulus 500, means over cells, filled with gas that is given a pressure at once and comes to rest by damping: the pressure of
              the gas over the shear modulus beside the closed form of incompressible rubber at the stretch of the inner wall, which follows
              from a particle in the middle of the wall (the volume inside it is kept) and from the volume of the gas; pressure of the particles
              about its mean over a cell, root mean square over the shear modulus, in the middle half of the wall.
checkerboard  two disks of this rubber, and the rings of cases/rubber_rings with it, collide: pressure at every particle and as means over
              cells. Part of the pressure that alternates from cell to cell: root mean square of (4 p - 2 (four neighbours) + (four at the
              corners)) / 16 of the means over cells, which no quadratic field has, and of the pressure within a cell about its mean,
              both over the root mean square of the pressure, while the bodies touch; energy error; speed of parting over that of meeting.
--cells: number over the thickness of the wall (inflation), the width of the rings or a sixth of the disks (checkerboard).
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402

SHEAR = 1e6  # Pa
RATIO = 500  # bulk over shear modulus
DENSITY = 1000.0
INNER, OUTER = 10.0, 20.0  # mm
GAMMA = 1.4

RUBBER = f"""name = "rubber"
group = "verification"
source = "studies/rubber"
note = "rubber"
[eos]
model = "mie_gruneisen"
source = "K = rho c0^2"
reference_density = "{DENSITY} kg/m^3"
hugoniot_intercept = "{math.sqrt(RATIO * SHEAR / DENSITY):.17g} m/s"
hugoniot_slope = 0.001
gruneisen = 0.001
heat_capacity = "1500 J/(kg K)"
[constitutive]
model = "neo_hookean"
source = "as above"
shear_modulus = "{SHEAR} Pa"
"""
GAS = f"""name = "gas"
group = "verification"
source = "studies/rubber"
note = "gas"
[eos]
model = "ideal_gas"
source = "studies/rubber"
heat_capacity_ratio = {GAMMA}
reference_density = "10 kg/m^3"
heat_capacity = "718 J/(kg K)"
"""


def program(arguments, name, text, materials):
    """Folder of the run of a case, computed unless it has been."""
    folder = arguments.folder / name
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "case.toml"
    if not (folder / "run/status.json").exists() or not case.exists() or case.read_text(encoding="utf-8") != text:
        for of_body, content in materials.items():
            (folder / f"{of_body}.toml").write_text(content, encoding="utf-8")
        case.write_text(text, encoding="utf-8")
        subprocess.run([arguments.whipple, "run", case, "-o", folder / "run", "--force", "--quiet", "--threads", str(arguments.threads)], check=True)
    return folder / "run"


def history(run):
    with open(run / "history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return [name.split(" ")[0] for name in rows[0]], np.array([[float(x) for x in row] for row in rows[1:]])


def energy_error(run):
    names, rows = history(run)
    return abs(rows[-1, names.index("energy_error")])


def closed_form(kind, stretch, radius=INNER):
    """Radial pressure over shear modulus of an incompressible neo-Hookean body where it is stretched so, at an initial radius in mm."""
    thick = radius / OUTER
    if kind == "cylinder":
        outer = np.sqrt(1 + (stretch**2 - 1) * thick**2)
        return np.log(stretch / outer) + (outer**-2 - stretch**-2) / 2
    outer = np.cbrt(1 + (stretch**3 - 1) * thick**3)
    return 2 / outer + 1 / (2 * outer**4) - 2 / stretch - 1 / (2 * stretch**4)


def inflate(arguments, kind, pressure, cells):
    """Stretch by the wall, stretch by the gas, pressure of the gas, in the wall and its closed form over the shear modulus, pressure within cells
    over it, kinetic over internal energy, energy error."""
    cell = (OUTER - INNER) / cells
    n = 2 if kind == "cylinder" else 3
    shapes = {"cylinder": ('tube = {{ base = ["0 mm", "0 mm", "-1 mm"], axis = "z", height = "2 mm", inner_radius = "{a} mm", outer_radius = "{b} mm" }}',
                           'cylinder = {{ center = ["0 mm", "0 mm", "0 mm"], axis = "z", radius = "{a} mm", height = "2 mm" }}'),
              "sphere": ('difference = {{ from = {{ sphere = {{ center = ["0 mm", "0 mm", "0 mm"], radius = "{b} mm" }} }}, '
                         'minus = [{{ sphere = {{ center = ["0 mm", "0 mm", "0 mm"], radius = "{a} mm" }} }}] }}',
                         'sphere = {{ center = ["0 mm", "0 mm", "0 mm"], radius = "{a} mm" }}')}[kind]
    wall, inside = (shape.format(a=INNER, b=OUTER) for shape in shapes)
    middle = (INNER + OUTER) / 2
    text = f"""[domain]
dimension = "{'plane_strain' if kind == 'cylinder' else 'axisymmetric'}"
lower = ["0 mm", "0 mm"]
upper = ["36 mm", "36 mm"]
cell_size = "{cell:.17g} mm"
boundary = {{ x_lower = "symmetry"{', y_lower = "symmetry"' if kind == 'cylinder' else ''} }}
[time]
end = "24 ms"
[contact]
friction = 0
[[body]]
name = "wall"
material = "rubber.toml"
volumetric = "cell"
contact_group = "both"
shape = {{ {wall} }}
[[body]]
name = "gas"
material = "gas.toml"
initial = {{ pressure = "{pressure:.17g} Pa", density = "10 kg/m^3" }}
contact_group = "both"
shape = {{ {inside} }}
[[load]]
damping = "600 1/s"
[output]
snapshot_every = "24 ms"
fields = ["mass", "volume", "pressure", "stress", "id"]
"""
    run = program(arguments, f"{kind}_{pressure:.0f}_{cells}", text, {"rubber": RUBBER, "gas": GAS})
    now, began, gas = particles_of(run, "wall"), particles_of(run, "wall", 0.0), particles_of(run, "gas")
    before = {number: place for number, place in zip(began["id"], np.linalg.norm(began["position"], axis=1))}
    radius = 1e3 * np.linalg.norm(now["position"], axis=1)
    first = 1e3 * np.array([before[number] for number in now["id"]])
    inner = (radius**n - first**n + INNER**n) ** (1 / n)
    chosen = np.abs(first - middle) < 0.25 * (OUTER - INNER)  # away from both surfaces
    normal = (now["position"] / np.linalg.norm(now["position"], axis=1)[:, None])[chosen, :2]
    stress = now["stress"][chosen]
    radial = -(stress[:, 0] * normal[:, 0] ** 2 + stress[:, 1] * normal[:, 1] ** 2 + 2 * stress[:, 3] * normal[:, 0] * normal[:, 1])
    weight = now["volume"][chosen]
    in_wall = (weight * radial).sum() / weight.sum() / SHEAR
    form = (weight * closed_form(kind, (radius / first)[chosen], first[chosen])).sum() / weight.sum()
    cells_of = np.unique(np.floor(1e3 * now["position"][chosen, :2] / cell).astype(int), axis=0, return_inverse=True)[1].ravel()
    of_cells = np.bincount(cells_of, weight * now["pressure"][chosen]) / np.bincount(cells_of, weight)
    within = math.sqrt((weight * (now["pressure"][chosen] - of_cells[cells_of]) ** 2).sum() / weight.sum()) / SHEAR
    gas_began = particles_of(run, "gas", 0.0)
    swollen = (gas["volume"].sum() / gas_began["volume"].sum()) ** (1 / n)
    mean = (gas["pressure"] * gas["volume"]).sum() / gas["volume"].sum()
    names, rows = history(run)
    kinetic = rows[-1, names.index("kinetic_energy")] / rows[-1, names.index("internal_energy")]
    return inner[chosen].mean() / INNER, swollen, mean / SHEAR, in_wall, form, within, kinetic, energy_error(run)


def inflation(arguments):
    print("| body | cells | stretch of the inner wall | radial pressure in the wall/G | closed form | difference | pressure within cells/G | pressure of the gas/G "
          "| closed form | difference | stretch by the gas | kinetic/internal | energy error |\n" + "| --- " * 13 + "|")
    for kind in ("cylinder", "sphere"):
        for stretch in (1.25, 1.5):
            volume = stretch ** (2 if kind == "cylinder" else 3)
            pressure = closed_form(kind, stretch) * SHEAR * volume**GAMMA
            for cells in arguments.cells or (5, 10, 20):
                at, by_gas, found, in_wall, form, within, kinetic, error = inflate(arguments, kind, pressure, cells)
                exact = closed_form(kind, at)
                print(f"| {kind} | {cells} | {at:.4f} | {in_wall:.4f} | {form:.4f} | {100 * (in_wall / form - 1):+.2f} % | {within:.3f} | {found:.4f} | {exact:.4f} "
                      f"| {100 * (found / exact - 1):+.1f} % | {by_gas:.4f} | {kinetic:.0e} | {error:.0e} |", flush=True)


def uneven(run, cell, times):
    """Part of the pressure of the left body that alternates from cell to cell, and within cells."""
    alternating, within, whole, count, mean_count = 0.0, 0.0, 0.0, 0, 0
    for time in times:
        now = particles_of(run, "left", time)
        at = np.floor(now["position"][:, :2] / cell + 1e-9).astype(int)
        at -= at.min(axis=0)
        shape = tuple(at.max(axis=0) + 1)
        weight, sums, squares = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        index = (at[:, 0], at[:, 1])
        np.add.at(weight, index, now["volume"])
        np.add.at(sums, index, now["volume"] * now["pressure"])
        filled = weight > 0.75 * cell**2  # plane strain: per metre
        mean = np.where(weight > 0, sums / np.where(weight > 0, weight, 1), 0)
        np.add.at(squares, index, now["volume"] * (now["pressure"] - mean[index]) ** 2)
        core = filled[1:-1, 1:-1].copy()
        mode = 4 * mean[1:-1, 1:-1]
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                part = (slice(1 + i, filled.shape[0] - 1 + i), slice(1 + j, filled.shape[1] - 1 + j))
                core &= filled[part]
                if (i, j) != (0, 0):
                    mode = mode + (1 if i and j else -2) * mean[part]
        alternating += ((mode[core] / 16) ** 2).sum()
        inside = np.zeros_like(filled)
        inside[1:-1, 1:-1] = core
        within += (squares[inside] / weight[inside]).sum()
        whole += (mean[inside] ** 2).sum()
        count += core.sum()
        mean_count += 1
    return math.sqrt(alternating / whole), math.sqrt(within / whole), count // mean_count


BODIES = {"disks": ('cylinder = {{ center = ["{x} mm", "0 mm", "0 mm"], axis = "z", radius = "30 mm", height = "2 mm" }}', 31.0),
          "rings": ('tube = {{ base = ["{x} mm", "0 mm", "-1 mm"], axis = "z", height = "2 mm", inner_radius = "30 mm", outer_radius = "40 mm" }}', 41.0)}


def collide(arguments, kind, means, cells):
    shape, place = BODIES[kind]
    cell = 10.0 / cells
    text = f"""[domain]
dimension = "plane_strain"
lower = ["-120 mm", "0 mm"]
upper = ["120 mm", "60 mm"]
cell_size = "{cell:.17g} mm"
boundary = {{ y_lower = "symmetry" }}
[time]
end = "16 ms"
[contact]
friction = 0
[output]
snapshot_every = "0.5 ms"
fields = ["mass", "volume", "pressure", "velocity"]
"""
    for name, sign in (("left", -1), ("right", 1)):
        text += f"""[[body]]
name = "{name}"
material = "rubber.toml"
volumetric = "{means}"
velocity = ["{-sign * 4} m/s", "0 m/s"]
shape = {{ {shape.format(x=sign * place)} }}
"""
    run = program(arguments, f"{kind}_{means}_{cells}", text, {"rubber": RUBBER})
    unevenness = uneven(run, cell / 1e3, [t * 1e-3 for t in (1, 1.5, 2, 2.5, 3)])
    last = particles_of(run, "left")
    speed = -(last["mass"] * last["velocity"][:, 0]).sum() / last["mass"].sum() if "velocity" in last else math.nan
    return *unevenness, speed / 4, energy_error(run)


def checkerboard(arguments):
    print("| bodies | cells | pressure | alternating from cell to cell | within cells | cells counted | speed of parting | energy error |\n" + "| --- " * 8 + "|")
    for kind in BODIES:
        for cells in arguments.cells or (5, 10):
            for means in ("point", "cell"):
                alternating, within, count, speed, error = collide(arguments, kind, means, cells)
                print(f"| {kind} | {cells} | {'of particles' if means == 'point' else 'means over cells'} | {100 * alternating:.2f} % | {100 * within:.1f} % | {count} "
                      f"| {speed:.3f} | {error:.0e} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem", choices=("inflation", "checkerboard"))
    parser.add_argument("--cells", type=int, action="append")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/rubber")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    {"inflation": inflation, "checkerboard": checkerboard}[arguments.problem](arguments)


if __name__ == "__main__":
    main()
