#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What do verdicts of tiles rest on? Loads, grains, lost mass, and a fit without a tile beside them.

Usage: python3 -m studies.shields.tile_checks [--work FOLDER] [--whipple PROGRAM]

Reads the folders of `run_shots --model tile` and prints for each tile that has ended: radius R of the core, momentum per area I of its
load, size and number of its grains, speed v of the rear half of the wall at the end, v over I/(rho t), the distance in which the rim
stops v over the thickness t (not a number where the tile has a hole), and the mass that the rear half has lost by the end.

Then, for tiles of the rule (seed 1, coarser 1): how many verdicts come out the same with v = k I/(rho t), without a tile, and how many of
the measured results; and, where a shot was repeated with other cells, the speed that a straight line through the sizes of cells has at
none (decision 25).
"""
import argparse
import dataclasses
import pathlib
import tomllib

import numpy as np

from report.particles import particles_of
from studies import commands
from studies.shields import page, run_shots, tile


@dataclasses.dataclass
class Check:
    """Figures of a tile: name of its shot and folder, radius of the core (mm), momentum per area (kPa s), size (mm) and number of its
    grains, cell (mm), speed of the rear half (m/s) and that of the load spread over the wall, distance of the rim over the thickness for both,
    part of the rear half that has left the domain."""
    shot: str
    run: str
    radius: float
    momentum: float
    size: float
    grains: int
    cell: float
    speed: float
    spread: float
    stopped: float
    spread_stopped: float
    lost: float

    def __str__(self):
        return (f"{self.shot:24} {self.run:11} R {self.radius:5.2f} mm  I {self.momentum:.3f} kPa s  {self.grains:2} of {self.size:.3f} mm  "
                f"v {self.speed:4.0f} m/s  v/(I/rho t) {self.speed / self.spread:.2f}  s/t {self.stopped:.2f}  lost {100 * self.lost:.1f} %")


def size_of(text):
    """Length (mm) as a case has it."""
    value, unit = text.split()
    return float(value) * {"m": 1e3, "cm": 10.0, "mm": 1.0}[unit]


def check_of(shot, load, run):
    """Figures of a tile that has ended."""
    case = tomllib.loads((run / "run.toml").read_text(encoding="utf-8"))
    side, cell = size_of(case["domain"]["upper"][1]), size_of(case["domain"]["cell_size"])
    grains = case["body"][0]["shape"].get("union", [case["body"][0]["shape"]])
    thickness = 1e3 * shot.entry["wall"]["thickness"]
    struck = tile.Tile(side, cell, thickness, np.zeros((len(grains), 3)), load.size, load.speed)
    density, shear = tile.value_of(shot.material("wall"), "eos", "reference_density"), tile.shear_yield(shot.material("wall"))
    first, last = particles_of(run, "wall", 0.0), particles_of(run, "wall")
    behind = first["id"][1e3 * first["x"] > 0.5 * thickness]
    masses = [wall["mass"][np.isin(wall["id"], behind)].sum() for wall in (first, last)]
    speed, spread = tile.history(run, struck)[-1][1].speed, 1e3 * load.mass * load.speed / (density * thickness)
    stopped, alone = (tile.held_within(density, load.radius, max(own, 0.0), shear) / thickness for own in (speed, spread))
    return Check(f"{shot.entry['source']}/{shot.entry['name']}", run.name, load.radius, load.mass * load.speed, load.size, len(grains), cell,
                 speed, spread, stopped, alone, 1 - masses[1] / masses[0])


def checks_of(work, entries):
    """Figures of the tiles in a folder of runs, by their order. entries: of `whipple shield --json`, by name."""
    stems = {name.replace("/", "_").replace(" ", "_"): name for name in entries}
    for folder in sorted(work.iterdir()):
        shot = tile.shot_in(entries[stems[folder.name.rpartition("_")[0]]], folder)
        bodies = [body["name"] for body in shot.case["body"] if body["name"] != "wall"]
        load = tile.load_of_run(folder / "cloud", shot.wall_at, bodies, tile.FINER * 1e3 * shot.entry["case"]["cell_size"],
                                tile.SLOWEST * 1e-3 * shot.entry["sphere"]["velocity"])
        for run in sorted(folder.glob("tile_*")):
            if run.is_dir():
                status = run_shots.status_of(run)
                if status["state"] == "done":
                    yield check_of(shot, load, run)
                else:
                    print(f"{folder.name} {run.name}: {status['state']} at {1e6 * status['time']:.3g} of {1e6 * status['end']:.3g} us, "
                          f"{load.size:.3g} mm: {status['message']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    entries = run_shots.plan(arguments.whipple, ["--model", "section"], [])
    found = list(checks_of(arguments.work, entries))
    print(*found, sep="\n")
    rule = [own for own in found if own.run == "tile_1_1"]
    scored = [own for own in rule if own.shot not in {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}]
    counts = [own.grains for own in scored]
    print(f"\n{len(scored)} scored tiles have {min(counts)} to {max(counts)} grains, {counts.count(3)} of them 3\n")
    for factor in np.arange(1.0, 3.01, 0.1):
        alike = sum((factor**2 * own.spread_stopped >= 1) == (own.stopped >= 1) for own in rule)
        right = sum((factor**2 * own.spread_stopped >= 1) == (entries[own.shot]["result"] == "P") for own in scored)
        print(f"v = {factor:.1f} I/(rho t): {alike} of {len(rule)} verdicts as with the tile, {right} of {len(scored)} as measured")
    print()
    for name in sorted({own.shot for own in found if own.run not in ("tile_1_1", "tile_2_1")}):
        own = [(check.cell, check.speed) for check in found if check.shot == name and check.run.startswith("tile_1_") and np.isfinite(check.speed)]
        slope, none = np.polyfit(*np.transpose(own), 1)
        print(f"{name}: {', '.join(f'{speed:.0f} m/s in {cell:.4g} mm' for cell, speed in sorted(own))}; straight line: {none:.0f} m/s in none")


if __name__ == "__main__":
    main()
