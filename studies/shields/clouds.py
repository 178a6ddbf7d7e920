#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What do debris clouds look like whose radiographs are published, and from which speed on do they melt?

Usage: python3 -m studies.shields.clouds [piekutowski|melting] [--draw FILE.png] [--work FOLDER] [--whipple PROGRAM]

piekutowski  Spheres of 9.53 mm at 6.7 km/s on bumpers of 0.026 to 0.424 of the diameter (NASA CR-4707; cases/piekutowski_clouds):
             sections in cells of 0.4 and 0.2 mm, on the grid and half a cell off it, and of 0.1 mm; half of that for the thinnest bumper.
melting      The sphere and the bumper of Ryan's shield (3.175 and 0.787 mm) at 4 to 8 km/s in cells of 0.2 and 0.14 mm.

Sphere and bumper have phases (GRAY: 2024-T4 for 2017-T4, 6061-T6), and points that fail keep the size of the fragments that they become part of
(docs/theory/cracks.md, eq. 8). Adds a row for each run to clouds.csv, after the time in which the speed covers seven diameters: front, rear and
radial speed over that of the impact, length over width, intact and melted mass, quantiles of the sizes by mass over the diameter. Runs with a row
are not computed again. --draw FILE.png draws radiographs of three clouds of the first study at the end of their runs, each in the finest cells.
"""
import argparse
import itertools
import json
import pathlib

from matplotlib.figure import Figure

from report import style
from report.files import open_hdf5
from report.particles import particles_of
from studies import commands
from studies.shields import page, run_shots, tile
from studies.grains_on_wall.grains_on_wall import quantile

FILE = page.HERE / "clouds.csv"
SPHERE, BUMPER = "aluminium_2024_t4.toml", "aluminium_6061_t6.toml"
FLIGHT = 7  # diameters
DRAWN = (0.467, 0.8, 1.549)  # mm, bumpers
QUANTILES = (0.5, 0.84, 0.975)
MEASURES = {"front": "front_speed_over_impact_speed", "rear": "rear_speed", "radial": "radial_speed_over_impact_speed",
            "length over width": "cloud_length_over_width", "sphere melted": "melted_fraction.sphere", "debris melted": "debris_melted_fraction"}


def plans(study):
    """Diameter (mm), thickness (mm), speed (km/s), cell (mm) and shift of the grid in cells of the runs of a study."""
    if study == "melting":
        return [(3.175, 0.787, speed, cell, 0.0) for speed, cell in itertools.product((4, 4.5, 5, 5.5, 6, 6.35, 6.7, 7, 7.5, 8), (0.2, 0.14))]
    sheets = dict.fromkeys((0.467, 0.8, 1.549, 2.22, 4.041), (0.4, 0.2, 0.1)) | {0.248: (0.2, 0.1, 0.05)}
    return [(9.53, thickness, 6.7, cell, shift) for thickness, cells in sheets.items() for cell in cells
            for shift in ((0.0, 0.5) if cell > cells[-1] else (0.0,))]


def case_of(diameter, thickness, speed, cell, shift, folder):
    """Text of a section: mm, km/s; shift of the grid in cells, against the flight."""
    end = FLIGHT * diameter / speed
    lower = -cell * (round(3 * diameter / cell) + shift)
    upper = lower + cell * round((3 + 1.15 * FLIGHT) * diameter / cell)
    across = cell * round(0.55 * FLIGHT * diameter / cell)
    return f"""title = "cloud of a sphere of {diameter:g} mm behind {thickness:g} mm at {speed:g} km/s"
