#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do runs tell which shots on panels of aluminium foam failed?

Usage: python3 -m studies.shields.foam_panels [--jobs N] [--only FOAM:CELL]... [--work FOLDER] [--whipple PROGRAM]

Shots of foam_panels.csv. Foam by FOAM: struts (a quarter of random cells between mirror planes, three seeds), layer (a section through a
porous material of the same density) and none (the two sheets alone, a quarter). Cells and seeds: VARIANTS, chosen before any was
computed. Adds a row for each run to foam_outcomes.csv, in which three of a kind make the verdict of a shot by majority. Runs with a row
are not computed again; an interrupted one is resumed from its checkpoint, if it has one. --only struts:0.16 computes that kind alone.
"""
import argparse
import concurrent.futures
import csv
import json
import pathlib
import threading

from studies import commands
from studies.shields import page, run_shots, three_dimensions

SHOTS = page.HERE / "foam_panels.csv"
FILE = page.HERE / "foam_outcomes.csv"
KEYS = ["shot", "foam", "cell size [mm]", "seed"]
COLUMNS = [*KEYS, "measured", "outcome", "time [us]", "reason", *three_dimensions.MEASURES, "particles", "seconds", "revision"]
MODELS = {"struts": "space", "layer": "section", "none": "space"}
VARIANTS = [("struts", "0.16", seed) for seed in ("1", "2", "3")] + [("layer", "0.064", ""), ("layer", "0.045", ""), ("none", "0.16", "")] + \
           [("struts", "0.125", seed) for seed in ("1", "2", "3")]


def table_of(foam, work):
    """File of the shots; without the columns of foam where there is none."""
    if foam != "none":
        return SHOTS
    rows = page.read_csv(SHOTS)
    bare = work / "without_foam.csv"
    work.mkdir(parents=True, exist_ok=True)
    with open(bare, "w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, [name for name in rows[0] if not name.startswith("foam")], extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return bare


def command_of(whipple, table, name, foam, cell, seed):
    """Words of `whipple shield` for a variant of a shot."""
    words = [whipple, "shield", table, "--shot", name, "--model", MODELS[foam], "--cell-size", f"{cell} mm", "--quiet"]
    if foam != "none":
        words += ["--foam", foam]
    return words + (["--seed", seed] if seed else [])


def computed(whipple, table, work, name, foam, cell, seed):
    """Row of a variant of a shot."""
    command = command_of(whipple, table, name, foam, cell, seed)
    entry = json.loads(commands.call([*command, "--json"]).stdout)[0]
    folder = work / f"{name.replace('/', '_')}_{foam}_{cell}{'_' + seed if seed else ''}"
    if not (folder / "case.toml").exists():
        commands.call([*command, "-o", folder])
    verdict = run_shots.judged(whipple, 1, folder)
    status = run_shots.status_of(folder / "run")
    row = {"shot": name, "foam": foam, "cell size [mm]": cell, "seed": seed, "measured": entry["result"], "outcome": verdict["outcome"],
           "time [us]": "" if verdict["time"] is None else f"{1e6 * verdict['time']:.4g}", "reason": verdict["reason"],
           "particles": f"{entry['case']['particles']:.0f}", "seconds": f"{status['wall_time']:.3g}", "revision": status["revision"]}
    row |= three_dimensions.measures(whipple, folder / "run")
    run_shots.delete_snapshots(folder / "run")
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", action="append", metavar="FOAM:CELL")
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "foam_panels")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    kinds = list(dict.fromkeys(f"{foam}:{cell}" for foam, cell, _ in VARIANTS))
    if unknown := set(arguments.only or []) - set(kinds):
        parser.error(f"--only {', '.join(sorted(unknown))}: expected one of {', '.join(kinds)}")
    done = {tuple(row[key] or "" for key in KEYS) for row in page.read_csv(FILE)}
    names = [f"{row['source']}/{row['shot']}" for row in page.read_csv(SHOTS)]
    tables = {foam: table_of(foam, arguments.work) for foam in MODELS}
    lock = threading.Lock()

    def compute(name, foam, cell, seed):
        row = computed(arguments.whipple, tables[foam], arguments.work, name, foam, cell, seed)
        with lock:
            run_shots.append(FILE, row, COLUMNS)
        return row

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        jobs = [pool.submit(compute, name, *variant) for variant in VARIANTS for name in names
                if (name, *variant) not in done and (not arguments.only or f"{variant[0]}:{variant[1]}" in arguments.only)]
        for job in concurrent.futures.as_completed(jobs):
            row = job.result()
            print(f"{row['shot']}, {row['foam']}, {row['cell size [mm]']} mm {row['seed']}: {row['outcome']} (measured {row['measured']}): "
                  f"{row['reason']}, {row['seconds']} s", flush=True)


if __name__ == "__main__":
    main()
