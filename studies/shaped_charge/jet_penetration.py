#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Depth to which the jet of a shaped charge penetrates a block, beside the hydrodynamic law; cases/jet_penetration.

Usage: studies/shaped_charge/jet_penetration.py RUN...

The law (Birkhoff, MacDougall, Pugh and Taylor, J. Appl. Phys. 19 (1948) 563): where the jet has the velocity V, the bottom of the
hole moves with U = V/[1 + (rho_t/rho_j)^(1/2)]. V is that of the jet at the bottom, taken from the last snapshot before the jet
arrives: every particle within 5 mm of the axis that moves faster than a quarter of the tip flies on as it is, so that the jet
stretches. The bottom of the hole in the run is the place nearest to the surface at which steel is within two cells of the axis.
"""
import argparse
import pathlib
import sys
import tomllib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.detonation import particles_of, snapshots_of  # noqa: E402

LINER_DENSITY, BLOCK_DENSITY = 8930.0, 7830.0  # kg/m^3
NEAR_AXIS = 5e-3  # m
TIP_SHARE = 0.001  # of the liner's mass beyond the surface: the jet has arrived


def length_of(text):
    """Metres of a length as run.toml writes it."""
    number, unit = text.split()
    return float(number) * {"m": 1.0, "mm": 1e-3}[unit]


def bottom(run, file, cell):
    """Place (m) of the steel on the axis that is nearest to the charge."""
    block = particles_of(run, "block", file)
    on_axis = block["position"][:, 1] < 2.0 * cell
    return block["x"][on_axis].min() if on_axis.any() else np.nan


def law(places, velocities, start, times, surface):
    """Depth (m) at times (s): particles that are at `places` at the time `start`, and fly on with `velocities`."""
    fastest = velocities.argsort()[::-1]
    places, velocities = places[fastest], velocities[fastest]
    ratio = 1.0 + np.sqrt(BLOCK_DENSITY / LINER_DENSITY)
    depth, now, step, found = 0.0, start, 2e-8, []
    for time in times:
        while now < time:
            ahead = places + velocities * (now - start) - (surface + depth)
            # The jet at the bottom: particles that would be within 3 mm of it, or none have come yet.
            here = np.abs(ahead) < 3e-3
            speed = velocities[here].mean() if here.any() and (ahead >= 0.0).any() else 0.0
            depth += step * speed / ratio
            now += step
        found.append(depth)
    return found


def depths(run):
    """Times (s), depths of the hole and of the law (m)."""
    settings = tomllib.loads((run / "run.toml").read_text(encoding="utf-8"))
    cell = length_of(settings["domain"]["cell_size"])
    snapshots = snapshots_of(run)
    surface = bottom(run, snapshots[0][1], cell)
    arrived = None
    for number, (_, file) in enumerate(snapshots):
        liner = particles_of(run, "liner", file)
        if liner["mass"][liner["x"] > surface].sum() > TIP_SHARE * liner["mass"].sum():
            arrived = number
            break
    if arrived is None or arrived == 0:
        raise SystemExit(f"{run}: the jet does not arrive at the block")
    start, file = snapshots[arrived - 1]
    liner = particles_of(run, "liner", file)
    velocity = liner["velocity"][:, 0]
    order = velocity.argsort()[::-1]
    tip = velocity[order[np.searchsorted(np.cumsum(liner["mass"][order]), 0.005 * liner["mass"].sum())]]
    jet = (liner["position"][:, 1] < NEAR_AXIS) & (velocity > 0.25 * tip) & (velocity < 1.1 * tip)
    times = [time for time, _ in snapshots[arrived:]]
    return tip, start, times, [bottom(run, file, cell) - surface for _, file in snapshots[arrived:]], \
        law(liner["x"][jet], velocity[jet], start, times, surface)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    print("| run | time, us | depth, mm | hydrodynamic law, mm |\n| --- | --- | --- | --- |")
    for run in parser.parse_args().runs:
        tip, start, *found = depths(run)
        for time, depth, of_law in zip(*found):
            print(f"| {run.name} | {1e6 * time:.1f} | {1e3 * depth:.1f} | {1e3 * of_law:.1f} |")
        print(f"tip of {run.name} {1e-3 * tip:.2f} km/s at {1e6 * start:.1f} us")


if __name__ == "__main__":
    main()
