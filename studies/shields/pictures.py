#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What do walls look like that hold in the run and failed in the experiment?

Usage: python3 -m studies.shields.pictures [--work FOLDER] [--whipple PROGRAM] [--output FOLDER]

Computes the unsafe misses of sections (outcomes.csv) again, with their snapshots, and draws them as thumbnails, twelve to a sheet
(docs/images/shield_misses_N.png): the half section of the wall at the outcome, intact (by plastic strain), failed, and the debris before it.
Stops where a verdict is not the one of outcomes.csv: the picture would be of another run. Runs that have ended are not computed again.
"""
import argparse
import math
import pathlib
import sys

import numpy as np
from matplotlib.figure import Figure

from report import style
from report.particles import particles_of
from studies import commands
from studies.shields import page, run_shots

ROWS, COLUMNS = 4, 3
FIELD = "plastic_strain"
MOST = 0.5  # plastic strain at the end of the scale
VIEW = 1.1  # of the largest radius that is drawn: 10 thicknesses of the wall, or the wall


def misses(rows, shots, calibrating):
    """Rows of sections that held though the wall failed, of scored shots. shots: rows of shots.csv by name."""
    return [row for row in rows if row["model"] == "section" and row["shot"] not in calibrating and row["outcome"] not in page.DEFEATS
            and row["outcome"] != "undecided" and shots[row["shot"]]["result"] == "P"]


def shots_by_name():
    """Rows of shots.csv by source and shot."""
    return {f"{row['source']}/{row['shot']}": row for row in page.read_csv(page.HERE / "shots.csv")}


def computed(whipple, row, work):
    """Folder of the run of a miss. @throws SystemExit where its verdict is another one"""
    folder = run_shots.folder_of(whipple, ["--model", "section"], row["shot"], work)
    run = folder / "run"
    if not (run / "status.json").is_file() or run_shots.status_of(run)["state"] != "done" or not any(run.glob("*.particles.*.hdf")):
        verdict = run_shots.judged(whipple, 1, folder)
        if verdict["outcome"] != row["outcome"]:
            sys.exit(f"{row['shot']}: {verdict['outcome']}, outcomes.csv has {row['outcome']}")
        files = sorted(run.glob("*.particles.*.hdf"))
        for file in files[1:-1]:
            file.unlink()
    return run


def draw(axes, run, row, shot):
    """Half section of the wall of a run at its end: along the flight upwards, radius to the right; mm."""
    cell = 1e3 * commands.cell_size(run) if (run / "run.toml").is_file() else float(row["cell size [mm]"])
    wall = particles_of(run, "wall")
    thickness, front = float(shot["wall thickness [mm]"]), float(shot["bumper thickness [mm]"]) + float(shot["spacing [mm]"])
    reach = min(1e3 * np.abs(wall["position"][:, 1]).max(), 8 * thickness + 12)
    size = (72 * axes.get_figure().get_figwidth() / COLUMNS * 0.8 * 0.5 * cell / reach)**2
    for body in ("sphere", "bumper"):
        own = particles_of(run, body)
        if own is not None:
            axes.scatter(1e3 * own["position"][:, 1], front - 1e3 * own["position"][:, 0], s=0.5 * size, c="#bbbbbb", linewidths=0, rasterized=True)
    radius, depth, failed = 1e3 * wall["position"][:, 1], front - 1e3 * wall["position"][:, 0], wall["failed"] > 0
    axes.scatter(radius[~failed], depth[~failed], s=size, c=wall[FIELD][~failed], vmin=0, vmax=MOST, cmap="viridis", linewidths=0, rasterized=True)
    axes.scatter(radius[failed], depth[failed], s=size, c="#d55e00", linewidths=0, rasterized=True)
    axes.set_xlim(0, reach)
    axes.set_ylim(-2.2 * thickness - 6, 1.5 * thickness)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_title(f"{row['shot']}: {row['outcome']}\n{float(shot['velocity [km/s]']):g} km/s, {float(shot['diameter [mm]']):g} mm on "
                   f"{float(shot['bumper thickness [mm]']):g} + {thickness:g} mm", fontsize=5.5)
    axes.tick_params(labelsize=5, width=0.4, length=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "misses")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    parser.add_argument("--output", type=pathlib.Path, default=commands.ROOT / "docs" / "images")
    arguments = parser.parse_args()
    shots, calibrating = shots_by_name(), {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    found = sorted(misses(page.read_csv(page.HERE / "outcomes.csv"), shots, calibrating), key=lambda row: row["shot"])
    style.apply()
    for sheet in range(math.ceil(len(found) / (ROWS * COLUMNS))):
        figure = Figure(figsize=(style.WIDTH, 1.2 * style.WIDTH), layout="constrained")
        panels = figure.subplots(ROWS, COLUMNS).ravel()
        own = found[sheet * len(panels):(sheet + 1) * len(panels)]
        for axes, row in zip(panels, own):
            draw(axes, computed(arguments.whipple, row, arguments.work), row, shots[row["shot"]])
        for axes in panels[len(own):]:
            axes.set_axis_off()
        file = arguments.output / f"shield_misses_{sheet + 1}.png"
        figure.savefig(file, dpi=130)
        print(f"wrote {file}", flush=True)


if __name__ == "__main__":
    main()
