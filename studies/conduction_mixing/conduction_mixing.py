# SPDX-License-Identifier: BSD-3-Clause
"""Compares rates of the mixing within a cell (docs/theory/conduction.md, eq. 3) in one dimension.

A rod with adiabatic ends by the matrices of the scheme. One material, 20 cells, particles on a lattice or displaced at
random: largest eigenvalue (in a/dx^2), error of the slowest decay at the time at which its amplitude is 1/e, and how far
a step of temperature leaves its range. Two materials, conductivities 8 : 1, at two temperatures: largest error of all
particles and of those away from the interface.

    python -m studies.conduction_mixing.conduction_mixing
"""
import argparse
import math

import numpy as np

CELLS = 20
RATES = (0, 4, 8, 12)  # a/dx^2
STABLE = 1 / 18  # dx^2/a


def weights(positions, cells):
    """Returns values and gradients of the quadratic B-splines of the nodes (rows) at the particles (columns)."""
    value = np.zeros((cells + 1, len(positions)))
    gradient = np.zeros_like(value)
    for p, x in enumerate(positions):
        nearest = int(np.floor(x + 0.5))
        for i in (nearest - 1, nearest, nearest + 1):
            r = x - i
            inside = abs(r) <= 0.5
            image = 2 * cells - i if i > cells else abs(i)  # nodes beyond a mirror plane
            value[image, p] += 0.75 - r * r if inside else 0.5 * (1.5 - abs(r)) ** 2
            gradient[image, p] += -2 * r if inside else -(1.5 - abs(r)) * np.sign(r)
    return value, gradient


def decay_matrix(positions, cells, rate, conductance, capacity):
    """Returns M of dT/dt = -M T; conductance V k and heat capacity m c of every particle."""
    value, gradient = weights(positions, cells)
    of_node = value @ capacity
    used = of_node > 0
    value, gradient, of_node = value[used], gradient[used], of_node[used]
    to_nodes = value * capacity / of_node[:, None]
    differences = np.eye(len(positions)) - value.T @ to_nodes
    given = rate * conductance[:, None] * differences  # by the particles to their nodes
    at_nodes = gradient @ (conductance[:, None] * (gradient.T @ to_nodes)) - value @ given
    return value.T @ (at_nodes / of_node[:, None]) + given / capacity[:, None]


def interface(cells, rate):
    """Returns errors over the jump of temperature between two materials: of all particles, away from the interface."""
    count = 2 * cells
    positions = (np.arange(count) + 0.5) / 2
    left = positions < cells / 2
    diffusivity = np.where(left, 1.0, 1 / 18)
    effusivity = (1.0, math.sqrt(1 / 8 * 9 / 4))
    capacity = np.where(left, 0.5, 9 / 8)
    matrix = decay_matrix(positions, cells, rate, diffusivity * capacity, capacity)
    steps = int(0.012 * cells**2 / STABLE)
    result = np.linalg.matrix_power(np.eye(count) - STABLE * matrix, steps) @ left.astype(float)
    x = positions - cells / 2
    between = effusivity[0] / sum(effusivity)
    decay = np.array([math.erf(abs(d) / math.sqrt(4 * a * steps * STABLE)) for d, a in zip(x, diffusivity)])
    error = abs(result - (between + (left - between) * decay))
    return error.max(), error[abs(x) > cells / 16].max()


def measures(positions, rate):
    """Returns largest eigenvalue, error of the decay and excess over the range of a step."""
    ones = np.full(len(positions), 1.0)
    matrix = decay_matrix(positions, CELLS, rate, ones, ones)
    step = np.where(positions < CELLS / 2, 1.0, 0.0)
    excess = 0.0
    for _ in range(4000):
        step = step - STABLE * matrix @ step
        excess = max(excess, -step.min(), step.max() - 1)
    wave = np.pi / CELLS
    exact = np.cos(wave * positions)
    smooth = exact.copy()
    steps = int(1 / wave**2 / STABLE)
    for _ in range(steps):
        smooth = smooth - STABLE * matrix @ smooth
    exact *= np.exp(-wave**2 * steps * STABLE)
    error = np.sqrt(np.mean((smooth - exact) ** 2)) * np.e
    return np.linalg.eigvals(matrix).real.max(), error, excess


def main():
    """Prints the table."""
    for name, per_cell, shift in (("two in a cell", 2, 0), ("displaced by 0.3", 2, 0.3), ("one in a cell", 1, 0)):
        count = CELLS * per_cell
        shifts = np.random.default_rng(1).uniform(-shift, shift, count)
        positions = (np.arange(count) + 0.5 + shifts) / per_cell
        for rate in RATES:
            largest, error, excess = measures(positions, rate)
            print(f"{name:18} rate {rate:2}: largest eigenvalue {largest:5.2f}, error of the decay {100 * error:5.2f} %, "
                  f"beyond the step {100 * excess:5.2f} %")
    for rate in (0, 1, 4):
        for cells in (32, 64, 128):
            everywhere, away = interface(cells, rate)
            print(f"two materials, rate {rate}, {cells:3} cells: {100 * everywhere:5.1f} %, away {100 * away:5.1f} %")


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    main()
