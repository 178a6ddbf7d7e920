#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Is it the grain that decides a tile, or the load? Tiles of shots struck by the same mass as dust in the same cells.

Usage: python3 -m studies.shields.tile_control [--count 3] [--work FOLDER] [--whipple PROGRAM]

The control that decision 25 lacks. The first shots with a tile in outcomes.csv in the order of the SHA-256 of their names, so that no
outcome chooses; each with the load of its own section, on the tile of the rule (seed 1), as

grains          the spheres of the rule
dust as grains  single particles (cubes of half a cell) at random places, with the mean load of grains at all their possible places: in the
                middle of the tile 1.65 times that of its rim and beyond
dust            single particles, each in a column of a cell in turn: a uniform load

of the same mass, speed and quantiles of the delay. Writes a row for each to tile_control.csv: outcome by the rule, speed v of the rear half
of the wall, v over that of the load spread over the wall, I/(rho t), distance in which the rim stops v over the thickness. Tiles with a
row are not computed again.
"""
import argparse
import pathlib
import re

import numpy as np

from studies import commands
from studies.shields import page, run_shots, three_dimensions, tile

FILE = page.HERE / "tile_control.csv"
LOADS = ("grains", "dust as grains", "dust")
SEED = 1


def chosen(rows, count):
    """Names of the shots: see above. rows: of outcomes.csv"""
    tiles = [row["shot"] for row in rows if row["model"] == "tile" and not row["reason"].endswith(")")]
    calibrating = {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    return sorted(set(tiles) - calibrating, key=three_dimensions.order)[:count]


def dust_of(load, struck, density, like_grains, seed=SEED):
    """Lower corners (mm) of single particles with the load of a tile, each half a cell wide; density: g/cm^3."""
    edge, random = 0.5 * struck.cell, np.random.default_rng(seed)
    number, wide = round(load.mass * struck.side**2 / (density * edge**3)), round(struck.side / edge)
    delays = np.array([load.delay((k + 0.5) / number) for k in range(number)])
    depth = np.floor(load.speed * (delays - delays.min()) / edge).astype(int) + 1
    columns, taken, corners = random.permutation((wide // 2)**2), set(), []
    for k, own in enumerate(random.permutation(depth)):
        while True:
            if like_grains:
                centre = random.uniform(struck.diameter / 2, struck.side - struck.diameter / 2, 2)
                y, z = np.minimum((centre + in_disc(random, struck.diameter / 2)) / edge, wide - 1).astype(int)
            else:
                column = columns[k % len(columns)]
                y, z = 2 * (column % (wide // 2)) + random.integers(2), 2 * (column // (wide // 2)) + random.integers(2)
            place = (-int(own), int(y), int(z))
            if place not in taken:
                break
            own += int(like_grains or random.integers(2))  # where columns are full the particle follows later
        taken.add(place)
        corners.append([edge * index for index in place])
    return np.array(corners)


def in_disc(random, radius):
    """Projection of a random place in a sphere onto the face of the tile."""
    while True:
        place = random.uniform(-radius, radius, 3)
        if place @ place <= radius**2:
            return place[1:]


def dust_case(text, corners, edge):
    """The case of a tile with dust for its grains, in a domain that has room for it; edge: of a particle, half a cell, mm. @throws ValueError where
    it has no grains"""
    lines = text.splitlines(keepends=True)
    for k, line in enumerate(lines):
        if found := re.match(r'lower = \["(-[0-9.]+) mm", (.*)', line):
            room = 2 * edge * np.ceil(-corners[:, 0].min() / (2 * edge) + 4)
            lines[k] = f'lower = ["{min(float(found.group(1)), -room):.9g} mm", {found.group(2)}\n'
    own = [k for k, line in enumerate(lines) if line.startswith("shape = { union")]
    if len(own) != 1:
        raise ValueError("the case has no single union of grains")
    boxes = ", ".join(f"{{ box = {{ lower = {tile.vector(corner)}, upper = {tile.vector(corner + edge)} }} }}" for corner in corners)
    lines[own[0]] = f"shape = {{ union = [{boxes}] }}\n"
    return "".join(lines)


def row_of(name, kind, shot, load, struck, verdict, records, count):
    """Row of tile_control.csv."""
    density = tile.value_of(shot.material("wall"), "eos", "reference_density")
    spread = 1e3 * load.mass * load.speed / (density * struck.thickness)
    speed = records[-1][1].speed
    pushed = tile.held_within(density, load.radius, max(speed, 0.0), tile.shear_yield(shot.material("wall")))
    return {"shot": name, "load": kind, "number": count, "cell size [mm]": f"{struck.cell:.4g}", "outcome": verdict["outcome"],
            "speed [m/s]": f"{speed:.4g}", "over spread": f"{speed / spread:.3g}", "rim over thickness": f"{pushed / struck.thickness:.3g}",
            "failed": f"{records[-1][1].failed:.3g}"}


def controlled(whipple, name, entry, work, missing):
    """Rows of a shot with the loads that are missing."""
    folder = run_shots.folder_of(whipple, ["--model", "section"], name, work)
    shot = tile.shot_in(entry, folder)
    load = tile.computed_load(whipple, 1, shot)
    struck = tile.tile_of_shot(shot, load, SEED, 1.0)
    density = tile.value_of(shot.material("sphere"), "eos", "reference_density")
    for kind in missing:
        text = tile.tile_case(struck, 1e3 * entry["sphere"]["diameter"], shot.material("sphere"), shot.material("wall"))
        count = len(struck.centres)
        if kind != "grains":
            corners = dust_of(load, struck, density, kind == "dust as grains")
            count, text = len(corners), dust_case(text, corners, 0.5 * struck.cell)
        run = folder / kind.replace(" ", "_")
        tile.run(whipple, 1, text, run)
        records = tile.history(run, struck)
        yield row_of(name, kind, shot, load, struck, tile.judged(shot, load, struck, records), records, count)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "tile_control")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    names = chosen(page.read_csv(page.HERE / "outcomes.csv"), arguments.count)
    entries = run_shots.plan(arguments.whipple, ["--model", "section"], names)
    for name in names:
        done = {row["load"] for row in page.read_csv(FILE) if row["shot"] == name}
        for row in controlled(arguments.whipple, name, entries[name], arguments.work, [kind for kind in LOADS if kind not in done]):
            run_shots.append(FILE, row, list(row))
            print(", ".join(f"{key} {value}" for key, value in row.items()), flush=True)


if __name__ == "__main__":
    main()
