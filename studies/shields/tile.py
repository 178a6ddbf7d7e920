# SPDX-License-Identifier: BSD-3-Clause
"""A wall that sees the grains of a debris cloud: a section up to the wall, then a tile of the wall in three dimensions.

The model and its constants are decided in docs/decisions/0025_grains_before_a_wall.md. The section of a shot without its wall gives
the load of the core of the cloud: mass per area, axial speed, time of arrival, sizes of fragments. A square tile of the wall between
mirror planes is struck by spheres with that load. What parts from the wall is held by its rim, which the tile does not have.
"""
import dataclasses
import itertools
import json
import pathlib
import sys
import tomllib

import numpy as np

from report.particles import particles_of
from studies import commands
from studies.grains_on_wall.grains_on_wall import quantile, vector

# ---- constants (decision 25)

FLIGHT = 0.85          # of spacing over speed: time at which the section ends
FINER = 0.5            # cells of that section over those of the rule of whipple shield
SLOWEST = 0.25         # of the speed of the shot: slower debris does not count
CORE = 0.25            # of the axial momentum that arrives: within its radius the load is that of the tile
RINGS = 5              # of equal momentum in the core: times of arrival are those within a ring
CRACK = 11.5e3         # J/m^2, energy of a crack per area
PIECE = 0.5            # of the sphere's mass, of a piece of it: with more the section decides
ACROSS = 3.5           # cells in a grain
THROUGH = 12           # cells through the wall, at least
WIDTH = 4.5            # grains, side of a tile
EARLY, LATE = 0.1, 0.9  # of the momentum: grains do not arrive before or after its quantiles of time
DURATION = 1.25e-3     # s/m, of that time over the diameter of the sphere, after the last grain has come
GAP_BEFORE = 0.02      # mm, between the first grain and the wall
SNAPSHOTS = 5
# of decision 23
SPALL_SHARE = 0.01     # of the plug of the wall (here of the tile): least mass that has come off
SPALL_SPEED = 10.0     # m/s, by which it leaves the wall
SPALL_PARTICLES = 4
GAP = 2.0              # cells
LINK = 0.5             # cells, edge of cubes; particles in cubes that touch are of one piece: all within 0.5 along each axis, none beyond 1
                       # along one (across a corner up to 1.7; decision 23 links within 0.99)
GROWTH = 0.05          # of the plastic strain: below it the wall has stopped
BULGED = 0.1           # of the thickness


@dataclasses.dataclass(frozen=True)
class Load:
    """What arrives in the core: radius (mm), mass per area (mg/mm^2), speed (km/s), size of the grains (mm), delays of parts of the
    momentum behind the middle of their ring (us) with their weights; failed fraction of the sphere and that of its largest intact piece."""
    radius: float
    mass: float
    speed: float
    size: float
    delays: np.ndarray
    weights: np.ndarray
    failed: float
    piece: float

    def is_one_piece(self, diameter):
        """Whether a sphere (mm) has not become grains: more than PIECE of it is one piece, or no fragment of the load is smaller."""
        return self.piece > PIECE or not 0 < self.size < diameter

    def delay(self, part):
        """Delay (us) by which a part of the momentum has arrived."""
        return quantile(self.delays, self.weights, min(max(part, EARLY), LATE))

    def __str__(self):
        times = ", ".join(f"{self.delay(part):.2f}" for part in (0.1, 0.25, 0.75, 0.9))
        return (f"{self.mass:.3f} mg/mm2 at {self.speed:.2f} km/s in grains of {self.size:.3f} mm within {self.radius:.1f} mm; "
                f"10, 25, 75, 90 % at {times} us")


@dataclasses.dataclass(frozen=True)
class Tile:
    """Square tile of a wall: edge, cell size, thickness (mm), centres of the grains (mm, the wall's front at x = 0), their diameter
    (mm) and speed (km/s)."""
    side: float
    cell: float
    thickness: float
    centres: np.ndarray
    diameter: float
    speed: float

    @property
    def duration(self):
        """Time (us) until the last grain has come."""
        return -self.centres[:, 0].min() / self.speed


# ---- the section


def library(name):
    """Keys of a material of the library, with those of the material that it is based on."""
    data = tomllib.loads((commands.LIBRARY / name).read_text(encoding="utf-8"))
    base = data.get("base")
    return (library(base if base.endswith(".toml") else f"{base}.toml") if base else {}) | data


