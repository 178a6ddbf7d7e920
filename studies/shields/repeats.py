#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many verdicts of sections change with the cells, the place of the lattice, the number of threads?

Usage: python3 -m studies.shields.repeats [--count 40] [--work FOLDER] [--whipple PROGRAM]

Repeats scored shots of outcomes.csv by sections: of those in the order of their names the ones at the places i n/COUNT, rounded down, i from 0 to
COUNT - 1, so that no outcome chooses. Each again with cells 0.8 times as large, with the lattice moved by a quarter of a cell along the
flight, half the spacing of the particles, and on two threads. Writes a row for each to repeats.csv, beside what outcomes.csv has; with two
threads also whether history.csv has the same bytes as on one. Shots with a row are not computed again. The page
(studies.shields.page) counts the changes.
"""
import argparse
import pathlib
import re

from studies import commands
from studies.shields import page, run_shots

FILE = page.HERE / "repeats.csv"
FINER = 0.8
VARIANTS = ("lattice", "finer cells", "two threads")
THREADS = {"two threads": 2}


def chosen(rows, calibrating, count):
    """Names of the shots that are repeated, with their rows: see above."""
    scored = sorted((row for row in rows if row["model"] == "section" and row["outcome"] != "undecided"
                     and row["resolved"] == "yes" and row["shot"] not in calibrating), key=lambda row: row["shot"])
    return [scored[i * len(scored) // count] for i in range(min(count, len(scored)))]


def moved(text):
    """The case with its domain moved by a quarter of a cell along the flight. @throws ValueError where it has no such lines"""
    found = re.search(r'^cell_size = "([0-9.e-]+) mm"$', text, re.MULTILINE)
    if not found:
        raise ValueError("the case has no cell size in mm")
    quarter = 0.25 * float(found.group(1))
    pattern = r'^(lower|upper) = \[(.*), "(-?[0-9.]+) mm"\]$'
    text, count = re.subn(pattern, lambda m: f'{m.group(1)} = [{m.group(2)}, "{float(m.group(3)) - quarter:.10g} mm"]', text, flags=re.MULTILINE)
    if count != 2:
        raise ValueError("the case has no domain in three dimensions in mm")
    return text


def repeated(whipple, row, variant, work):
    """Row of a shot with a variant."""
    name = row["shot"]
    options = ["--model", "section"]
    if variant == "finer cells":
        options += ["--cell-size", f"{FINER * float(row['cell size [mm]']):.4g} mm"]
    folder = run_shots.folder_of(whipple, options, name, work / variant.replace(" ", "_"))
    case = folder / "case.toml"
    if variant == "lattice":
        case.write_text(moved(case.read_text(encoding="utf-8")), encoding="utf-8")
    threads = THREADS.get(variant, 1)
    verdict = run_shots.judged(whipple, threads, folder)
    status = run_shots.status_of(folder / "run")
    same = ""
    if variant in THREADS:
        alone = folder.parent / f"{folder.name}_alone"
        alone.mkdir(exist_ok=True)
        (alone / "case.toml").write_bytes(case.read_bytes())
        run_shots.judged(whipple, 1, alone)
        same = "yes" if commands.digest(folder / "run" / "history.csv") == commands.digest(alone / "run" / "history.csv") else "no"
        run_shots.delete_snapshots(alone / "run")
    run_shots.delete_snapshots(folder / "run")
    return {"shot": name, "variant": variant, "first": row["outcome"], "outcome": verdict["outcome"],
            "time [us]": "" if verdict["time"] is None else f"{1e6 * verdict['time']:.4g}", "reason": " ".join(verdict["reason"].split()), "same bytes": same,
            "core hours": f"{status['wall_time'] * threads / 3600:.3g}", "revision": status["revision"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--variants", nargs="+", default=VARIANTS, choices=VARIANTS)
    parser.add_argument("--work", type=pathlib.Path, default=commands.ROOT / "run" / "shields" / "repeats")
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    arguments = parser.parse_args()
    calibrating = {row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")}
    shots = chosen(page.read_csv(page.HERE / "outcomes.csv"), calibrating, arguments.count)
    for variant in arguments.variants:
        done = {row["shot"] for row in page.read_csv(FILE) if row["variant"] == variant}
        for row in shots:
            if row["shot"] not in done:
                new = repeated(arguments.whipple, row, variant, arguments.work)
                run_shots.append(FILE, new, list(new))
                print(f"{variant}: {new['shot']}: {new['first']}, {new['outcome']}: {new['reason']}", flush=True)


if __name__ == "__main__":
    main()
