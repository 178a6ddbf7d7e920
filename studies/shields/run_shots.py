#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do runs tell which shots on Whipple shields failed? Computes shots and records what became of their walls.

Usage: python3 -m studies.shields.run_shots SOURCE/SHOT... [--near COUNT] [--model section|space|tile] [--threads N] [--seed N]
       [--coarser RATIO] [--cell-size LENGTH] [--most-across N] [--work FOLDER] [--outcomes FILE.csv] [--whipple PROGRAM]

Makes the case of each shot (whipple shield), runs it until its outcome is decided, and adds a row to outcomes.csv with
outcome, time, reason, cells, cost and revision. --near adds the cheapest shots within a third of the limit of NNO that have
no row, are resolved and are not calibrating. Shots with a row of the same model are not computed again, and rows of tiles with
another seed, other cells or another state of tile.py need another file of outcomes; an interrupted run is
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
import sys
import tempfile

from studies import commands
from studies.shields import page, tile

SETTINGS = ["seed", "coarser", "tile.py"]  # of tiles alone; the last is the beginning of the digest of that file
COLUMNS = ["shot", "outcome", "time [us]", "reason", "model", "cell size [mm]", "resolved", "particles", "core hours", "revision", *SETTINGS]


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


def undecided(reason):
    """Verdict of a shot whose run says nothing."""
    return {"outcome": "undecided", "defeated": None, "time": None, "reason": reason}


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
        return undecided(f"the run failed: {status_of(run)['message']}")
    return json.loads(commands.call([whipple, "shield", run, "--outcome", "--json", "--quiet"]).stdout)


def status_of(run):
    """State of a run, with the revision of the program that computed it."""
    return json.loads((run / "status.json").read_text(encoding="utf-8"))


def delete_snapshots(run):
    """Deletes the snapshots of a run."""
    for file in run.glob("*.particles.*"):
        file.unlink()


def row_of(name, case, verdict, status, threads, settings):
    """Row of a shot. settings: of SETTINGS."""
    return {"shot": name, "outcome": verdict["outcome"],
            "time [us]": "" if verdict["time"] is None else f"{1e6 * verdict['time']:.4g}", "reason": verdict["reason"],
            "model": case["model"], "cell size [mm]": f"{1e3 * case['cell_size']:.4g}",
            "resolved": "yes" if case["resolved"] else "no", "particles": f"{case['particles']:.0f}",
            "core hours": f"{status['wall_time'] * threads / 3600:.3g}", "revision": status["revision"]} | settings


def tile_row(whipple, threads, name, entry, folder, seed, coarser):
    """Row of a shot by the model of grains on a tile, with the cost of both runs; undecided where one of them failed."""
    shot = tile.shot_in(entry, folder)
    case = entry["case"] | {"model": "tile"}
    runs = [folder / "cloud"]
    try:
        load = tile.computed_load(whipple, threads, shot)
        print(f"{name}: {load}")
        if load.is_one_piece(1e3 * entry["sphere"]["diameter"]):
            runs.append(folder / "run")
            verdict = judged(whipple, threads, folder)
            verdict["reason"] += f" (section: one piece of {100 * load.piece:.0f} % of the sphere, grains of {load.size:.3g} mm)"
        else:
            struck = tile.tile_of_shot(shot, load, seed, coarser)
            case |= {"cell_size": 1e-3 * struck.cell, "particles": 8 * struck.thickness * struck.side**2 / struck.cell**3}
            runs.append(folder / f"tile_{seed}_{coarser:g}")
            verdict = tile.judged(shot, load, struck, tile.computed_history(whipple, threads, shot, struck, runs[-1]))
    except tile.RunFailed as failure:
        verdict = undecided(str(failure))
    found = [status_of(run) for run in runs]
    cost = {"wall_time": sum(status["wall_time"] for status in found)}
    return row_of(name, case, verdict, found[0] | cost, threads, tile_settings(seed, coarser))