UNITS = {"MPa": 1e6, "GPa": 1e9, "g/cm^3": 1.0, "kg/m^3": 1e-3}


def value_of(material, table, key):
    """Value of a key of a material of the library: Pa or g/cm^3. @throws SystemExit without the key, or in another unit"""
    value, _, unit = str(library(material).get(table, {}).get(key, "")).partition(" ")
    if unit not in UNITS:
        sys.exit(f"{commands.LIBRARY / material}: {table}.{key}: a number and one of {', '.join(UNITS)} are wanted, not '{value} {unit}'")
    return float(value) * UNITS[unit]


def keeping_sizes(folder, name):
    """Writes a material of the library into a folder, with failed points that keep the size of their fragments; its name there."""
    text = (commands.LIBRARY / name).read_text(encoding="utf-8")
    if "failure" not in tomllib.loads(text):  # those of its base would be replaced
        text += "".join("\n[[failure]]\n" + "".join(f"{key} = {inline(value)}\n" for key, value in own.items())
                        for own in library(name)["failure"])
    text += f'\n[[failure]]\nmodel = "fragment_size"\nsource = "decision 25"\nenergy_per_area = "{CRACK:g} J/m^2"\n'
    (folder / f"sized_{name}").write_text(text, encoding="utf-8")
    return f"sized_{name}"


def section_case(case, entry, folder):
    """Text of the section of a shot without its wall, until just before the debris would arrive.

    case: keys of the case that whipple shield makes; entry: the shot in its --json.
    """
    sphere, bumpers = case["body"][0], [body for body in case["body"][1:] if body["name"] != "wall"]
    end = FLIGHT * sum(bumper["spacing"] for bumper in entry["bumpers"]) / entry["sphere"]["velocity"]
    domain = case["domain"]
    bodies = "".join(f"""[[body]]
name = "{body['name']}"
material = "{keeping_sizes(folder, body['material'])}"
{f'velocity = {json.dumps(body["velocity"])}' if "velocity" in body else ""}
shape = {inline(body['shape'])}
""" for body in [sphere, *bumpers])
    return f"""title = "debris before the wall: {case['title']}"
[domain]
dimension = "axisymmetric"
axis = "z"
lower = {json.dumps(domain['lower'])}
upper = {json.dumps(domain['upper'])}
cell_size = "{FINER * 1e3 * entry['case']['cell_size']:.9g} mm"
[time]
end = "{1e6 * end:.6g} us"
{bodies}[output]
snapshot_every = "{1e6 * end:.6g} us"
fields = ["density", "failed", "phase", "fragment_size"]
"""


