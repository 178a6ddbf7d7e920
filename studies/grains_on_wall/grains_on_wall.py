#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the grain of a debris cloud decide whether a wall is perforated, and which size has the program's own?

usage: grains_on_wall.py cloud|tile|cell [--cells MM]... [--energy J/m2] [--sizes MM]... [--walls MM]... [--load MG/MM2 KM/S US]
                         [--side MM] [--seed N] [--table] [--folder run/studies/grains_on_wall] [--threads N] [--whipple EXE]

cloud  A sphere of 2017-T4 of 3.175 mm strikes a sheet of 6061-T6 of 0.787 mm at 6.7 km/s (section, debris_grains), 8 us later and
       in free flight to the wall 50.8 mm behind: within the radius r50 that half of the axial momentum arrives in, and within 5 mm,
       mass per area, mean axial speed, and the time in which the middle 80 % of that momentum arrives; failed fraction of the
       sphere, and sizes of its fragments at 16, 50 and 84 % of the mass that keeps one (docs/theory/cracks.md, eq. 8), with
       `--energy` of a crack.
tile   That load on a square (4 mm) of a wall of 6061-T6 with ductile fracture between mirror planes, in three dimensions: spheres
       of one size, or of several, at random places, as dust single particles, each on a cell of the wall in turn. 6 us later of
       the rest of the wall: its least and median thickness over columns of a cell, the fraction of columns that it covers, and
       speed; of the next pieces behind it mass and speed.
cell   The unit cell of a dense load (studies/spalled_layer): one sphere on the axis of a wall whose side is a mirror; the same
       without columns, 8 us later.

