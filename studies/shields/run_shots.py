#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do runs tell which shots on Whipple shields failed? Computes shots and records what became of their walls.

Usage: python3 -m studies.shields.run_shots SOURCE/SHOT... [--near COUNT] [--model section|space] [--threads N]
       [--cell-size LENGTH] [--most-across N] [--work FOLDER] [--outcomes FILE.csv] [--whipple PROGRAM]

Makes the case of each shot (whipple shield), runs it until its outcome is decided, and adds a row to outcomes.csv with
outcome, time, reason, cells, cost and revision. --near adds the cheapest shots within a third of the limit of NNO that have
no row, are resolved and are not calibrating. Finished shots are not computed again; an interrupted run is resumed. Snapshots
are deleted once a shot is judged, except those of unsafe misses (measured P, the wall holds).
"""
import argparse
import csv
import json
import pathlib

from studies import commands
from studies.shields import page

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


def compute(whipple, options, threads, name, entry, folder):
    """Runs a shot and returns its row."""
    if not folder.exists():
        commands.call([whipple, "shield", page.HERE / "shots.csv", "--shot", name, *options, "-o", folder, "--quiet"])
    run = folder / "run"
    start = ["--restart", run] if (run / "status.json").exists() else [folder / "case.toml", "-o", run]
    commands.call([whipple, "run", *start, "--threads", threads, "--quiet"])
    verdict = json.loads(commands.call([whipple, "shield", run, "--outcome", "--json", "--quiet"]).stdout)
    if entry["result"] == "NP" or verdict["defeated"]:
        for file in run.glob("*.particles.*"):
            file.unlink()
    status = json.loads((run / "status.json").read_text(encoding="utf-8"))
    case = entry["case"]
    return {"shot": name, "outcome": verdict["outcome"],
            "time [us]": "" if verdict["time"] is None else f"{1e6 * verdict['time']:.4g}", "reason": verdict["reason"],
            "model": case["model"], "cell size [mm]": f"{1e3 * case['cell_size']:.4g}",
            "resolved": "yes" if case["resolved"] else "no", "particles": f"{case['particles']:.0f}",
            "core hours": f"{status['wall_time'] * threads / 3600:.3g}", "revision": commands.program(whipple)}


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
    parser.add_argument("--model", choices=("section", "space"), default="space")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--cell-size")
    parser.add_argument("--most-across")
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields")
    parser.add_argument("--outcomes", type=pathlib.Path, default=page.HERE / "outcomes.csv")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    options = ["--model", arguments.model]
    for name in ("cell_size", "most_across"):
        if getattr(arguments, name):
            options += [f"--{name.replace('_', '-')}", getattr(arguments, name)]
    done = {row["shot"] for row in page.read_csv(arguments.outcomes)}
    names = list(arguments.shots)
    if arguments.near:
        names += cheapest_near(arguments.whipple, options, arguments.near, done | set(names))
    entries = plan(arguments.whipple, options, names) if names else {}
    for name in names:
        if name in done:
            print(f"{name}: has an outcome")
            continue
        row = compute(arguments.whipple, options, arguments.threads, name, entries[name],
                      arguments.work / name.replace("/", "_").replace(" ", "_"))
        append(arguments.outcomes, row)
        print(f"{name}: {row['outcome']}: {row['reason']} ({row['core hours']} core hours)")


if __name__ == "__main__":
    main()
