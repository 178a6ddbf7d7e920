#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Head of ellipsoids: its label image, and what a run of cases/head_impact shows.

usage: head.py image [--voxel MM] [FILE]   writes the image (cases/head_impact/head.nrrd), prints the volume of every label beside that of the ellipsoids
       head.py picture RUN [FILE]          draws the pressure at the peak of the force (docs/images/head_impact.png)
       head.py table RUN...                prints momentum against impulse, acceleration against force over mass, and the pressure along the brain

The image: semi-axes of the surface 97 x 77 x 115 mm (length, breadth, height), scalp 5 mm, skull 7 mm, liquor 3 mm, brain within (labels 1 to 4).
The table: the gradient is the slope of the pressure of the brain over x, weighted by volume, without particles within two cells of its surface; a rigid
head has rho a. Coup and contrecoup are the pressures of that line at the ends of the brain.
"""
import argparse
import csv
import gzip
import json
import math
import pathlib
import sys
import tomllib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402

AXES = np.array([97.0, 77.0, 115.0])  # mm
LAYERS = {"scalp": 0.0, "skull": 5.0, "liquor": 12.0, "brain": 15.0}  # depth of the outer surface, mm


def image(arguments):
    voxel = arguments.voxel
    count = (2 * np.ceil(AXES / voxel)).astype(int)
    first = [(np.arange(n) - (n - 1) / 2) * voxel for n in count]
    x, y, z = np.meshgrid(*first, indexing="ij")
    labels = np.zeros(count, dtype=np.uint8)
    for number, depth in enumerate(LAYERS.values(), start=1):
        a, b, c = AXES - depth
        labels[(x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 < 1] = number
    header = (f"NRRD0004\n# ellipsoids, studies/head/head.py\ntype: uint8\ndimension: 3\nspace dimension: 3\nspace units: \"mm\" \"mm\" \"mm\"\nsizes: {count[0]} {count[1]} {count[2]}\n"
              f"space directions: ({voxel:g},0,0) (0,{voxel:g},0) (0,0,{voxel:g})\n"
              f"space origin: ({first[0][0]:g},{first[1][0]:g},{first[2][0]:g})\nencoding: gzip\n\n")
    arguments.file.write_bytes(header.encode() + gzip.compress(labels.tobytes(order="F"), mtime=0))
    inner = [4 / 3 * math.pi * np.prod(AXES - depth) for depth in LAYERS.values()] + [0.0]
    print("| part | voxels, cm3 | ellipsoids, cm3 |\n| --- | --- | --- |")
    for number, name in enumerate(LAYERS, start=1):
        print(f"| {name} | {(labels == number).sum() * voxel**3 / 1e3:.1f} | {(inner[number - 1] - inner[number]) / 1e3:.1f} |")


def quantity(value):
    """Value in SI units of a number, or of a text with a unit that a run writes."""
    number, _, unit = str(value).partition(" ")
    return float(number) * {"": 1.0, "m": 1.0, "mm": 1e-3, "s": 1.0, "ms": 1e-3, "us": 1e-6, "N": 1.0}[unit]


def columns(run):
    with open(run / "history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    table = np.array([[float(value) for value in row] for row in rows[1:]])
    return {name.split(" ")[0]: table[:, k] for k, name in enumerate(rows[0])}


def table(arguments):
    print("| cells, mm | mass, kg | momentum/impulse - 1 | peak of the acceleration, m/s2 | force/mass | slope of pressure/(rho a) | coup, kPa | contrecoup, kPa | at, ms |\n"
          + "| --- " * 9 + "|")
    for run in arguments.runs:
        setup = tomllib.loads((run / "run.toml").read_text(encoding="utf-8"))
        of_run = columns(run)
        load = setup["load"][0]
        force = 4 * quantity(load["force"][0])  # a quarter is computed
        times, factors = np.array([quantity(time) for time in load["times"]]), np.array(load["factors"])
        impulse = force * (np.diff(times) * (factors[1:] + factors[:-1]) / 2).sum()
        mass = 4 * of_run["mass"][0]
        series = sorted(run.glob("*.particles.hdf.series"))
        stored = [float(entry["time"]) for entry in json.loads(series[0].read_text())["files"]]
        speed = []
        for time in stored:
            brain = particles_of(run, "brain", time)
            speed.append((brain["mass"] * brain["velocity"][:, 0]).sum() / brain["mass"].sum())
        at = np.interp(stored, times, factors).argmax()
        brain = particles_of(run, "brain", stored[at])
        semi = (AXES - LAYERS["brain"]) * 1e-3
        centre = (brain["volume"] * brain["x"]).sum() / brain["volume"].sum()
        cell = quantity(setup["domain"]["cell_size"])
        place = brain["position"] - [centre, 0, 0]
        inside = ((place / (semi - 2 * cell)) ** 2).sum(axis=1) < 1
        weight, x, p = brain["volume"][inside], place[inside, 0], brain["pressure"][inside]
        mean_x, mean_p = (weight * x).sum() / weight.sum(), (weight * p).sum() / weight.sum()
        slope = (weight * (x - mean_x) * (p - mean_p)).sum() / (weight * (x - mean_x) ** 2).sum()
        density = brain["mass"].sum() / brain["volume"].sum()
        own = (speed[at + 1] - speed[at - 1]) / (stored[at + 1] - stored[at - 1])
        coup, contrecoup = (mean_p + slope * (sign * semi[0] - mean_x) for sign in (1, -1))
        print(f"| {cell * 1e3:g} | {mass:.3f} | {4 * of_run['momentum_x'][-1] / impulse - 1:+.1e} | {np.abs(own):.0f} | {abs(force) / mass:.0f} "
              f"| {slope / (-density * own):.3f} | {coup / 1e3:+.0f} | {contrecoup / 1e3:+.0f} | {stored[at] * 1e3:.2f} |")


def picture(arguments):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (section, line) = plt.subplots(1, 2, figsize=(10, 4.2))
    for name in ("scalp", "skull", "forehead", "liquor", "brain"):
        body = particles_of(arguments.run, name, 3.5e-3)
        near = body["position"][:, 1] < 4e-3
        places = 1e3 * body["position"][near]
        drawn = section.scatter(places[:, 0], places[:, 2], c=body["pressure"][near] / 1e3, s=5, cmap="coolwarm", vmin=-250, vmax=250)
    section.set(aspect="equal", xlabel="x, mm", ylabel="z, mm", title="pressure at 3.5 ms, kPa (upper half)")
    figure.colorbar(drawn, ax=section)
    brain = particles_of(arguments.run, "brain", 3.5e-3)
    x, pressure = 1e3 * brain["x"], brain["pressure"] / 1e3
    slabs = np.arange(x.min(), x.max(), 4)
    of_slab = np.digitize(x, slabs)
    mean = [np.average(pressure[of_slab == k], weights=brain["volume"][of_slab == k]) for k in range(1, len(slabs))]
    line.plot(x, pressure, ",", color="#999")
    line.plot(slabs[:-1] + 2, mean, "k-", label="mean over slabs of 4 mm")
    line.set(ylim=(-400, 400), xlabel="x, mm", ylabel="pressure of the brain, kPa")
    line.legend()
    figure.tight_layout()
    figure.savefig(arguments.file, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    write = commands.add_parser("image")
    write.add_argument("--voxel", type=float, default=2.0)
    write.add_argument("file", type=pathlib.Path, nargs="?", default=ROOT / "cases/head_impact/head.nrrd")
    write.set_defaults(call=image)
    draw = commands.add_parser("picture")
    draw.add_argument("run", type=pathlib.Path)
    draw.add_argument("file", type=pathlib.Path, nargs="?", default=ROOT / "docs/images/head_impact.png")
    draw.set_defaults(call=picture)
    show = commands.add_parser("table")
    show.add_argument("runs", type=pathlib.Path, nargs="+")
    show.set_defaults(call=table)
    arguments = parser.parse_args()
    arguments.call(arguments)


if __name__ == "__main__":
    main()
