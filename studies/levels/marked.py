#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What regions that follow the shock, and merging behind it, would add to regions that stay (docs/theory/levels.md, 6).

usage: marked.py RUN [--speed 5240] [--threshold 0.03]...

RUN is a run with small cells everywhere and snapshots of velocity, pressure and failed (studies/levels/levels.py makes such runs). At
each snapshot the cells are marked whose mean velocity differs from that of a neighbour by more than half of threshold c, or whose mean
pressure is above 0.1 rho_0 c^2; c is the sound speed (--speed, m/s). Large cells (two small ones per axis) have small functions only if one
of the 27 around them holds a mark; those within two cells of them are mixed, and have small particles too. Particles that have not been
moved do not count: the solver leaves them out.

What is printed is the number of particles that take part, over the snapshots, relative to small cells everywhere:
  follow        regions that follow the marks, particles that have once been fine remain so (split once, not merged)
  follow, merge the same, and particles of large cells are merged again in eights where none has failed or all have
  mixed         part of these that is mixed, and takes several times as long
"""
import argparse
import pathlib
import sys
import tomllib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.files import open_hdf5  # noqa: E402

STRONG = 0.1  # of rho_0 c^2, as `shocks_at_change` has it
AT_REST = 1e-3  # m/s


def grown(cells):
    """Cells of a grid and their 26 neighbours."""
    out = cells
    for axis in range(3):
        wide = out.copy()
        upper, lower = [slice(None)] * 3, [slice(None)] * 3
        upper[axis], lower[axis] = slice(1, None), slice(None, -1)
        wide[tuple(upper)] |= out[tuple(lower)]
        wide[tuple(lower)] |= out[tuple(upper)]
        out = wide
    return out


def marked_cells(place, shape, velocity, pressure, speed, threshold, density):
    """Marks of the small cells; those without particles have none."""
    flat = np.ravel_multi_index(place.T, shape)
    size = int(np.prod(shape))
    count = np.bincount(flat, minlength=size)
    holds = count > 0

    def mean(values):
        sums = np.bincount(flat, weights=values, minlength=size)
        return np.divide(sums, count, out=np.zeros(size), where=holds).reshape(shape)

    held = holds.reshape(shape)
    marked = held & (mean(pressure) > STRONG * density * speed**2)
    fields = [mean(velocity[:, a]) for a in range(3)]
    for axis in range(3):
        upper, lower = [slice(None)] * 3, [slice(None)] * 3
        upper[axis], lower[axis] = slice(1, None), slice(None, -1)
        upper, lower = tuple(upper), tuple(lower)
        both = held[upper] & held[lower]
        jump = np.sqrt(sum((field[upper] - field[lower]) ** 2 for field in fields))
        strong = both & (2.0 * jump > threshold * speed)
        marked[upper] |= strong
        marked[lower] |= strong
    return marked


def counts_of(file, once, arguments, lower, cell):
    """Particles that take part: with small cells, with regions that follow, with merging, and those of the last that are mixed; `once`
    holds which numbers of particles have been in small cells."""
    with open_hdf5(file) as stream:
        data = stream["VTKHDF"]["PointData"]
        position, velocity = stream["VTKHDF"]["Points"][:], data["velocity"][:]
        pressure, failed, number = data["pressure"][:], data["failed"][:] != 0, data["id"][:]
    place = np.floor((position - lower) / cell).astype(int)
    inside = np.all(place >= 0, axis=1)
    shape = tuple(place.max(axis=0) // 2 * 2 + 2)
    marked = marked_cells(place[inside], shape, velocity[inside], pressure[inside], arguments.speed, arguments.threshold, arguments.density)
    large = marked.reshape(shape[0] // 2, 2, shape[1] // 2, 2, shape[2] // 2, 2).any(axis=(1, 3, 5))
    inner = grown(large)
    fine = grown(grown(inner))
    of_large = np.where(inside[:, None], place // 2, 0)
    is_fine = inside & fine[tuple(of_large.T)]
    once[number[is_fine]] = True
    active = np.linalg.norm(velocity, axis=1) > AT_REST
    follows = np.where(once[number], 1.0, 0.125)
    # Merged: eight to one in a large cell, if all its particles have failed or none has.
    flat = np.ravel_multi_index(of_large.T, large.shape)
    count = np.bincount(flat)
    like = np.bincount(flat, weights=failed) / np.maximum(count, 1)
    merges = inside & ~is_fine & ((like[flat] == 0.0) | (like[flat] == 1.0))
    merged = np.where(once[number] & ~merges, 1.0, 0.125)
    layer = is_fine & ~inner[tuple(of_large.T)]
    return active.sum(), follows[active].sum(), merged[active].sum(), merged[active & layer].sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--speed", type=float, default=5240.0, help="sound speed, m/s (aluminium 6061)")
    parser.add_argument("--density", type=float, default=2703.0, help="at rest, kg/m^3")
    parser.add_argument("--threshold", type=float, nargs="*", default=[0.03, 0.1])
    arguments = parser.parse_args()
    files = sorted(arguments.run.glob("*.particles.*.hdf"))
    if not files:
        sys.exit(f"{arguments.run}: there are no snapshots (*.particles.*.hdf)")
    domain = tomllib.loads((arguments.run / "run.toml").read_text(encoding="utf-8"))["domain"]
    lower = np.array([float(value.split()[0]) for value in domain["lower"]])  # run.toml has SI units
    cell = float(domain["cell_size"].split()[0])
    largest = 0
    for file in files:
        with open_hdf5(file) as stream:
            largest = max(largest, int(stream["VTKHDF"]["PointData"]["id"][:].max()))
    thresholds = arguments.threshold
    print("| threshold of 2 dv/c | follow | follow, merge | mixed |\n| --- | --- | --- | --- |")
    for arguments.threshold in thresholds:
        once, sums = np.zeros(largest + 1, bool), np.zeros(4)
        for file in files:
            sums += counts_of(file, once, arguments, lower, cell)
        print(f"| {arguments.threshold:g} | {sums[1] / sums[0]:.2f} | {sums[2] / sums[0]:.2f} | {sums[3] / sums[2]:.2f} |")


if __name__ == "__main__":
    main()