def inline(value):
    """TOML of a value, tables inline."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {inline(item)}" for key, item in value.items()) + " }"
    return json.dumps(value)


def load_of(position, velocity, mass, size, wall, slowest, sphere):
    """Load of the core of a cloud in free flight.

    position: (axis, radius), mm; velocity: along them, km/s; mass: mg; size: of fragments, mm, 0 without; wall: place on the axis, mm;
    slowest: speed of debris that counts, km/s; sphere: failed fraction of the sphere and that of its largest intact piece.
    """
    ahead = (velocity[:, 0] > slowest) & (position[:, 0] < wall)
    place, speed, own, size = position[ahead], velocity[ahead], mass[ahead], size[ahead]
    time = (wall - place[:, 0]) / speed[:, 0]
    radius, momentum = np.abs(place[:, 1] + speed[:, 1] * time), own * speed[:, 0]
    reach = quantile(radius, momentum, CORE)
    within = radius <= reach
    delays = np.zeros(len(time))
    edges = [0.0, *(quantile(radius, momentum, CORE * (ring + 1) / RINGS) for ring in range(RINGS))]
    for inner, outer in zip(edges, edges[1:]):
        ring = (radius > inner) & (radius <= outer)
        delays[ring] = time[ring] - quantile(time[ring], momentum[ring], 0.5)
    sized = within & (size > 0)
    return Load(reach, own[within].sum() / (np.pi * reach**2), momentum[within].sum() / own[within].sum(), quantile(size[sized], own[sized], 0.5),
                delays[within], momentum[within], *sphere)


def load_of_run(run, wall, bodies, cell, slowest):
    """Load of the core of a section, whose snapshot is that before the wall. wall, cell: mm; slowest: km/s."""
    found = {name: particles_of(run, name) for name in bodies}
    both = {key: np.concatenate([own[key] for own in found.values()]) for key in ("position", "velocity", "mass", "fragment_size")}
    sphere = found["sphere"]
    intact = (sphere["failed"] == 0) & (sphere["phase"] < 2)
    label = joined(np.floor(1e3 * sphere["position"][intact][:, :2] / (LINK * cell)).astype(int)) if intact.any() else []
    total = sphere["mass"].sum()
    piece = np.bincount(label, sphere["mass"][intact]).max() / total if intact.any() else 0.0
    failed = sphere["mass"][~intact].sum() / total
    return load_of(1e3 * both["position"][:, :2], 1e-3 * both["velocity"][:, :2], 1e6 * both["mass"], 1e3 * both["fragment_size"],
                   wall, slowest, (failed, piece))


# ---- pieces


def joined(cubes):
    """Labels of pieces of cubes (integer places, one row each), those of one piece touch by a face, an edge or a corner."""
    unique, own = np.unique(cubes - cubes.min(axis=0) + 1, axis=0, return_inverse=True)
    stride = np.cumprod([1, *(unique.max(axis=0) + 2)[::-1]])[:-1][::-1]
    key = unique @ stride
    label = np.arange(len(key))
    pairs = []
    for shift in itertools.product((-1, 0, 1), repeat=cubes.shape[1]):
        if shift > (0,) * cubes.shape[1]:
            at = np.minimum(np.searchsorted(key, key + np.dot(shift, stride)), len(key) - 1)
            there = key[at] == key + np.dot(shift, stride)
            pairs.append(np.column_stack([np.flatnonzero(there), at[there]]))
    first, second = np.concatenate(pairs).T
    while (label[first] != label[second]).any():
        least = np.minimum(label[first], label[second])
        np.minimum.at(label, label[first], least)
        np.minimum.at(label, label[second], least)
        while (label[label] != label).any():
            label = label[label]
    return label[own.ravel()]


# ---- the tile


def tile_of(load, thickness, density, seed, coarser=1.0):
    """Tile for a load. thickness: mm; density: of the grains, g/cm^3; coarser: cell size over that of the rule.

    The grains' number is the whole one nearest to the load, their diameter changes a little to have its mass. They are at random
    places over the face and reach it at the quantiles of the delay; where they do not fit, the delays grow.
    """
    side = WIDTH * load.size
    wanted = coarser * min(load.size / ACROSS, thickness / THROUGH)
    number = max(1, round(load.mass * side**2 / (density * np.pi / 6 * load.size**3)))
    diameter = np.cbrt(load.mass * side**2 / (number * density * np.pi / 6))
    delays = np.array([load.delay((k + 0.5) / number) for k in range(number)])
    depth = load.speed * (delays - delays.min())
    random = np.random.default_rng(seed)
    while (centres := placed(random, depth, diameter, side)) is None:
        depth = 1.25 * depth + 0.25 * diameter * np.arange(number) / number
    return Tile(side, side / round(side / wanted), thickness, centres, diameter, load.speed)


def placed(random, depth, diameter, side, tries=1000):
    """Centres of spheres at random places across and given depths before the wall, without overlap; None if they do not fit."""
    centres = []
    for own in depth:
        for _ in range(tries):
            centre = np.array([-GAP_BEFORE - diameter / 2 - own, *random.uniform(diameter / 2, side - diameter / 2, 2)])
            if all(np.linalg.norm(centre - other) > 1.02 * diameter for other in centres):
                centres.append(centre)
                break
        else:
            return None
    return np.array(centres)


def tile_case(tile, diameter, grain, wall):
    """Text of a tile. diameter: of the sphere of the shot, mm; grain and wall: materials."""
    cell, side = tile.cell, tile.side
    end = tile.duration + 1e3 * DURATION * diameter
    lower = -cell * np.ceil((2 * tile.diameter - tile.centres[:, 0].min()) / cell)
    upper = cell * np.ceil((2 * tile.thickness + 0.3 * end) / cell)
    shapes = ", ".join(f'{{ sphere = {{ center = {vector(centre)}, radius = "{tile.diameter / 2:.9g} mm" }} }}' for centre in tile.centres)
    return f"""title = "grains on a tile of a wall"
