#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the pieces of a debris cloud have a size of their own, or that of the cells?

usage: debris_grains.py [--cells 0.2 0.1 0.05] [--dimension axisymmetric|3d] [--size 0.48] [--end 3] [--folder run/studies/debris_grains]
                        [--table] [--threads N] [--whipple EXE]

A sphere of 2017-T4 of 3.175 mm strikes a sheet of 6061-T6 of 0.787 mm at 6.7 km/s (the first half of Ryan's shield); of the
sphere, `--end` us later: failed and loose fractions, fragments (docs/theory/analysis.md, section 3), the fraction of the sphere in the
largest one, and sizes: cube root of the volume, in sections square root of the area, sum of m/(rho 2 pi r) over the particles. Of
the largest fragment; of all, the median by number; of all but the largest, that at half of their mass. Without grains, with
`failure_grains`, and with fields at cracks as well. In sections also where the largest fragment was at the start. Runs of the same
program and the same case are kept; --table runs nothing.
"""
import argparse
import csv
import dataclasses
import itertools
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402
from studies.commands import compute  # noqa: E402

DENSITY = 2780.0  # kg/m^3
RADIUS = 1.5875  # mm


def case_of(space, cell, keys, end):
    """Text of the case. space: three dimensions, a quarter; else a section. end: us."""
    side = cell * round(max(8, 2.5 * end) / cell)
    lower, upper = -cell * round(max(6, 2.5 * end) / cell), cell * round((5 + 7 * end) / cell)
    vector = (lambda x, *rest: "[" + ", ".join(f'"{value:.12g} {{unit}}"' for value in (x, *rest)) + "]")
    mm = (lambda x, r: vector(x, *([r] * (2 if space else 1))).format(unit="mm"))
    at_rest = ', "0 m/s"' * (2 if space else 1)
    return f"""title = "debris of a sphere"
[domain]
dimension = "{'3d' if space else 'axisymmetric'}"
lower = {mm(lower, 0)}
upper = {mm(upper, side)}
cell_size = "{cell} mm"
{'boundary = { y_lower = "symmetry", z_lower = "symmetry" }' if space else ''}
[time]
end = "{end:g} us"
[[body]]
name = "sphere"
material = "aluminium_2017_t4_mie_gruneisen.toml"
velocity = ["6.7 km/s"{at_rest}]
shape = {{ sphere = {{ center = {mm(-RADIUS, 0)}, radius = "{RADIUS} mm" }} }}
{keys}
[[body]]
name = "sheet"
material = "aluminium_6061_t6.toml"
shape = {{ box = {{ lower = {mm(0, -7 if space else 0)}, upper = {mm(0.787, 7)} }} }}
{keys}
[output]
snapshot_every = "1 us"
"""


def pairs_within(points, others, reach):
    """Pairs (i, j) of a point and one of others that are closer than the reach."""
    by_cell = {}
    for j, cell in enumerate(map(tuple, np.floor(others / reach).astype(int))):
        by_cell.setdefault(cell, []).append(j)
    shifts = list(itertools.product((-1, 0, 1), repeat=points.shape[1]))
    for i, cell in enumerate(np.floor(points / reach).astype(int)):
        near = [j for shift in shifts for j in by_cell.get(tuple(cell + shift), ())]
        distance = np.linalg.norm(others[near] - points[i], axis=1) if near else []
        yield from ((i, j, d) for j, d in zip(near, distance) if d < reach)


def fragments_of(points, failed, link, least=4):
    """Members of each fragment, as docs/theory/analysis.md, section 3, defines them (without mirror planes)."""
    intact, broken = np.flatnonzero(~failed), np.flatnonzero(failed)
    root = list(range(len(intact)))

    def find(i):
        while root[i] != i:
            root[i] = i = root[root[i]]
        return i

    for i, j, _ in pairs_within(points[intact], points[intact], link):
        root[find(i)] = find(j)
    members = {}
    for i, particle in enumerate(intact):
        members.setdefault(find(i), []).append(particle)
    kept = {piece: list(own) for piece, own in members.items() if len(own) >= least}
    nearest = {}
    for i, j, distance in pairs_within(points[broken], points[intact], link):
        nearest[i] = min(nearest.get(i, (np.inf, 0)), (distance, j))
    for i, (_, j) in nearest.items():
        if find(j) in kept:
            kept[find(j)].append(broken[i])
    return list(kept.values())


@dataclasses.dataclass(frozen=True)
class Pieces:
    """Fragments of the sphere: masses (kg), sizes (mm), and how often the full problem has each."""
    mass: np.ndarray
    size: np.ndarray
    copies: np.ndarray
    origin: str  # of the largest

    def at_half(self, weight, without_largest=False):
        """Size at half of a weight; NaN without fragments."""
        chosen = np.argsort(self.mass, kind="stable")[:len(self.mass) - without_largest]
        if not len(chosen):
            return np.nan
        order = chosen[np.argsort(self.size[chosen], kind="stable")]
        reached = np.cumsum(weight[order])
        return self.size[order][np.searchsorted(reached, 0.5 * reached[-1])]


def pieces_of_section(run, cell):
    """Fragments of a section, from its particles."""
    found, start = particles_of(run, "sphere"), particles_of(run, "sphere", 0.0)
    points = found["position"][:, :2].astype(float)
    condensed = np.flatnonzero(found["phase"] != 3)
    members = [condensed[own] for own in
               fragments_of(points[condensed], found["failed"][condensed] > 0, 1.5e-3 * cell)]
    area = found["mass"] / DENSITY / (2 * np.pi * np.maximum(points[:, 1], 0.25e-3 * cell))
    mass = np.array([found["mass"][own].sum() for own in members])
    origin = ""
    if members:
        x = 1e3 * start["x"][np.isin(start["id"], found["id"][members[int(np.argmax(mass))]])]
        origin = f"{x.min():.2f} to {x.max():.2f} mm"
    return Pieces(mass, 1e3 * np.sqrt([area[own].sum() for own in members]), np.ones(len(members)), origin)


def pieces_in_space(run):
    """Fragments of three dimensions, from the table of the analysis."""
    with (run / "report/fragments.csv").open(newline="") as stream:
        rows = [{key.split(" [")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
    own = [row for row in rows if row["body"] == 0]
    mass = np.array([row["mass"] for row in own])
    return Pieces(mass, 1e3 * np.cbrt(mass / DENSITY), np.array([row["copies"] for row in own]), "")


HEADINGS = ("cells, mm", "failure", "failed, %", "loose, %", "fragments", "largest, %", "its size, mm", "median by number, mm",
            "others at half of their mass, mm")


def line(run, name, cell, space):
    """Row of the table, and where the largest fragment was at the start."""
    with (run / "report/quantities.csv").open(newline="") as stream:
        single = {row["quantity"]: float(row["value"]) for row in csv.DictReader(stream)}
    with (run / "report/bodies.csv").open(newline="") as stream:
        whole = next(row for row in csv.DictReader(stream) if row["body part"] == "sphere whole")
    pieces = pieces_in_space(run) if space else pieces_of_section(run, cell)
    number, total = single["piece_count.sphere"], float(whole["mass [kg]"])
    if number != pieces.copies.sum():
        sys.exit(f"{run}: {pieces.copies.sum():g} fragments, the analysis found {number:g}")
    largest = max(pieces.mass, default=0.0)
    sizes = (max(pieces.size[pieces.mass == largest], default=np.nan), pieces.at_half(pieces.copies),
             pieces.at_half(pieces.copies * pieces.mass, without_largest=True))
    return (f"| {cell:g} | {name} | {100 * float(whole['failed_fraction [1]']):.1f} | {100 * single['loose_fraction.sphere']:.1f} | "
            f"{number:g} | {100 * largest / total:.1f} | {' | '.join(f'{size:.2f}' for size in sizes)} |"), pieces.origin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=float, nargs="+", default=[0.2, 0.1, 0.05], help="mm")
    parser.add_argument("--dimension", choices=["axisymmetric", "3d"], default="axisymmetric")
    parser.add_argument("--size", type=float, default=0.48, help="of the grains, mm")
    parser.add_argument("--end", type=float, default=3.0, help="us")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/debris_grains")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    space = arguments.dimension == "3d"
    grains = f'failure_grains = {{ size = "{arguments.size} mm", seed = 1 }}'
    variants = {"none": "", "grains": grains, "grains, cracks": grains + '\nfailure = { cracks = "fields" }'}
    print(f"| {' | '.join(HEADINGS)} |\n{'| --- ' * len(HEADINGS)}|")
    origins = []
    for cell in arguments.cells:
        for name, keys in variants.items():
            run = folder / f"{arguments.dimension}_{name.replace(', ', '_')}_{arguments.size}_{cell:g}_{arguments.end:g}"
            if not arguments.table:
                case = folder / f"{run.name}.toml"
                case.write_text(case_of(space, cell, keys, arguments.end), encoding="utf-8")
                compute(arguments.whipple, run, [["run", case, "--output", run, "--force", "--quiet", "--threads", arguments.threads],
                                                 ["analyse", run]], [case])
            if (run / "report/fragments.csv").is_file():
                row, origin = line(run, name, cell, space)
                origins += [f"{cell:g} mm, {name}: x of the largest fragment at the start {origin}"] if origin else []
                print(row, flush=True)
    print("\n".join(origins))


if __name__ == "__main__":
    main()
