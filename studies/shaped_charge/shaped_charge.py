#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Jet of the shaped charge of cases/shaped_charge_81mm: mass that is faster than a velocity, beside the theory of Pugh,
Eichelberger and Rostoker, and a picture of velocity and temperature.

Usage: studies/shaped_charge/shaped_charge.py RUN... [--half-angle 21] [--explosive composition_b] [--picture FILE.png]

Theory (J. Appl. Phys. 23 (1952) 532): an element of the cone at x from the apex is reached by a plane detonation of velocity D,
collapses with V0(x) under the angle of Taylor, sin(delta) = V0 cos(alpha)/(2 D), A = alpha + delta, and meets the axis at

    tan(beta) = {sin a + 2 sin d cos A - x sin a [1 - tan A tan a] V0'/V0}
              / {cos a - 2 sin d sin A + x sin a [tan A + tan a] V0'/V0}
    V_jet = V0 cos(a + d - beta/2)/sin(beta/2),  dm_jet/dm = sin^2(beta/2)

V0 is Gurney's velocity of an open-faced sandwich, sqrt(2E) {[(1 + 2m)^3 + 1]/[6 (1 + m)] + m}^(-1/2), m the mass of the liner
over that of the explosive outside of it, which it approaches as 1 - exp(-t/tau), tau = mu V/(2 p_CJ), mu its mass per area
(form of Chou and Flis, as remembered); V0 is what it has where it meets the axis. Elements near the apex, which are slower than
the next, join them: the tip has the mean velocity of the jet up to where it equals that of the element.
"""
import argparse
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402

CHARGE_RADIUS, BASE_RADIUS, WALL, LINER_DENSITY = 41.5e-3, 40.65e-3, 1.905e-3, 8930.0  # m, kg/m^3
# Density, kg/m^3, D and sqrt(2E), m/s, p_CJ, Pa.
EXPLOSIVES = {"composition_b": (1717.0, 7980.0, 2700.0, 29.5e9), "lx_10": (1860.0, 8820.0, 2970.0, 37.5e9)}
SHARES = (0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2)


def theory(half_angle, explosive):
    """Velocity (m/s) of the jet and its mass over that of the liner, of elements by decreasing velocity; and the fraction of the
    liner that becomes jet."""
    density, D, gurney, pressure = EXPLOSIVES[explosive]
    a = np.radians(half_angle)
    length = BASE_RADIUS / np.tan(a)
    x = np.linspace(0.02, 0.98, 2000) * length
    r = x * np.tan(a)
    m = LINER_DENSITY * WALL / (density * (CHARGE_RADIUS**2 - r**2) / (2.0 * r) * np.cos(a))
    final = gurney / np.sqrt(((1 + 2 * m) ** 3 + 1) / (6 * (1 + m)) + m)
    tau = 0.5 * LINER_DENSITY * WALL * final / pressure
    way = r / (final * tau)
    time = way + 1.0  # over tau; t - tau (1 - exp(-t/tau)) = r/V, by Newton's iteration from above
    for _ in range(50):
        time -= (time - 1 + np.exp(-time) - way) / (1 - np.exp(-time))
    v0 = final * (1 - np.exp(-time))
    gradient = x * np.gradient(v0, x) / v0
    d = np.arcsin(v0 * np.cos(a) / (2.0 * D))
    A = a + d
    beta = np.arctan2(np.sin(a) + 2 * np.sin(d) * np.cos(A) - np.sin(a) * (1 - np.tan(A) * np.tan(a)) * gradient,
                      np.cos(a) - 2 * np.sin(d) * np.sin(A) + np.sin(a) * (np.tan(A) + np.tan(a)) * gradient)
    jet = v0 * np.cos(a + d - beta / 2) / np.sin(beta / 2)
    of_liner = r / np.trapezoid(r, x) if hasattr(np, "trapezoid") else r / np.trapz(r, x)
    mass = np.sin(beta / 2) ** 2 * of_liner * (x[1] - x[0])
    mean = np.cumsum(jet * mass) / np.cumsum(mass)
    joined = 1 + np.argmax(mean[1:] >= jet[1:])  # the first element that is no faster than the mean of those before it
    velocity = np.concatenate([[mean[joined]], jet[joined + 1:]])
    return velocity, np.cumsum(np.concatenate([[mass[:joined + 1].sum()], mass[joined + 1:]])), mass.sum()


def speeds(run):
    """Axial velocities (m/s) that the fractions of the liner's mass exceed at the last snapshot."""
    found = particles_of(run, "liner")
    order = found["velocity"][:, 0].argsort()[::-1]
    mass = found["mass"][order].cumsum() / found["mass"].sum()
    return [found["velocity"][order[np.searchsorted(mass, share)], 0] for share in SHARES]


def picture(run, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    found = particles_of(run, "liner")
    places = 1e3 * found["position"]
    figure, axes = plt.subplots(2, 1, figsize=(11, 5), sharex=True, layout="constrained")
    for axis, values, label in ((axes[0], 1e-3 * found["velocity"][:, 0], "axial velocity, km/s"),
                                (axes[1], found["temperature"], "temperature, K")):
        order = values.argsort()
        for side in (1, -1):
            points = axis.scatter(places[order, 0], side * places[order, 1], c=values[order], s=1.5, cmap="inferno",
                                  vmax=np.percentile(values, 99))
        figure.colorbar(points, ax=axis, label=label)
        axis.set(ylabel="radius, mm", aspect="equal", ylim=(-25, 25))
    axes[1].set(xlabel="axis, mm")
    figure.savefig(path, dpi=110)
    print(f"wrote {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="*", type=pathlib.Path)
    parser.add_argument("--half-angle", type=float, default=21.0)
    parser.add_argument("--explosive", choices=sorted(EXPLOSIVES), default="composition_b")
    parser.add_argument("--picture", type=pathlib.Path)
    arguments = parser.parse_args()
    velocity, mass, share = theory(arguments.half_angle, arguments.explosive)
    print("| axial velocity, km/s, that a fraction of the liner exceeds | " + " | ".join(f"{100 * s:g} %" for s in SHARES) + " |")
    print("| --- " * (len(SHARES) + 1) + "|")
    row = [velocity[np.searchsorted(mass, s)] if s <= mass[-1] else np.nan for s in SHARES]
    print(f"| theory (tip {1e-3 * velocity[0]:.2f} km/s of {100 * mass[0]:.1f} %, jet {100 * share:.1f} %) | "
          + " | ".join(f"{1e-3 * v:.2f}" for v in row) + " |")
    for run in arguments.runs:
        print(f"| {run.name} | " + " | ".join(f"{1e-3 * v:.2f}" for v in speeds(run)) + " |")
    if arguments.picture and arguments.runs:
        picture(arguments.runs[-1], arguments.picture)


if __name__ == "__main__":
    main()