def tile_settings(seed, coarser):
    """Columns of what outcomes of tiles depend on besides the shot."""
    return dict(zip(SETTINGS, (str(seed), f"{coarser:g}", commands.digest(tile.__file__)[:12])))


def rows_of(file, model, settings):
    """Rows of a model in a file of outcomes. @throws SystemExit where they have other settings, or the file has other columns"""
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    if lines and lines[0] != ",".join(COLUMNS):
        sys.exit(f"{file}: line 1: the columns have to be {','.join(COLUMNS)}")
    rows = [row for row in page.read_csv(file) if row["model"] == model]
    for row in rows:
        if other := {key: row[key] for key in SETTINGS if (row[key] or "") != settings[key]}:
            sys.exit(f"{file}: {row['shot']} has {named(other)}, this call {named({key: settings[key] for key in other})}: "
                     "outcomes of other settings need another --outcomes FILE.csv")
    return rows


def named(settings):
    """Text of settings for a message."""
    return ", ".join(f"{key} {value or 'not recorded'}" for key, value in settings.items())


def append(file, row, columns=COLUMNS):
    """Adds a row, with a heading where the file is new."""
    new = not file.exists()
    with open(file, "a", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, columns, lineterminator="\n")
        if new:
            writer.writeheader()
        writer.writerow(row)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shots", nargs="*", metavar="SOURCE/SHOT")
    parser.add_argument("--near", type=int, default=0)
    parser.add_argument("--model", choices=("section", "space", "tile"), default="space")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seed", type=int)
    parser.add_argument("--coarser", type=float)
    parser.add_argument("--cell-size")
    parser.add_argument("--most-across")
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields")
    parser.add_argument("--outcomes", type=pathlib.Path, default=page.HERE / "outcomes.csv")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    tiles = arguments.model == "tile"
    if not tiles and (arguments.seed, arguments.coarser) != (None, None):
        parser.error("--seed and --coarser are of tiles: --model tile")
    seed, coarser = arguments.seed if arguments.seed is not None else 1, arguments.coarser if arguments.coarser is not None else 1.0
    if seed < 0 or not coarser > 0:
        parser.error(f"--seed has to be 0 or more and --coarser above 0, not {seed} and {coarser:g}")
    settings = tile_settings(seed, coarser) if tiles else dict.fromkeys(SETTINGS, "")
    options = ["--model", "section" if tiles else arguments.model]
    for name in ("cell_size", "most_across"):
        if getattr(arguments, name):
            options += [f"--{name.replace('_', '-')}", getattr(arguments, name)]
    done = {row["shot"] for row in rows_of(arguments.outcomes, arguments.model, settings)}
    names = list(arguments.shots)
    if arguments.near:
        names += cheapest_near(arguments.whipple, options, arguments.near, done | set(names))
    entries = plan(arguments.whipple, options, names) if names else {}
    for name in names:
        if name in done:
            print(f"{name}: has an outcome by the model {arguments.model} in {arguments.outcomes}")
            continue
        if tiles and entries[name]["sphere"]["angle"] > 0:
            print(f"{name}: oblique, tiles are of normal impact only: no row")
            continue
        folder = folder_of(arguments.whipple, options, name, arguments.work)
        if tiles:
            row = tile_row(arguments.whipple, arguments.threads, name, entries[name], folder, seed, coarser)
            append(arguments.outcomes, row)
        else:
            verdict = judged(arguments.whipple, arguments.threads, folder)
            row = row_of(name, entries[name]["case"], verdict, status_of(folder / "run"), arguments.threads, settings)
            append(arguments.outcomes, row)
            if entries[name]["result"] == "NP" or verdict["defeated"]:
                delete_snapshots(folder / "run")
        print(f"{name}: {row['outcome']}: {row['reason']} ({row['core hours']} core hours)")


if __name__ == "__main__":
    main()
