#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do sections of shots on shields have the same outcome as three dimensions?

Usage: python3 -m studies.shields.three_dimensions [--choose] [--work FOLDER] [--whipple PROGRAM]

Twenty scored shots (model section of outcomes.csv), each as a quarter between two mirror planes with 8 cells across the sphere (two and a
little more through the bumper) and as a section in the same cells. Chosen before any of them was computed, by a rule that knows no outcome:
those whose sheets all have two cells so, with at most 200,000 particles in the quarter (its cost), in the order of the SHA-256 of their
names the first twenty. --choose writes them to three_dimensions_shots.csv, which is what is computed.

Adds a row for each quarter to outcomes.csv (model space) and one for each run to three_dimensions.csv, with what is left of the wall and its cost.
Runs with a row are not computed again; an interrupted one is resumed from its checkpoint, if it has one.
"""
import argparse
import csv
import hashlib
import json
import pathlib

from studies import commands
from studies.shields import page, run_shots

CHOSEN = page.HERE / "three_dimensions_shots.csv"
FILE = page.HERE / "three_dimensions.csv"
ACROSS = 8         # cells across the sphere, at most
COUNT = 20
MOST = 200_000     # particles of a quarter
SETTINGS = dict.fromkeys(run_shots.SETTINGS, "")
MEASURES = {"left": "least_left.wall", "left on the axis": "left_on_axis.wall", "hole [mm]": "hole_diameter.wall"}  # of `whipple analyse`


def options(model):
    """Words of `whipple shield` for a model."""
    return ["--model", model, "--most-across", str(ACROSS)]


def order(name):
    """Place of a shot: the SHA-256 of its name."""
    return hashlib.sha256(name.encode("utf-8")).hexdigest()


def chosen(rows, cases, calibrating, count=COUNT):
    """Names of the shots that are computed: see above. rows: of outcomes; cases: of quarters (`whipple shield --json`), by name."""
    scored = {row["shot"] for row in rows if row["model"] == "section" and row["outcome"] != "undecided"
              and row["resolved"] == "yes" and row["shot"] not in calibrating}
    cheap = [name for name in scored if cases[name]["resolved"] and cases[name]["particles"] <= MOST]
    return sorted(cheap, key=order)[:count]


def measures(whipple, run):
    """What is left of the wall at the end of a run, lengths in mm; empty where it does not apply."""
    found = json.loads(commands.call([whipple, "analyse", run, "--json", "--quiet"]).stdout)
    values = {}
    for column, name in MEASURES.items():
        value = found[name]["value"] if name in found else None
        values[column] = "" if value is None or value != value else f"{value * (1e3 if column.endswith('[mm]') else 1):.4g}"
    return values


def computed(whipple, name, model, entry, work):
    """Rows of a shot by a model: that of outcomes.csv and that of three_dimensions.csv."""
    folder = run_shots.folder_of(whipple, options(model), name, work / model)
    verdict = run_shots.judged(whipple, 1, folder)
    status = run_shots.status_of(folder / "run")
    row = run_shots.row_of(name, entry["case"], verdict, status, 1, SETTINGS)
    own = {key: row[key] for key in run_shots.COLUMNS if key not in run_shots.SETTINGS and key != "core hours"}
    own |= {"steps": status["step"], "seconds": f"{status['wall_time']:.3g}"} | measures(whipple, folder / "run")
    run_shots.delete_snapshots(folder / "run")
    return row, own


def write_chosen(whipple):
    """Writes the shots that are computed, with the particles of their quarters."""
    cases = {name: entry["case"] for name, entry in run_shots.plan(whipple, options("space"), []).items() if "refused" not in entry["case"]}
    calibrating = {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    with open(CHOSEN, "w", newline="", encoding="utf-8") as out:
        out.write("# Written by `python3 -m studies.shields.three_dimensions --choose` before the first quarter was computed.\n")
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["shot", "particles", "SHA-256 of the name"])
        for name in chosen(page.read_csv(page.HERE / "outcomes.csv"), cases, calibrating):
            writer.writerow([name, f"{cases[name]['particles']:.0f}", order(name)[:16]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--choose", action="store_true")
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "three_dimensions")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    if arguments.choose:
        write_chosen(arguments.whipple)
        return
    names = [row["shot"] for row in page.read_csv(CHOSEN)]
    for name in names:
        for model in ("section", "space"):
            if (name, model) in {(row["shot"], row["model"]) for row in page.read_csv(FILE)}:
                continue
            entry = run_shots.plan(arguments.whipple, options(model), [name])[name]
            row, own = computed(arguments.whipple, name, model, entry, arguments.work)
            if model == "space":
                run_shots.append(page.HERE / "outcomes.csv", row)
            run_shots.append(FILE, own, list(own))
            print(f"{name}, {model}: {row['outcome']}: {row['reason']} ({own['steps']} steps, {own['seconds']} s)", flush=True)


if __name__ == "__main__":
    main()