[domain]
lower = {vector((lower, 0, 0))}
upper = {vector((upper, side, side))}
cell_size = "{cell:.12g} mm"
boundary = {{ y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }}
[time]
end = "{end:.6g} us"
[[body]]
name = "grains"
material = "{grain}"
velocity = ["{tile.speed:.9g} km/s", "0 m/s", "0 m/s"]
shape = {{ union = [{shapes}] }}
[[body]]
name = "wall"
material = "{wall}"
shape = {{ box = {{ lower = {vector((0, 0, 0))}, upper = {vector((tile.thickness, side, side))} }} }}
[output]
snapshot_every = "{end / SNAPSHOTS:.9g} us"
fields = ["density", "failed", "phase", "plastic_strain"]
"""


@dataclasses.dataclass(frozen=True)
class Off:
    """Part of a wall that has come off behind the pieces that close it: fraction of the tile's mass, speed relative to them (m/s) and
    mean distance behind them (mm)."""
    share: float = 0.0
    speed: float = 0.0
    distance: float = 0.0

    def leaves(self):
        """Whether it is enough to count, and moves away."""
        return self.share >= SPALL_SHARE and self.speed > SPALL_SPEED

    def __str__(self):
        return f"{100 * self.share:.2g} % of the tile are {self.distance:.2g} mm behind it and leave it at {self.speed:.3g} m/s"


@dataclasses.dataclass(frozen=True)
class Left:
    """What is left of the wall of a tile: whether a piece closes it, speed of its rear half (m/s), what has come off and does not close
    it, failed share, mean plastic strain."""
    closed: bool
    speed: float
    loose: Off
    failed: float
    strain: float


def left_of(tile, position, speed, mass, intact, strain, rear_half):
    """What is left of a tile's wall. position: mm, x along the flight; speed: along x, m/s; rear_half: began behind the middle.

    Material that has left the domain is not there: shares and the mean strain are of the mass that remains.
    """
    total = mass.sum()
    state = mass[~intact].sum() / total, (mass * strain).sum() / total
    label = np.full(len(mass), -1)
    if intact.any():
        label[intact] = joined(np.floor(position[intact] / (LINK * tile.cell)).astype(int))
    count = max(1, int(tile.side / (GAP * tile.cell)))
    column = np.clip((position[:, 1:] / (tile.side / count)).astype(int), 0, count - 1) @ [count, 1]
    closing = [own for own in (label == name for name in np.unique(label[intact])) if len(np.unique(column[own])) == count**2]
    if not closing:
        return Left(False, np.nan, Off(), *state)
    held = np.any(closing, axis=0)
    rear, weight, momentum = np.full(count**2, -np.inf), np.zeros(count**2), np.zeros(count**2)
    np.maximum.at(rear, column[held], position[held, 0])
    np.add.at(weight, column[held], mass[held])
    np.add.at(momentum, column[held], mass[held] * speed[held])
    distance, away = position[:, 0] - rear[column], speed - (momentum / weight)[column]
    loose = ~held & (distance > GAP * tile.cell)
    own = mass[loose]
    off = Off()
    if len(own) >= SPALL_PARTICLES:
        off = Off(own.sum() / total, (own * away[loose]).sum() / own.sum(), (own * distance[loose]).sum() / own.sum())
    behind = mass[rear_half].sum()
    return Left(True, (mass * speed)[rear_half].sum() / behind if behind > 0 else np.nan, off, *state)


def history(run, tile):
    """What is left of the wall in each snapshot of a tile: pairs of time (us) and Left."""
    files = json.loads(next(run.glob("*.particles.hdf.series")).read_text())["files"]
    first = particles_of(run, "wall", 0.0)
    behind = first["id"][1e3 * first["x"] > 0.5 * tile.thickness]
    found = []
    times = sorted(float(entry["time"]) for entry in files)
    for before, time in zip(times, times[1:]):
        if time - before < 1e-3 * times[-1]:
            continue  # the run's last snapshot follows that of its interval
        wall = particles_of(run, "wall", time)
        intact = (wall["failed"] == 0) & (wall["phase"] < 2)
        found.append((1e6 * time, left_of(tile, 1e3 * wall["position"], wall["velocity"][:, 0], wall["mass"], intact, wall["plastic_strain"],
                                          np.isin(wall["id"], behind))))
    return found


# ---- a shot


def shear_yield(material):
    """Yield stress in shear (Pa) of a material with the strength of Johnson and Cook: that of tension over sqrt(3)."""
    return value_of(material, "strength", "yield_stress") / np.sqrt(3)


def held_within(density, radius, speed, shear):
    """Distance (mm) in which the rim of a disc of any thickness stops it, by its yield in shear: rho R v^2/(4 tau).

    density: mg/mm^3 (g/cm^3); radius: mm; speed: m/s; shear: Pa.
    """
    return 1e3 * density * radius * speed**2 / (4 * shear)


def verdict_of(records, thickness, held):
    """Outcome of a tile and its reason (decision 25).

    records: of `history`; thickness: of the wall, mm; held: distance (mm) after which the rim of the core stops what has a speed (m/s).
    """
    def answer(outcome, time, reason):
        return {"outcome": outcome, "defeated": outcome in ("perforated", "detached spall"), "time": 1e-6 * time, "reason": reason}

    def undecided(reason):
        return {"outcome": "undecided", "defeated": None, "time": None, "reason": reason}

    for time, left in records:
        if not left.closed:
            return answer("perforated", time, "no intact piece closes the tile")
        if left.loose.leaves() and left.loose.distance >= thickness:
            return answer("detached spall", time, f"{left.loose}, loose")
    before, (time, now) = records[-2][1], records[-1]
    if not np.isfinite(now.speed):
        return undecided(f"the rear half of the tile has left the domain by {time:.3g} us: it has no speed")
    pushed = held(max(now.speed, 0.0))
    told = f"its rear half moves at {now.speed:.3g} m/s, which its rim stops after {pushed:.3g} mm"
    if pushed >= thickness:
        return answer("perforated", time, told)
    if now.loose.leaves():
        return answer("detached spall", time, f"{now.loose}, loose")
    if now.strain - before.strain > GROWTH * now.strain or now.failed - before.failed >= SPALL_SHARE:
        return undecided(f"the tile still deforms at {time:.3g} us")
    return answer("bulge" if pushed > BULGED * thickness else "whole", time, told)


@dataclasses.dataclass(frozen=True)
class Shot:
    """A shot as `whipple shield` plans it (--json), the keys of its section and its folder."""
    entry: dict
    case: dict
    folder: pathlib.Path

    def material(self, body):
        return next(own["material"] for own in self.case["body"] if own["name"] == body)

    @property
    def wall_at(self):
        """Front face of the wall on the axis (mm)."""
        return 1e3 * sum(bumper["thickness"] + bumper["spacing"] for bumper in self.entry["bumpers"])


def shot_in(entry, folder):
    """Shot whose section `whipple shield` has written into a folder."""
    return Shot(entry, tomllib.loads((folder / "case.toml").read_text(encoding="utf-8")), folder)


class RunFailed(Exception):
    """A run that ended because its model broke down (code 3), with the reason that it gives."""


def run(whipple, threads, text, folder):
    """Runs a case, which it writes beside the folder, unless the same program has done so. @throws RunFailed"""
    case = folder.parent / f"{folder.name}.toml"
    case.write_text(text, encoding="utf-8")
    commands.compute(whipple, folder, [["run", case, "--output", folder, "--force", "--quiet", "--threads", threads]], [case], allowed=(0, 3))
    status = json.loads((folder / "status.json").read_text(encoding="utf-8"))
    if status["state"] == "failed":
        raise RunFailed(f"the run of {folder.name} failed: {status['message']}")


def computed_load(whipple, threads, shot):
    """Load of the core of the cloud of a shot, from its section without the wall. @throws RunFailed"""
    folder = shot.folder / "cloud"
    run(whipple, threads, section_case(shot.case, shot.entry, shot.folder), folder)
    bodies = [body["name"] for body in shot.case["body"] if body["name"] != "wall"]
    return load_of_run(folder, shot.wall_at, bodies, FINER * 1e3 * shot.entry["case"]["cell_size"],
                       SLOWEST * 1e-3 * shot.entry["sphere"]["velocity"])


def tile_of_shot(shot, load, seed, coarser):
    """Tile of a shot. coarser: cell size over that of the rule."""
    return tile_of(load, 1e3 * shot.entry["wall"]["thickness"], value_of(shot.material("sphere"), "eos", "reference_density"), seed, coarser)


def computed_history(whipple, threads, shot, tile, folder):
    """What is left of the wall of a tile in every snapshot of its run in a folder. @throws RunFailed"""
    text = tile_case(tile, 1e3 * shot.entry["sphere"]["diameter"], shot.material("sphere"), shot.material("wall"))
    run(whipple, threads, text, folder)
    return history(folder, tile)


def judged(shot, load, tile, records):
    """Verdict of a tile of a shot."""
    wall = shot.material("wall")
    density, shear = value_of(wall, "eos", "reference_density"), shear_yield(wall)
    return verdict_of(records, tile.thickness, lambda speed: held_within(density, load.radius, speed, shear))
