#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do runs in three dimensions tell which oblique shots failed?

Usage: python3 -m studies.shields.oblique [--choose] [--most COUNT] [--work FOLDER] [--whipple PROGRAM]

Oblique shots as halves behind one mirror plane, with 8 cells across the sphere (two and a little more through the bumper). Chosen before
any of them was computed, by a rule that knows no outcome: those within a third of the limit of NNO (1993) whose sheets all have two cells
so, with at most 700,000 particles in the half (its cost), in the order of the SHA-256 of their names. --choose writes them to
oblique_shots.csv, which is what is computed; --most ends after so many, in the order of the file.

Adds a row for each to outcomes.csv (model space). Runs with a row are not computed again; an interrupted one is resumed from its
checkpoint.
"""
import argparse
import csv
import pathlib

from studies import commands
from studies.shields import page, run_shots
from studies.shields.three_dimensions import SETTINGS, options, order

CHOSEN = page.HERE / "oblique_shots.csv"
MOST = 700_000     # particles of a half


def write_chosen(whipple):
    """Writes the shots that are computed, with the particles of their halves."""
    entries = run_shots.plan(whipple, options("space"), []).values()
    calibrating = {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    found = {shot.name: entry["case"]["particles"] for entry in entries for shot in [page.shot_of(entry)]
             if shot.angle > 0 and shot.runnable and shot.resolved and shot.is_near() and shot.name not in calibrating
             and entry["case"]["particles"] <= MOST}
    with open(CHOSEN, "w", newline="", encoding="utf-8") as out:
        out.write("# Written by `python3 -m studies.shields.oblique --choose` before the first half was computed.\n")
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["shot", "particles", "SHA-256 of the name"])
        for name in sorted(found, key=order):
            writer.writerow([name, f"{found[name]:.0f}", order(name)[:16]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--choose", action="store_true")
    parser.add_argument("--most", type=int)
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "oblique")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    if arguments.choose:
        write_chosen(arguments.whipple)
        return
    done = {row["shot"] for row in run_shots.rows_of(page.HERE / "outcomes.csv", "space", SETTINGS)}
    names = [row["shot"] for row in page.read_csv(CHOSEN)][:arguments.most]
    for name in (name for name in names if name not in done):
        folder = run_shots.folder_of(arguments.whipple, options("space"), name, arguments.work)
        entry = run_shots.plan(arguments.whipple, options("space"), [name])[name]
        verdict = run_shots.judged(arguments.whipple, 1, folder)
        row = run_shots.row_of(name, entry["case"], verdict, run_shots.status_of(folder / "run"), 1, SETTINGS)
        run_shots.append(page.HERE / "outcomes.csv", row)
        if entry["result"] == "NP" or verdict["defeated"]:
            run_shots.delete_snapshots(folder / "run")
        print(f"{name}: {row['outcome']}: {row['reason']} ({row['core hours']} core hours)", flush=True)


if __name__ == "__main__":
    main()