Pieces are intact particles of the wall in neighbouring cubes of 0.75 cells; its rest is the slowest of those of a tenth of its
mass and more. A wall is "open" where a column is not covered, has
"spalled" if a piece of a fiftieth of its mass and more leaves behind by more than 10 m/s, else it is "whole". Runs of the same
program and the same case are kept; --table runs nothing.
"""
import argparse
import dataclasses
import itertools
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402
from studies.commands import compute  # noqa: E402
from studies.debris_grains import debris_grains  # noqa: E402
from studies.spalled_layer import spalled_layer  # noqa: E402

DENSITY = 2.79  # mg/mm^3, of the sphere (aluminium_2017_t4_mie_gruneisen)
WALL_AT = 0.787 + 50.8  # mm
CORE = 5.0  # mm, of the axis
GAP = 0.02  # mm, between the load and the wall
WALL = "aluminium_6061_fracture_mie_gruneisen.toml"
FIELDS = 'fields = ["density", "failed", "phase", "void_fraction"]\n'


@dataclasses.dataclass(frozen=True)
class Load:
    """Mass per area (mg/mm^2), speed (km/s) and duration (us) of what arrives; side of the tile (mm)."""
    mass: float
    speed: float
    duration: float
    side: float = 4.0

    def __str__(self):
        return f"{self.mass:.3f}, {self.speed:.2f}, {self.duration:.2f}"


# ---- cloud


def quantile(values, weights, fraction):
    """Value below which a fraction of the weight lies; NaN without any."""
    order = np.argsort(values)
    reached = np.cumsum(np.asarray(weights)[order])
    if not len(order) or not reached[-1] > 0:
        return np.nan
    return float(np.asarray(values)[order][np.searchsorted(reached, fraction * reached[-1])])


def arrival(position, velocity, mass, wall):
    """r50 (mm) of particles of a section in free flight, and their load within it and within CORE.

    position: x and r (mm); velocity: along them (km/s = mm/us); mass: mg; wall: x (mm). The duration is that of the middle 80 % of
    the momentum; what flies backward, or is beyond the wall, does not count.
    """
    ahead = (velocity[:, 0] > 0) & (position[:, 0] < wall)
    place, speed, own = position[ahead], velocity[ahead], mass[ahead]
    time = (wall - place[:, 0]) / speed[:, 0]
    radius, momentum = np.abs(place[:, 1] + speed[:, 1] * time), own * speed[:, 0]
    r50 = quantile(radius, momentum, 0.5)

    def load(reach):
        within = radius <= reach
        first, last = (quantile(time[within], momentum[within], fraction) for fraction in (0.1, 0.9))
        return Load(own[within].sum() / (np.pi * reach**2), momentum[within].sum() / own[within].sum(), last - first)

    return r50, load(r50), load(CORE)


def keeping(folder, name, energy):
    """Name of a material of the library, written into the folder, whose failed points keep the size of their fragments."""
    text = (ROOT / f"eos/materials/{name}.toml").read_text(encoding="utf-8")
    text += f'\n[[failure]]\nmodel = "fragment_size"\nsource = "see --energy"\nenergy_per_area = "{energy:g} J/m^2"\n'
    (folder / f"{name}_{energy:g}.toml").write_text(text, encoding="utf-8")
    return f"{name}_{energy:g}.toml"


def cloud(arguments, folder):
    print("| cells, mm | r50, mm | within it: mg/mm2, km/s, us | within 5 mm | failed, % | with a size, % | sizes at 16, 50, 84 %, mm |\n"
          + 7 * "| --- " + "|")
    for cell in arguments.cells or [0.2, 0.1, 0.05]:
        run = folder / f"cloud_{arguments.energy:g}_{cell:g}"
        case = folder / f"{run.name}.toml"
        text = debris_grains.case_of(False, cell, "", 8.0) + FIELDS.replace("]", ', "fragment_size"]')
        name = "aluminium_2017_t4_mie_gruneisen"
        if arguments.energy > 0:
            text = text.replace(f"{name}.toml", keeping(folder, name, arguments.energy))
        if done(arguments, run, case, text):
            found = {name: particles_of(run, name) for name in ("sphere", "sheet")}
            both = {key: np.concatenate([own[key] for own in found.values()]) for key in ("position", "velocity", "mass")}
            r50, load, core = arrival(1e3 * both["position"], 1e-3 * both["velocity"], 1e6 * both["mass"], WALL_AT)
            sphere = found["sphere"]
            total, size = sphere["mass"].sum(), sphere.get("fragment_size", np.zeros(len(sphere["mass"])))
            kept = size > 0
            at = [1e3 * quantile(size[kept], sphere["mass"][kept], part) for part in (0.16, 0.5, 0.84)]
            print(f"| {cell:g} | {r50:.1f} | {load} | {core} | "
                  f"{100 * sphere['mass'][sphere['failed'] > 0].sum() / total:.1f} | {100 * sphere['mass'][kept].sum() / total:.1f} | "
                  f"{', '.join(f'{value:.3f}' for value in at)} |", flush=True)


# ---- load of a tile


def diameters_of(load, sizes):
    """Diameters (mm), largest first, of spheres with the mass of the load on the tile: of each size an equal part, and one at least."""
    count = [max(1, round(load.mass * load.side**2 / len(sizes) / (DENSITY * np.pi / 6 * size**3))) for size in sizes]
    return np.sort(np.repeat(sizes, count))[::-1]


def places_of(load, diameters, seed):
    """Centres (mm; wall at x = 0) of spheres at random places before the wall, over the length of the load, without overlap."""
    random, places, tries = np.random.default_rng(seed), [], 0
    depth = max(load.speed * load.duration, diameters[0])
    while len(places) < len(diameters):
        size = diameters[len(places)]
        y, z = random.uniform(size / 2, load.side - size / 2, 2)
        centre = np.array([-GAP - size / 2 - random.uniform(0, depth - size), y, z])
        if all(np.linalg.norm(centre - other) > 0.51 * (size + near) for other, near in zip(places, diameters)):
            places.append(centre)
        tries += 1
        if tries > 10000 * len(diameters):
            sys.exit(f"{len(diameters)} spheres do not fit")
    return np.array(places)


def dust_of(load, cell, seed):
    """Lower corners (mm) of single particles (cubes of half a cell) at random depths, each in a column of a cell in turn."""
    edge, columns = 0.5 * cell, round(load.side / cell)
    random, places, taken = np.random.default_rng(seed), [], set()
    order = random.permutation(columns**2)
    for i in range(round(load.mass * load.side**2 / (DENSITY * edge**3))):
        column = order[i % len(order)]
        while True:
            y, z = 2 * (column % columns) + random.integers(2), 2 * (column // columns) + random.integers(2)
            place = (-int(random.integers(1, 1 + int(load.speed * load.duration / edge))), int(y), int(z))
            if place not in taken:
                break
        taken.add(place)
        places.append([edge * index for index in place])
    return np.array(places)


def vector(values):
    return "[" + ", ".join(f'"{value:.9g} mm"' for value in values) + "]"


def tile_case(load, sizes, wall, cell, seed):
    """Text of the case; size 0: dust."""
    depth = load.speed * load.duration + max(sizes)
    lower, upper = -cell * np.ceil((depth + 1) / cell), cell * np.ceil((wall + 4) / cell)
    if max(sizes) > 0:
        diameters = diameters_of(load, sizes)
        shapes = [f'{{ sphere = {{ center = {vector(centre)}, radius = "{size / 2:.9g} mm" }} }}'
                  for centre, size in zip(places_of(load, diameters, seed), diameters)]
    else:
        shapes = [f"{{ box = {{ lower = {vector(corner)}, upper = {vector(corner + cell / 2)} }} }}" for corner in dust_of(load, cell, seed)]
    return f"""title = "grains on a wall"
