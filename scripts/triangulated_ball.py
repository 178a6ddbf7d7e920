#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a ball of 10 mm as binary STL in millimetres, with or without holes, and a case of it: inputs of the
measurements in docs/decisions/0027_bodies_from_files.md."""

import argparse
import struct
from pathlib import Path

import numpy as np

RADIUS = 10.0  # mm
CASE = """title = "Ball from a file"
[domain]
lower = ["-12 mm", "-12 mm", "-12 mm"]
upper = ["12 mm", "12 mm", "12 mm"]
cell_size = "{cell} mm"
[time]
end = "0.1 us"
[[body]]
name = "ball"
material = "copper"
velocity = ["0 m/s", "0 m/s", "100 m/s"]
shape = {shape}
"""


def triangles(rows: int) -> np.ndarray:
    """Divides the sphere into rows of latitude and twice as many of longitude: 4 rows (rows - 1) triangles."""
    i, j = np.arange(rows + 1)[:, None], np.arange(2 * rows)[None, :]
    polar, around = np.pi * i / rows, np.pi * j / rows
    places = RADIUS * np.stack(
        [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar) + 0 * around], -1
    ).astype("<f4")
    places[0], places[-1] = [0, 0, RADIUS], [0, 0, -RADIUS]
    a, b = places[:-1], places[1:]
    c, d = np.roll(b, -1, 1), np.roll(a, -1, 1)
    lower = np.stack([a, b, c], 2)[:-1].reshape(-1, 3, 3)
    upper = np.stack([a, c, d], 2)[1:].reshape(-1, 3, 3)
    return np.concatenate([lower, upper])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="gets ball.stl, ball.toml and sphere.toml")
    parser.add_argument("--rows", type=int, default=500, help="of latitude (default: 500)")
    parser.add_argument("--missing", type=float, default=0.0, help="part of the triangles left out (default: 0)")
    parser.add_argument("--cell", type=float, default=0.32, help="cells of the case in mm (default: 0.32)")
    options = parser.parse_args()
    kept = triangles(options.rows)
    if options.missing > 0.0:
        kept = kept[np.random.default_rng(1).random(len(kept)) >= options.missing]
    records = np.zeros(len(kept), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("none", "<u2")])
    records["corners"] = kept
    options.folder.mkdir(parents=True, exist_ok=True)
    header = b"solid".ljust(80) + struct.pack("<I", len(kept))
    (options.folder / "ball.stl").write_bytes(header + records.tobytes())
    surface = '{ surface = { file = "ball.stl", unit = "1 mm" } }'
    sphere = '{ sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "10 mm" } }'
    for name, shape in (("ball", surface), ("sphere", sphere)):
        (options.folder / f"{name}.toml").write_text(CASE.format(cell=options.cell, shape=shape))
    print(f"{len(kept)} triangles")


if __name__ == "__main__":
    main()
