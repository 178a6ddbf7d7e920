#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Why does the internal energy of a sphere of gas that expands freely fall below the exact one, late and on every grid?

usage: free_expansion.py [--cells 0.5 0.25] [--generations 6 10] [--volumetric point cell] [--table]
                         [--folder run/studies/free_expansion] [--threads N] [--whipple EXE]

The sphere of gas of docs/theory/mpm.md, section 7.8 (radius 5 mm, 1 kg/m^3, 1 MPa, ratio of heat capacities 1.4), a section beside
its plane of symmetry. At 4, 8 and 12 us: internal energy over that of 800 zones that move with the material; the function of entropy
e rho^-0.4 over its value at the start, mean by energy (the zones have 1.0013 to 1.0017); between the radii that hold 20 to 40, 60 to
80 and 90 to 95 % of the mass, the sum of the volumes of the particles over the room between those radii, and the standard deviation
of ln rho. With `volumetric = "cell"` the volume rates are means over cells (mpm.md, 4.12 to 4.14). Runs of the same program and the same case are kept; --table runs nothing.
"""
import argparse
import itertools
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402
from studies.commands import compute  # noqa: E402

RADIUS, DENSITY, PRESSURE, RATIO = 5e-3, 1.0, 1e6, 1.4
TIMES = (4e-6, 8e-6, 12e-6)
SHELLS = ((0.2, 0.4), (0.6, 0.8), (0.9, 0.95))  # fractions of the mass, from the centre
GAS = f"""name = "gas"
source = "verification"
[eos]
model = "ideal_gas"
source = "verification"
heat_capacity_ratio = {RATIO}
reference_density = "{DENSITY} kg/m^3"
heat_capacity = "718 J/(kg K)"
"""
CASE = """title = "sphere of gas that expands freely"
[domain]
dimension = "axisymmetric"
lower = ["0 mm", "0 mm"]
upper = ["90 mm", "90 mm"]
cell_size = "{cell} mm"
boundary = {{ x_lower = "symmetry" }}
[time]
end = "12 us"
[splitting]
maximum_generations = {generations}
[[body]]
name = "sphere"
material = "gas.toml"
volumetric = "{volumetric}"
initial = {{ density = "1 kg/m^3", pressure = "1 MPa" }}
shape = {{ sphere = {{ center = ["0 mm", "0 mm", "0 mm"], radius = "5 mm" }} }}
[output]
snapshot_every = "4 us"
fields = ["density", "internal_energy", "volume"]
"""


def zones(number=800):
    """Specific internal energies (J/kg) of zones that move with the material, by the times, and their masses."""
    radius = RADIUS * np.cbrt(1 - (1 - np.linspace(0, 1, number + 1))**1.5)  # finer at the surface
    volume = 4 / 3 * np.pi * np.diff(radius**3)
    mass, velocity, energy = DENSITY * volume, np.zeros(number + 1), np.full(number, PRESSURE / (RATIO - 1) / DENSITY)
    of_node = 0.5 * (np.append(mass, 0) + np.insert(mass, 0, 0))
    time, found = 0.0, {}
    for end in TIMES:
        while time < end:
            density = mass / volume
            pressure = (RATIO - 1) * energy * density
            sound = np.sqrt(RATIO * pressure / density)
            step = min(0.3 * np.min(np.diff(radius) / sound), end - time)
            closing = np.minimum(np.diff(velocity), 0)
            viscous = density * (1.5 * closing**2 - 0.3 * sound * closing)
            force = -np.diff(np.append(pressure + viscous, 0), prepend=0)
            force[0] = 0
            velocity = velocity + step * 4 * np.pi * radius**2 * force / of_node
            radius = radius + step * velocity
            larger = 4 / 3 * np.pi * np.diff(radius**3)
            change, trial = larger - volume, energy - (pressure + viscous) * (larger - volume) / mass
            energy = energy - (0.5 * (pressure + (RATIO - 1) * trial * mass / larger) + viscous) * change / mass
            volume, time = larger, time + step
        found[end] = energy
    return found, mass


def line(particles, exact):
    """Cells of the table from the particles at one time."""
    mass, energy, density = (particles[name].astype(float) for name in ("mass", "internal_energy", "density"))
    adiabatic = PRESSURE / (RATIO - 1) / DENSITY * (density / DENSITY)**(RATIO - 1)
    cells = [f"{100 * ((mass * energy).sum() / mass.sum() / exact - 1):+.2f}", f"{np.average(energy / adiabatic, weights=mass * energy):.4f}"]
    radius = np.hypot(particles["position"][:, 0], particles["position"][:, 1]).astype(float)
    order = np.argsort(radius, kind="stable")
    within = np.cumsum(mass[order]) / mass.sum()
    for bounds in SHELLS:
        first, last = np.searchsorted(within, bounds)
        chosen = order[first:last]
        room = 2 / 3 * np.pi * (radius[order[last]]**3 - radius[order[first]]**3)  # of the half of the sphere
        logarithm = np.log(density[chosen])
        mean = np.average(logarithm, weights=mass[chosen])
        scatter = np.sqrt(np.average((logarithm - mean)**2, weights=mass[chosen]))
        cells.append(f"{particles['volume'][chosen].astype(float).sum() / room:.3f}, {scatter:.2f}")
    return cells


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=float, nargs="+", default=[0.5, 0.25], help="mm")
    parser.add_argument("--generations", type=int, nargs="+", default=[6, 10])
    parser.add_argument("--volumetric", nargs="+", default=["point", "cell"], choices=["point", "cell"])
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/free_expansion")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "gas.toml").write_text(GAS, encoding="utf-8")
    exact, mass = zones()
    shells = " | ".join(f"{100 * a:g} to {100 * b:g} % of the mass" for a, b in SHELLS)
    print(f"| cells, mm | generations | volumetric | us | internal energy, % | entropy | {shells} |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for generations, volumetric, cell in itertools.product(arguments.generations, arguments.volumetric, arguments.cells):
        run = folder / f"sphere_{cell:g}_{generations}_{volumetric}"
        if not arguments.table:
            case = folder / f"{run.name}.toml"
            case.write_text(CASE.format(cell=cell, generations=generations, volumetric=volumetric), encoding="utf-8")
            compute(arguments.whipple, run, [["run", case, "--output", run, "--force", "--quiet", "--threads", arguments.threads]],
                    [case, folder / "gas.toml"])
        if not (run / "history.csv").is_file():
            continue
        for time in TIMES:
            cells = line(particles_of(run, "sphere", time), (mass * exact[time]).sum() / mass.sum())
            print(f"| {cell:g} | {generations} | {volumetric} | {1e6 * time:g} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
