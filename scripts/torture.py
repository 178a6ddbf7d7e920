#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills runs again and again (SIGKILL) and lets them go on; the ends are compared with those of undisturbed runs: bitwise
on one rank, to round-off on several.

Usage: torture.py WHIPPLE CASE.toml FOLDER [--runs 40] [--ranks 1] [--kills 3] [--seed 1]
On ranks the launcher is killed or one of the ranks, at random.
"""
import argparse
import csv
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

OPTIONS = ["--threads", "1", "--quiet"]
ROUND_OFF = 1e-11  # of the largest value of a column


def processes_below(process):
    found = []
    for task in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        try:
            children = [int(child) for child in task.read_text().split()]
        except (FileNotFoundError, ProcessLookupError):
            continue
        found += children + [grandchild for child in children for grandchild in processes_below(child)]
    return found


def name_of(process):
    try:
        return pathlib.Path(f"/proc/{process}/comm").read_text().strip()
    except (FileNotFoundError, ProcessLookupError):
        return ""


def command(arguments, ranks):
    return [*map(str, arguments), *OPTIONS, *(["--ranks", str(ranks)] if ranks > 1 else [])]


def disturbed(whipple, case, run, ranks, kills, seconds):
    """Runs a case to its end through so many kills; returns how often it was killed while it ran."""
    killed = 0
    for attempt in range(kills + 1):
        # A run that had no checkpoint yet starts over, as a user would have it.
        goes_on = list(run.glob("checkpoint/checkpoint.*.h5"))
        call = ["run", "--restart", run] if goes_on else ["run", case, "-o", run, "--force"]
        process = subprocess.Popen([whipple, *command(call, ranks)], stderr=subprocess.PIPE, text=True)
        if attempt < kills:
            time.sleep(random.uniform(0.2, 1.0) * seconds)
            victims = [process.pid] + [p for p in processes_below(process.pid) if name_of(p) == "whipple"]
            try:
                os.kill(random.choice(victims), signal.SIGKILL)
            except ProcessLookupError:
                pass
        message = process.communicate(timeout=600)[1]
        if process.returncode == 0:
            return killed
        if attempt == kills:
            raise SystemExit(f"{run}: exit code {process.returncode}: {message}")
        killed += 1
        # Ranks end with their launcher, but not within the same instant; the lock keeps others out meanwhile.
        deadline = time.monotonic() + 60
        while ranks > 1 and lock_is_held(run) and time.monotonic() < deadline:
            time.sleep(0.05)
    return killed


def lock_is_held(run):
    import fcntl
    try:
        with open(run / ".lock") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(cell) for cell in row] for row in rows[1:]]


def difference(run, whole):
    """Largest difference of the histories and its column, relative to the largest value of the column; of energies to the
    total, of momenta to the largest: a component may be round-off alone."""
    (names, found), (_, expected) = table(run / "history.csv"), table(whole / "history.csv")
    if len(found) != len(expected):
        return math.inf, "rows"
    energy = max(abs(row[names.index("total_energy [J]")]) for row in expected)
    momentum = max(abs(row[names.index(f"momentum_{axis} [kg m/s]")]) for row in expected for axis in "xyz")
    largest = 0.0, ""
    for column, name in enumerate(names):
        if "error" in name:
            continue
        scale = max(abs(row[column]) for row in expected) or 1.0
        if name.endswith("[J]"):
            scale = energy
        elif name.endswith(("[kg m/s]", "[N s]")):
            scale = momentum
        largest = max(largest, (max(abs(a[column] - b[column]) for a, b in zip(found, expected)) / scale, name))
    return largest


def same_files(run, whole):
    """Names of the results that differ in any byte."""
    names = {path.name for folder in (run, whole) for path in folder.iterdir() if path.suffix in (".hdf", ".csv", ".series")}
    return sorted(name for name in names if not (run / name).exists() or not (whole / name).exists()
                  or (run / name).read_bytes() != (whole / name).read_bytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("whipple")
    parser.add_argument("case")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    random.seed(options.seed)
    shutil.rmtree(options.folder, ignore_errors=True)
    options.folder.mkdir(parents=True)
    whole = options.folder / "whole"
    begin = time.monotonic()
    subprocess.run([options.whipple, *command(["run", options.case, "-o", whole], options.ranks)], check=True)
    seconds = time.monotonic() - begin
    kills, faults, largest = 0, [], (0.0, "")
    for number in range(options.runs):
        run = options.folder / f"run_{number:03}"
        kills += disturbed(options.whipple, options.case, run, options.ranks, options.kills, seconds)
        left = [str(path) for path in run.rglob("*.partial")]
        if options.ranks == 1:
            faults += [f"{run}: {name} differs" for name in same_files(run, whole)]
        largest = max(largest, difference(run, whole))
        faults += [f"{run}: {path} is left" for path in left]
        shutil.rmtree(run)
    bound = 0.0 if options.ranks == 1 else ROUND_OFF
    if not largest[0] <= bound:
        faults.append(f"histories differ by {largest[0]:.2e} in {largest[1]}, more than {bound:.0e}")
    print(f"{options.runs} runs on {options.ranks} ranks, {kills} kills: largest difference {largest[0]:.1e}, {len(faults)} faults")
    print("\n".join(faults))
    if not faults:
        shutil.rmtree(options.folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