[domain]
lower = {vector((lower, 0, 0))}
upper = {vector((upper, load.side, load.side))}
cell_size = "{cell:.12g} mm"
boundary = {{ y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }}
[time]
end = "6 us"
[[body]]
name = "grains"
material = "aluminium_2017_t4_mie_gruneisen.toml"
velocity = ["{load.speed:g} km/s", "0 m/s", "0 m/s"]
shape = {{ union = [{", ".join(shapes)}] }}
[[body]]
name = "wall"
material = "{WALL}"
shape = {{ box = {{ lower = {vector((0, 0, 0))}, upper = {vector((wall, load.side, load.side))} }} }}
[output]
snapshot_every = "2 us"
{FIELDS}"""


# ---- pieces of a wall


def neighbours_joined(cubes):
    """Labels of pieces of cubes (integer places, one row each): cubes of one piece touch, by a face, an edge or a corner."""
    unique, own = np.unique(cubes, axis=0, return_inverse=True)
    number = {tuple(place): i for i, place in enumerate(unique)}
    root = np.arange(len(unique))

    def find(i):
        while root[i] != i:
            root[i] = i = root[root[i]]
        return i

    half = [shift for shift in itertools.product((-1, 0, 1), repeat=cubes.shape[1]) if shift > (0,) * cubes.shape[1]]
    for place, i in number.items():
        for shift in half:
            other = number.get(tuple(np.add(place, shift)))
            if other is not None:
                root[find(other)] = find(i)
    return np.array([find(i) for i in range(len(unique))])[own.ravel()]


@dataclasses.dataclass(frozen=True)
class Left:
    """Of a wall: fraction of the mass and speed (m/s) of its rest, those of the pieces that leave behind it, thickness
    (mm, least and median) and cover of columns of a cell (NaN in sections)."""
    share: float
    speed: float
    behind: float
    behind_speed: float
    least: float
    median: float
    cover: float

    def verdict(self):
        return "open" if self.cover < 1 else "spalled" if self.behind > 0.02 else "whole"

    def row(self):
        columns = "" if np.isnan(self.cover) else f"{self.least:.2f} | {self.median:.2f} | {100 * self.cover:.0f} | "
        behind = f"{100 * self.behind:.1f}, {self.behind_speed:.0f}" if self.behind > 0 else "-"
        return f"{columns}{100 * self.share:.0f}, {self.speed:.0f} | {behind} | {self.verdict()} |"


def left_of(position, velocity, mass, intact, cell, side=None):
    """What is left of a wall. position (mm; x along the flight), velocity (m/s, along x), mass; side: of a tile, mm."""
    total, nothing = mass.sum(), Left(0, np.nan, 0, np.nan, 0, 0, 0)
    place, speed, own = position[intact], velocity[intact], mass[intact]
    if not len(own):
        return nothing
    label = neighbours_joined(np.floor(place / (0.75 * cell)).astype(int))
    pieces = {name: label == name for name in np.unique(label)}
    weight = {name: own[here].sum() for name, here in pieces.items()}
    mean = {name: (own * speed)[here].sum() / weight[name] for name, here in pieces.items()}
    main = min([name for name in pieces if weight[name] > 0.1 * total] or [max(weight, key=weight.get)], key=mean.get)
    behind = [name for name in pieces if weight[name] > 0.02 * total and mean[name] > mean[main] + 10]
    gone = sum(weight[name] for name in behind)
    columns = (np.nan, np.nan, np.nan)
    if side is not None:
        count = round(side / cell)
        cubes = np.unique(np.floor(place[pieces[main]] / cell).astype(int), axis=0)
        thickness = np.zeros((count, count))
        np.add.at(thickness, tuple(np.clip(cubes[:, 1:], 0, count - 1).T), cell)
        columns = (thickness.min(), np.median(thickness), (thickness > 0).mean())
    return Left(weight[main] / total, mean[main], gone / total, sum(weight[n] * mean[n] for n in behind) / gone if behind else np.nan, *columns)


def wall_left(run, cell, side=None):
    """What is left of the wall of a run."""
    wall = particles_of(run, "wall")
    axes = 2 if side is None else 3
    return left_of(1e3 * wall["position"][:, :axes], wall["velocity"][:, 0], wall["mass"], (wall["failed"] == 0) & (wall["phase"] < 2), cell, side)


# ---- studies


def done(arguments, run, case, text):
    """Runs a case, unless only the table is wanted; whether there is a result."""
    if not arguments.table:
        case.write_text(text, encoding="utf-8")
        compute(arguments.whipple, run, [["run", case, "--output", run, "--force", "--quiet", "--threads", arguments.threads]], [case])
    return (run / "run.toml").is_file()


def tile(arguments, folder):
    load = Load(*arguments.load, arguments.side)
    print("| grain, mm (number) | wall, mm | cells, mm | least, mm | median, mm | cover, % | rest, %, m/s | behind it, %, m/s | wall |\n"
          + 9 * "| --- " + "|")
    for wanted, wall, name in itertools.product(arguments.cells or [0.25], arguments.walls or [1.80, 4.06], arguments.sizes or ["0", "0.5"]):
        cell, sizes = load.side / round(load.side / wanted), [float(size) for size in name.split("+")]
        run = folder / f"tile_{name}_{wall:g}_{wanted:.3g}_{arguments.seed}_{load.mass:g}_{load.duration:g}_{load.side:g}"
        if done(arguments, run, folder / f"{run.name}.toml", tile_case(load, sizes, wall, cell, arguments.seed)):
            number = len(diameters_of(load, sizes) if max(sizes) > 0 else dust_of(load, cell, arguments.seed))
            print(f"| {name if max(sizes) > 0 else 'dust'} ({number}) | {wall:g} | {wanted:g} | {wall_left(run, cell, load.side).row()}", flush=True)


def cell_case(load, size, wall, cell):
    """Text of the unit cell and its cell size (mm): a whole number of cells up to the mirror."""
    radius = np.sqrt(DENSITY * size**3 / (6 * load.mass))
    cell = radius / round(radius / cell)
    sphere = f'{{ sphere = {{ center = ["{-size / 2 - GAP:.9g} mm", "0 mm"], radius = "{size / 2:.9g} mm" }} }}'
    text = spalled_layer.CASE.format(dimension="axisymmetric", radius=radius, cell=cell, below="", time=8, thickness=wall, speed=1e3 * load.speed,
                                     flyer="aluminium_2017_t4_mie_gruneisen", shape=sphere, wall=WALL, cracks="none",
                                     end=-2 + cell * round((10 + wall) / cell))
    return text + FIELDS, cell


def unit_cell(arguments, folder):
    load = Load(*arguments.load)
    print("| sphere, mm | wall, mm | cells, mm | rest, %, m/s | behind it, %, m/s | wall |\n" + 6 * "| --- " + "|")
    sizes, walls, cells = arguments.sizes or [0.5, 1.0], arguments.walls or [1.80, 4.06], arguments.cells or [0.2, 0.1, 0.05]
    for size, wall, wanted in itertools.product(map(float, sizes), walls, cells):
        text, cell = cell_case(load, size, wall, wanted)
        run = folder / f"cell_{size:g}_{wall:g}_{wanted:g}_{load.mass:g}"
        if done(arguments, run, folder / f"{run.name}.toml", text):
            print(f"| {size:g} | {wall:g} | {cell:.3f} | {wall_left(run, cell).row()}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=["cloud", "tile", "cell"])
    parser.add_argument("--cells", type=float, nargs="+", help="mm")
    parser.add_argument("--energy", type=float, default=11.5e3, help="of a crack, J/m^2; 2024-T351, T-L: K_Ic^2 (1 - nu^2)/E (NASGRO)")
    parser.add_argument("--sizes", nargs="+", help="of the spheres, mm; 0: dust; 0.3+0.5: half of the mass each")
    parser.add_argument("--walls", type=float, nargs="+", help="mm")
    parser.add_argument("--load", type=float, nargs=3, default=[0.095, 5.7, 0.8], help="mg/mm^2, km/s, us")
    parser.add_argument("--side", type=float, default=4.0, help="of the tile, mm")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/grains_on_wall")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    {"cloud": cloud, "tile": tile, "cell": unit_cell}[arguments.study](arguments, folder)


if __name__ == "__main__":
    main()
