#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Depth that the jet of a shaped charge reaches in a target, beside the hydrodynamic law of a jet that stretches.

Usage: studies/shaped_charge/penetration.py FREE_RUN [RUN...] [--face 0.271] [--target-density 7830] [--resistance 0]

FREE_RUN is the charge without a target (cases/shaped_charge_81mm). Each of its elements flies on with its velocity v; at the time
tau from the last snapshot on it is at x(v) + v tau. A jet of density rho_j penetrates with u = v/(1 + g), g = sqrt(rho_t/rho_j)
(Birkhoff et al., J. Appl. Phys. 19 (1948) 563), so that the element that is at the floor z of the crater follows from

    dz = u dtau,  z = x(v) + v tau:   d(tau)/dv = -(dx/dv + tau)/(v - u),   z = face at the speed of the tip

Every length l of the jet as it arrives deepens the crater by l sqrt(rho_j/rho_t). Where all elements come from one place x0, that is

    z - x0 = (face - x0) (v_tip/v)^(1/g)                 (Abrahamson and Goodier, J. Appl. Phys. 34 (1963) 195)

With a resistance R of the target, rho_j (v - u)^2 = rho_t u^2 + 2 R instead (Eichelberger, J. Appl. Phys. 27 (1956) 63). RUN: the
same charge before the target; its depth is crater_depth.target of the report.
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report import program  # noqa: E402
from report.particles import snapshot_at, particles_of  # noqa: E402

JET_DENSITY = 8930.0  # kg/m^3
TIP = 0.005  # of the liner's mass is faster than what counts as the tip


def penetration_speed(v, target_density, resistance):
    """Speed u (m/s) of the floor under a jet of the velocity v; 0 where the resistance (Pa) stops it."""
    r = target_density / JET_DENSITY
    stopped = JET_DENSITY * v**2 <= 2.0 * resistance
    if abs(r - 1.0) < 1e-9:
        u = 0.5 * v - resistance / (JET_DENSITY * v)
    else:
        u = (v - np.sqrt(r * v**2 + (1.0 - r) * 2.0 * resistance / JET_DENSITY)) / (1.0 - r)
    return np.where(stopped, 0.0, u)


def penetrate(v, x, face, target_density, resistance=0.0):
    """Times tau (s) and depths (m) at which elements of a jet, of falling velocities v (m/s) and at x (m) at tau = 0, are used up
    at the floor of a crater that begins at `face`; ends where the target stops the jet. By the midpoint rule in v."""
    tau, depth = [(face - x[0]) / v[0]], [0.0]
    for i in range(1, len(v)):
        middle, slope = 0.5 * (v[i - 1] + v[i]), (x[i] - x[i - 1]) / (v[i] - v[i - 1])
        u = float(penetration_speed(middle, target_density, resistance))
        if u <= 0.0:
            break
        step = v[i] - v[i - 1]
        rate = 1.0 / (middle - u)
        # d(tau)/dv = -(slope + tau) rate, exactly over the step
        later = (slope + tau[-1]) * np.exp(-step * rate) - slope
        tau.append(later)
        depth.append(x[i] + v[i] * later - face)
    return np.array(tau), np.array(depth)


def jet_of(run, slowest, steps=60):
    """Velocities (m/s), falling, and mean places (m) of the elements of a liner's jet at the last snapshot."""
    found = particles_of(run, "liner")
    speed = found["velocity"][:, 0]
    edges = np.linspace(program.measure(run, f"jet_speed.liner fraction={TIP}"), slowest, steps + 1)
    v, x = [], []
    for upper, lower in zip(edges, edges[1:]):
        own = (speed <= upper) & (speed > lower)
        if own.any():
            v.append(np.average(speed[own], weights=found["mass"][own]))
            x.append(np.average(found["x"][own], weights=found["mass"][own]))
    return np.array(v), np.array(x)


def depths(run):
    """Times (s) and depths (m) of the crater at the snapshots of a run."""
    with (run / "report" / "series.csv").open(newline="") as stream:
        rows = [{head.split(" [")[0]: float(cell) for head, cell in row.items()} for row in csv.DictReader(stream)]
    return np.array([row["time"] for row in rows]), np.array([row["crater_depth.target"] for row in rows])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("free", type=pathlib.Path)
    parser.add_argument("runs", nargs="*", type=pathlib.Path)
    parser.add_argument("--face", type=float, default=0.271, help="place of the target along the axis, m")
    parser.add_argument("--target-density", type=float, default=7830.0, help="kg/m^3")
    parser.add_argument("--resistance", type=float, default=0.0, help="of the target, Pa")
    parser.add_argument("--slowest", type=float, default=2000.0, help="velocity of the last element, m/s")
    arguments = parser.parse_args()
    v, x = jet_of(arguments.free, arguments.slowest)
    tau, depth = penetrate(v, x, arguments.face, arguments.target_density, arguments.resistance)
    time = snapshot_at(arguments.free)[1] + tau
    found = [depths(run) for run in arguments.runs]
    print("| time, us | v at the floor, km/s | depth by the law, mm | " + "".join(f"{run.name}, mm | " for run in arguments.runs))
    print("| --- " * (3 + len(found)) + "|")
    for t in np.arange(20e-6 * np.ceil(time[0] / 20e-6), min([time[-1], *(of_run[0][-1] for of_run in found)]) + 1e-9, 20e-6):
        print(f"| {1e6 * t:.0f} | {1e-3 * np.interp(t, time, v[:len(time)]):.2f} | {1e3 * np.interp(t, time, depth):.0f} | "
              + "".join(f"{1e3 * np.interp(t, *of_run):.0f} | " for of_run in found))
    print(f"\nby the law until the target stops it or its slowest element of {1e-3 * v[len(time) - 1]:.2f} km/s: "
          f"{1e3 * depth[-1]:.0f} mm")


if __name__ == "__main__":
    main()
