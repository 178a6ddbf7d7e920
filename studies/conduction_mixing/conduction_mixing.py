# SPDX-License-Identifier: BSD-3-Clause
"""Compares rates of the mixing within a cell (docs/theory/conduction.md, eq. 3) in one dimension.

A rod of 20 cells with adiabatic ends, its particles on a lattice or displaced at random, by the matrices of the
scheme: largest eigenvalue (in a/dx^2), error of the slowest decay at the time at which its amplitude is 1/e, and how far
a step of temperature leaves its range.

    python -m studies.conduction_mixing.conduction_mixing
"""
import numpy as np

CELLS = 20
RATES = (0, 4, 8, 12)  # a/dx^2
STABLE = 1 / 18  # dx^2/a


def weights(positions):
    """Returns values and gradients of the quadratic B-splines of the nodes (rows) at the particles (columns)."""
    value = np.zeros((CELLS + 1, len(positions)))
    gradient = np.zeros_like(value)
    for p, x in enumerate(positions):
        nearest = int(np.floor(x + 0.5))
        for i in (nearest - 1, nearest, nearest + 1):
            r = x - i
            inside = abs(r) <= 0.5
            image = 2 * CELLS - i if i > CELLS else abs(i)  # nodes beyond a mirror plane
            value[image, p] += 0.75 - r * r if inside else 0.5 * (1.5 - abs(r)) ** 2
            gradient[image, p] += -2 * r if inside else -(1.5 - abs(r)) * np.sign(r)
    return value, gradient


def decay_matrix(positions, rate):
    """Returns M of dT/dt = -M T for particles of equal mass and volume."""
    value, gradient = weights(positions)
    capacity = value.sum(axis=1)
    used = capacity > 0
    value, gradient, capacity = value[used], gradient[used], capacity[used]
    to_nodes = value / capacity[:, None]
    differences = np.eye(len(positions)) - value.T @ to_nodes
    flux = value.T @ (gradient @ (gradient.T @ to_nodes) / capacity[:, None])
    return flux + rate * differences @ differences


def measures(positions, rate):
    """Returns largest eigenvalue, error of the decay and excess over the range of a step."""
    matrix = decay_matrix(positions, rate)
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


if __name__ == "__main__":
    main()
