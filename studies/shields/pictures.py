#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What do walls look like that hold in the run and failed in the experiment?

Usage: python3 -m studies.shields.pictures [--work FOLDER] [--whipple PROGRAM] [--output FOLDER]

Computes the unsafe misses of sections (outcomes.csv) again, with their snapshots, and draws them as thumbnails, twelve to a sheet
(docs/images/shield_misses_N.png): the half section of the wall at the outcome, intact (by plastic strain), failed, and the debris before it.
Stops where a verdict is not the one of outcomes.csv: the picture would be of another run. Runs that have ended are not computed again.
Those of oblique halves, whose runs studies.shields.oblique has left, are drawn likewise behind their mirror plane
(docs/images/shield_misses_oblique.png).
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
HALF_VIEW = 10  # thicknesses of the wall to either side of the line of flight, of a half


def misses(rows, shots, calibrating, model="section"):
    """Rows of a model that held though the wall failed, of scored shots. shots: rows of shots.csv by name."""
    return [row for row in rows if row["model"] == model and row["shot"] not in calibrating and row["outcome"] not in page.DEFEATS
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


def oblique_run(row, work):
    """Folder of the run of a half. @throws SystemExit where there is none"""
    found = sorted(work.glob(row["shot"].replace("/", "_") + "_*/run"))
    if len(found) != 1:
        sys.exit(f"{row['shot']}: {len(found)} runs in {work}; python3 -m studies.shields.oblique computes it")
    return found[0]


def seen(particles, model, cell, front):
    """Place across the flight and behind the wall's front face (mm) of the particles that are drawn, and which these are: all of a
    section, those of a half in the first cell behind the mirror plane (y = 0)."""
    place = 1e3 * particles["position"]
    if model == "section":
        return place[:, 1], front - place[:, 0], np.full(len(place), True)
    drawn = place[:, 1] < cell
    return place[drawn, 0], front - place[drawn, 2], drawn


def draw(axes, run, row, shot):
    """Wall of a run at its end: against the flight upwards, radius (of a half, along its plane) to the right; mm."""
    model = row["model"]
    cell = 1e3 * commands.cell_size(run) if (run / "run.toml").is_file() else float(row["cell size [mm]"])
    wall = particles_of(run, "wall")
    thickness, front = float(shot["wall thickness [mm]"]), float(shot["bumper thickness [mm]"]) + float(shot["spacing [mm]"])
    across, depth, drawn = seen(wall, model, cell, front)
    reach = min(np.abs(across).max(), 8 * thickness + 12)
    struck = front * math.tan(math.radians(float(shot["angle [degree]"])))  # where the line of flight meets the wall
    left, right = (0, reach) if model == "section" else (struck - HALF_VIEW * thickness, struck + HALF_VIEW * thickness)
    size = (72 * axes.get_figure().get_figwidth() / COLUMNS * 0.8 * 0.5 * cell / (right - left))**2
    size *= 1 if model == "section" else (COLUMNS / 2)**2
    for body in ("sphere", "bumper"):
        own = particles_of(run, body)
        if own is not None:
            debris_across, debris_depth, _ = seen(own, model, cell, front)
            axes.scatter(debris_across, debris_depth, s=0.5 * size, c="#bbbbbb", linewidths=0, rasterized=True)
    failed, strain = wall["failed"][drawn] > 0, wall[FIELD][drawn]
    axes.scatter(across[~failed], depth[~failed], s=size, c=strain[~failed], vmin=0, vmax=MOST, cmap="viridis", linewidths=0, rasterized=True)
    axes.scatter(across[failed], depth[failed], s=size, c="#d55e00", linewidths=0, rasterized=True)
    axes.set_xlim(left, right)
    axes.set_ylim(-2.2 * thickness - 6, 1.5 * thickness)
    axes.set_aspect("equal", adjustable="datalim")
    angle = "" if model == "section" else f", {float(shot['angle [degree]']):g} degrees"
    axes.set_title(f"{row['shot']}: {row['outcome']}\n{float(shot['velocity [km/s]']):g} km/s{angle}, {float(shot['diameter [mm]']):g} mm on "
                   f"{float(shot['bumper thickness [mm]']):g} + {thickness:g} mm", fontsize=5.5)
    axes.tick_params(labelsize=5, width=0.4, length=2)


def sheet(rows, runs, shots, shape, file):
    """Writes a sheet of thumbnails. rows: misses; runs: their folders; shape: of the sheet, rows and columns."""
    figure = Figure(figsize=(style.WIDTH, 0.3 * shape[0] * style.WIDTH), layout="constrained")
    panels = figure.subplots(*shape).ravel()
    for axes, row, run in zip(panels, rows, runs):
        draw(axes, run, row, shots[row["shot"]])
    for axes in panels[len(rows):]:
        axes.set_axis_off()
    figure.savefig(file, dpi=130)
    print(f"wrote {file}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "misses")
    parser.add_argument("--oblique", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "oblique", help="runs of the halves")
    parser.add_argument("--only", choices=("section", "space"), help="model whose misses are drawn; default: both")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    parser.add_argument("--output", type=pathlib.Path, default=commands.ROOT / "docs" / "images")
    arguments = parser.parse_args()
    shots, calibrating = shots_by_name(), {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    rows = page.read_csv(page.HERE / "outcomes.csv")
    style.apply()
    if arguments.only != "space":
        found = sorted(misses(rows, shots, calibrating), key=lambda row: row["shot"])
        for number in range(math.ceil(len(found) / (ROWS * COLUMNS))):
            own = found[number * ROWS * COLUMNS:(number + 1) * ROWS * COLUMNS]
            runs = [computed(arguments.whipple, row, arguments.work) for row in own]
            sheet(own, runs, shots, (ROWS, COLUMNS), arguments.output / f"shield_misses_{number + 1}.png")
    if arguments.only != "section":
        oblique = [row for row in misses(rows, shots, calibrating, "space") if float(shots[row["shot"]]["angle [degree]"]) > 0]
        oblique.sort(key=lambda row: row["shot"])
        sheet(oblique, [oblique_run(row, arguments.oblique) for row in oblique], shots, (math.ceil(len(oblique) / 2), 2),
              arguments.output / "shield_misses_oblique.png")


if __name__ == "__main__":
    main()
