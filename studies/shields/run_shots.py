#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do runs tell which shots on Whipple shields failed? Computes shots and records what became of their walls.

Usage: python3 -m studies.shields.run_shots SOURCE/SHOT... [--near COUNT] [--model section|space|tile] [--threads N] [--seed N]
       [--coarser RATIO] [--cell-size LENGTH] [--most-across N] [--work FOLDER] [--outcomes FILE.csv] [--whipple PROGRAM]

Makes the case of each shot (whipple shield), runs it until its outcome is decided, and adds a row to outcomes.csv with
outcome, time, reason, cells, cost and revision. --near adds the cheapest shots within a third of the limit of NNO that have
no row, are resolved and are not calibrating. Shots with a row of the same model are not computed again; an interrupted run is
resumed from its checkpoint, if it has one. A run that fails is undecided, for the reason that it gives. The name of the folder
of a run contains a digest of its case, so that other options have another folder. Snapshots are deleted once the row is
written, except those of unsafe misses (measured P, the wall holds).

--model tile takes the load of the debris from a section without the wall, and lets its grains strike a tile of the wall in three
dimensions (docs/decisions/0025_grains_before_a_wall.md), with --seed and cells that are --coarser than the rule's. Normal impact only.
"""
import argparse
import csv
import json
import pathlib
import shutil
import tempfile

from studies import commands
from studies.shields import page, tile

COLUMNS = ["shot", "outcome", "time [us]", "reason", "model", "cell size [mm]", "resolved", "particles", "core hours", "revision"]


def plan(whipple, options, names):
    """Cases that `whipple shield` would make of shots, by name."""
    chosen = [word for name in names for word in ("--shot", name)]
    command = [whipple, "shield", page.HERE / "shots.csv", *chosen, *options, "--json", "--quiet"]
    return {f"{entry['source']}/{entry['name']}": entry for entry in json.loads(commands.call(command).stdout)}


def cheapest_near(whipple, options, count, done):
    """Names of the cheapest shots near the limit that have no outcome."""
    calibrating = {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    entries = plan(whipple, options, [])
    shots = [(entries[shot.name]["case"]["particles"], shot.name) for shot in map(page.shot_of, entries.values())
             if shot.runnable and shot.resolved and shot.is_near() and shot.name not in done | calibrating]
    return [name for _, name in sorted(shots)[:count]]


def folder_of(whipple, options, name, work):
    """Folder of a shot with its case: named by the shot and a digest of the case."""
    with tempfile.TemporaryDirectory() as scratch:
        made = pathlib.Path(scratch) / "case"
        commands.call([whipple, "shield", page.HERE / "shots.csv", "--shot", name, *options, "-o", made, "--quiet"])
        folder = work / f"{name.replace('/', '_').replace(' ', '_')}_{commands.digest(made / 'case.toml')[:12]}"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(made / "case.toml", folder / "case.toml")
    return folder


def judged(whipple, threads, folder):
    """Runs the case of a folder and returns its verdict: that of `whipple shield`, undecided where the run failed (code 3)."""
    run = folder / "run"
    if any(run.glob("checkpoint/*.h5")):
        start = ["--restart", run]
    else:
        shutil.rmtree(run, ignore_errors=True)
        start = [folder / "case.toml", "-o", run]
    done = commands.call([whipple, "run", *start, "--threads", threads, "--quiet"], allowed=(0, 3))
    if done.returncode == 3:
        return {"outcome": "undecided", "defeated": None, "time": None, "reason": f"the run failed: {status_of(run)['message']}"}
    return json.loads(commands.call([whipple, "shield", run, "--outcome", "--json", "--quiet"]).stdout)


def status_of(run):
    """State of a run, with the revision of the program that computed it."""
    return json.loads((run / "status.json").read_text(encoding="utf-8"))


def delete_snapshots(run):
    """Deletes the snapshots of a run."""
    for file in run.glob("*.particles.*"):
        file.unlink()


def row_of(name, case, verdict, status, threads):
    """Row of a shot."""
    return {"shot": name, "outcome": verdict["outcome"],
            "time [us]": "" if verdict["time"] is None else f"{1e6 * verdict['time']:.4g}", "reason": verdict["reason"],
            "model": case["model"], "cell size [mm]": f"{1e3 * case['cell_size']:.4g}",
            "resolved": "yes" if case["resolved"] else "no", "particles": f"{case['particles']:.0f}",
            "core hours": f"{status['wall_time'] * threads / 3600:.3g}", "revision": status["revision"]}


def tile_row(whipple, threads, name, entry, folder, seed, coarser):
    """Row of a shot by the model of grains on a tile, with the cost of both runs."""
    shot = tile.shot_in(entry, folder)
    load = tile.computed_load(whipple, threads, shot)
    status = status_of(folder / "cloud")
    case = entry["case"] | {"model": "tile"}
    if load.is_one_piece(1e3 * entry["sphere"]["diameter"]):
        verdict = judged(whipple, threads, folder)
        verdict["reason"] += f" (section: one piece of {100 * load.piece:.0f} % of the sphere, or grains as large as it)"
        more = status_of(folder / "run")
    else:
        struck, records, run = tile.computed_tile(whipple, threads, shot, load, seed, coarser)
        verdict, more = tile.judged(shot, load, struck, records), status_of(run)
        case |= {"cell_size": 1e-3 * struck.cell, "particles": 8 * struck.thickness * struck.side**2 / struck.cell**3}
    print(f"{name}: {load}")
    return row_of(name, case, verdict, status | {"wall_time": status["wall_time"] + more["wall_time"]}, threads)


def append(file, row):
    """Adds a row, with a heading where the file is new."""
    new = not file.exists()
    with open(file, "a", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        if new:
            writer.writeheader()
        writer.writerow(row)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shots", nargs="*", metavar="SOURCE/SHOT")
    parser.add_argument("--near", type=int, default=0)
    parser.add_argument("--model", choices=("section", "space", "tile"), default="space")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--coarser", type=float, default=1.0)
    parser.add_argument("--cell-size")
    parser.add_argument("--most-across")
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields")
    parser.add_argument("--outcomes", type=pathlib.Path, default=page.HERE / "outcomes.csv")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    tiles = arguments.model == "tile"
    options = ["--model", "section" if tiles else arguments.model]
    for name in ("cell_size", "most_across"):
        if getattr(arguments, name):
            options += [f"--{name.replace('_', '-')}", getattr(arguments, name)]
    done = {row["shot"] for row in page.read_csv(arguments.outcomes) if row["model"] == arguments.model}
    names = list(arguments.shots)
    if arguments.near:
        names += cheapest_near(arguments.whipple, options, arguments.near, done | set(names))
    entries = plan(arguments.whipple, options, names) if names else {}
    for name in names:
        if name in done:
            print(f"{name}: has an outcome")
            continue
        if tiles and entries[name]["sphere"]["angle"] > 0:
            print(f"{name}: oblique, not modelled by tiles")
            continue
        folder = folder_of(arguments.whipple, options, name, arguments.work)
        if tiles:
            row = tile_row(arguments.whipple, arguments.threads, name, entries[name], folder, arguments.seed, arguments.coarser)
            append(arguments.outcomes, row)
        else:
            verdict = judged(arguments.whipple, arguments.threads, folder)
            row = row_of(name, entries[name]["case"], verdict, status_of(folder / "run"), arguments.threads)
            append(arguments.outcomes, row)
            if entries[name]["result"] == "NP" or verdict["defeated"]:
                delete_snapshots(folder / "run")
        print(f"{name}: {row['outcome']}: {row['reason']} ({row['core hours']} core hours)")


if __name__ == "__main__":
    main()
