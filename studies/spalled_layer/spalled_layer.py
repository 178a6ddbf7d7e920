#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does a spalled layer leave with the same mass and speed at every cell size, and what decides it?

usage: spalled_layer.py [--problem NAME]... [--table] [--folder run/studies/spalled_layer] [--threads N] [--whipple EXE]

6061-T6 throughout (aluminium_6061_t6, whose voids meet at a porosity of 0.15), times until nothing changes (6 to 8 us):

  plate_1.6, plate_0.8  a plate of that many mm at 500 m/s on a wall of 4 mm, in plane strain, two rows of cells
  grain                 the unit cell of a dense load of grains: a sphere of 1 mm of 2017-T4 at 5.7 km/s on the axis of a wall of
                        4.064 mm whose side is a mirror of the radius 2.2141 mm (0.095 mg of grains per mm^2)

with one velocity field or with those of cracks, and with other porosities of coalescence. The layer is the rearmost fragment of
at least a twentieth of the wall (docs/theory/analysis.md, section 3); "whole": the wall has one such fragment, with 95 % of its
mass and more. Runs of the same program and the same case are kept; --table runs nothing.
"""
import argparse
import csv
import pathlib
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import compute  # noqa: E402

CASE = """title = "spalled layer"
[domain]
dimension = "{dimension}"
lower = ["-2 mm", "0 mm"]
upper = ["{end:.12g} mm", "{radius:.12g} mm"]
cell_size = "{cell:.12g} mm"
boundary = {{ y_upper = "symmetry"{below} }}
[time]
end = "{time} us"
[[body]]
name = "flyer"
material = "{flyer}"
velocity = ["{speed} m/s", "0 m/s"]
shape = {shape}
[[body]]
name = "wall"
material = "{wall}"
shape = {{ box = {{ lower = ["0 mm", "0 mm"], upper = ["{thickness} mm", "{radius:.12g} mm"] }} }}
failure = {{ cracks = "{cracks}" }}
[output]
snapshot_every = "0.5 us"
"""
RADIUS = 2.2141  # mm, of the unit cell


def plate(thickness, cell):
    return dict(dimension="plane_strain", radius=2 * cell, cell=cell, below=', y_lower = "symmetry"', time=6, flyer="aluminium_6061_t6",
                speed=500, thickness=4,
                shape=f'{{ box = {{ lower = ["-{thickness} mm", "0 mm"], upper = ["0 mm", "{2 * cell} mm"] }} }}')


def grain(cells):
    return dict(dimension="axisymmetric", radius=RADIUS, cell=RADIUS / cells, below="", time=8, thickness=4.064, speed=5700,
                flyer="aluminium_2017_t4_mie_gruneisen",
                shape='{ sphere = { center = ["-0.52 mm", "0 mm"], radius = "0.5 mm" } }')


PROBLEMS = {"plate_1.6": [plate(1.6, cell) for cell in (0.2, 0.1, 0.05, 0.025)],
            "plate_0.8": [plate(0.8, cell) for cell in (0.2, 0.1, 0.05, 0.025)],
            "grain": [grain(cells) for cells in (11, 22, 44)]}
LABELS = {"none": "one", "fields": "cracks"}
VARIANTS = [("none", 0.15), ("fields", 0.15), ("fields", 0.05), ("fields", 0.1), ("fields", 0.29)]


def wall_of(folder, porosity):
    """Name of the wall's material; one with another porosity of coalescence is written."""
    if porosity == 0.15:
        return "aluminium_6061_t6.toml"
    text = (ROOT / "eos/materials/aluminium_6061_t6.toml").read_text(encoding="utf-8")
    path = folder / f"wall_{porosity}.toml"
    path.write_text(text.replace("\nnuclei = 3e-4", f"\nnuclei = 3e-4\nfailure_porosity = {porosity}"), encoding="utf-8")
    return path.name


def layer_of(run):
    """Fraction of the wall's mass (%) and speed (m/s) of the rearmost fragment, and whether the wall is whole."""
    bodies = [body["name"] for body in tomllib.loads((run / "run.toml").read_text(encoding="utf-8"))["body"]]
    with (run / "report/fragments.csv").open(newline="") as stream:
        rows = [{key.split(" [")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
    with (run / "report/bodies.csv").open(newline="") as stream:
        mass = next(float(row["mass [kg]"]) for row in csv.DictReader(stream) if row["body part"] == "wall whole")
    pieces = [row for row in rows if row["body"] == bodies.index("wall") and row["mass"] > 0.05 * mass]
    rear = max(pieces, key=lambda row: row["x"])
    return 100.0 * rear["mass"] / mass, rear["velocity_x"], len(pieces) == 1 and rear["mass"] > 0.95 * mass


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problem", action="append", choices=PROBLEMS)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/spalled_layer")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for problem in arguments.problem or PROBLEMS:
        print(f"\n{problem}: mass of the layer, % of the wall, and its speed, m/s\n")
        cells = [f"{parameters['cell']:.3g} mm" for parameters in PROBLEMS[problem]]
        print(f"| fields | porosity | {' | '.join(cells)} |\n{'| --- ' * (2 + len(cells))}|")
        for cracks, porosity in VARIANTS:
            found = []
            for parameters in PROBLEMS[problem]:
                cell = parameters["cell"]
                end = -2 + cell * round(16 / cell)
                run = folder / f"{problem}_{cracks}_{porosity}_{cell:.3g}"
                if not arguments.table:
                    case, wall = folder / f"{run.name}.toml", wall_of(folder, porosity)
                    case.write_text(CASE.format(end=end, cracks=cracks, wall=wall, **parameters), encoding="utf-8")
                    compute(arguments.whipple, run, [["run", case, "--output", run, "--force", "--quiet", "--threads", arguments.threads],
                                                     ["analyse", run]],
                            [case, *(file for file in [folder / wall] if file.is_file())])
                if not (run / "report/fragments.csv").is_file():
                    found.append("not computed")
                    continue
                mass, speed, whole = layer_of(run)
                found.append("whole" if whole else f"{mass:.1f}, {speed:.0f}")
            print(f"| {LABELS[cracks]} | {porosity} | {' | '.join(found)} |", flush=True)


if __name__ == "__main__":
    main()