[domain]
dimension = "axisymmetric"
lower = ["{lower:.9g} mm", "0 mm"]
upper = ["{upper:.9g} mm", "{across:.9g} mm"]
cell_size = "{cell:g} mm"
[time]
end = "{end:.6g} us"
[[body]]
name = "sphere"
material = "{tile.keeping_sizes(folder, SPHERE)}"
velocity = ["{speed:g} km/s", "0 m/s"]
shape = {{ sphere = {{ center = ["{-diameter / 2:.9g} mm", "0 mm"], radius = "{diameter / 2:.9g} mm" }} }}
[[body]]
name = "bumper"
material = "{tile.keeping_sizes(folder, BUMPER)}"
shape = {{ box = {{ lower = ["0 mm", "0 mm"], upper = ["{thickness:.9g} mm", "{2.5 * diameter:.9g} mm"] }} }}
[output]
snapshot_every = "{end / 20:.6g} us"
fields = ["density", "phase", "melted_fraction", "failed", "plastic_strain", "fragment_size"]
"""


def measured(whipple, plan, work):
    """Row of a run."""
    diameter, thickness, speed, cell, shift = plan
    folder = work / "_".join(f"{value:g}" for value in plan)
    folder.mkdir(parents=True, exist_ok=True)
    tile.run(whipple, 1, case_of(*plan, folder.parent), folder)
    found = json.loads(commands.call([whipple, "analyse", folder, "--json", "--quiet"]).stdout)
    row = {"diameter [mm]": f"{diameter:g}", "bumper [mm]": f"{thickness:g}", "velocity [km/s]": f"{speed:g}", "cell size [mm]": f"{cell:g}", "shift": f"{shift:g}"}
    for column, name in MEASURES.items():
        value = found[name]["value"]
        row[column] = "" if value is None else f"{value / (1e3 * speed if name == 'rear_speed' else 1):.4g}"
    sphere = particles_of(folder, "sphere")
    total, size = sphere["mass"].sum(), 1e3 * sphere["fragment_size"]
    sized = size > 0
    row["sphere intact"] = f"{sphere['mass'][(sphere['failed'] == 0) & (sphere['phase'] < 2)].sum() / total:.3g}"
    row["sphere with a size"] = f"{sphere['mass'][sized].sum() / total:.3g}"
    for part in QUANTILES:
        row[f"size at {100 * part:g} %"] = f"{quantile(size[sized], sphere['mass'][sized], part) / diameter:.3g}" if sized.any() else ""
    status = run_shots.status_of(folder)
    row |= {"steps": status["step"], "seconds": f"{status['wall_time']:.3g}", "revision": status["revision"]}
    for file in sorted(folder.glob("*.particles.*.hdf"))[:-1]:
        file.unlink()
    return row


def draw(file, work):
    """Draws the clouds of the series: areal density along a diameter, of the last snapshot, flight to the right."""
    style.apply()
    finest = {}
    for plan in plans("piekutowski"):
        if plan[1] in DRAWN and plan[4] == 0 and plan[3] <= finest.get(plan[1], plan)[3]:
            finest[plan[1]] = plan
    figure = Figure(figsize=(style.WIDTH, 0.28 * style.WIDTH), layout="constrained")
    for axes, plan in zip(figure.subplots(1, len(finest)), finest.values()):
        with open_hdf5(work / "_".join(f"{value:g}" for value in plan) / "report" / "analysis.h5") as data:
            own = data["radiographs"][max(data["radiographs"])]
            density = own["areal_density.sphere"][()] + own["areal_density.bumper"][()]
            pixel, x, y = 1e3 * data["radiographs"].attrs["pixel"], 1e3 * own.attrs["lower_axial"], 1e3 * own.attrs["lower_up"]
            extent = (x, x + pixel * density.shape[1], y, y + pixel * density.shape[0])
        image = axes.imshow(0.1 * density, origin="lower", extent=extent, cmap="gray_r", norm="log", vmin=1e-3, vmax=1)
        axes.set_title(f"t/D = {plan[1] / plan[0]:.3f}, cells {plan[3]:g} mm")
        axes.set_xlabel("mm")
        axes.set_ylim(-35, 35)
    figure.colorbar(image, ax=figure.axes, label="areal density (g/cm$^2$)")
    figure.savefig(file, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study", nargs="?", choices=("piekutowski", "melting"))
    parser.add_argument("--draw", type=pathlib.Path)
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "clouds")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    if arguments.draw:
        draw(arguments.draw, arguments.work)
        return
    keys = ("diameter [mm]", "bumper [mm]", "velocity [km/s]", "cell size [mm]", "shift")
    for study in [arguments.study] if arguments.study else ["piekutowski", "melting"]:
        for plan in plans(study):
            done = {tuple(float(row[key]) for key in keys) for row in page.read_csv(FILE)}
            if plan in done:
                continue
            row = measured(arguments.whipple, plan, arguments.work)
            run_shots.append(FILE, row, list(row))
            print(", ".join(f"{key} {value}" for key, value in row.items() if key != "revision"), flush=True)


if __name__ == "__main__":
    main()
