#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A run that another process steers, on one rank and on two: a pause costs no processor time and changes nothing; the
replay of its steering.csv is the same run, bit for bit.

Usage: run_replay.py WHIPPLE CASE.toml FOLDER
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import h5py

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "unit"))

from checks import require, wait_for  # noqa: E402

WHIPPLE, CASE, FOLDER = *sys.argv[1:3], pathlib.Path(sys.argv[3])
VALUES = ["--set", "domain.cell_size=0.3 mm", "--set", "output.checkpoint_every=0", "--set", "output.snapshot_every=0"]
ENDLESS = ["--set", "time.end=1 s"]
MOST_OF_A_CORE = 0.2  # of each rank in a pause


def start(run, ranks, *more):
    arguments = [WHIPPLE, "run", CASE, "-o", run, "--ranks", str(ranks), "--threads", "1", "--quiet", *VALUES, *more]
    return subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True)


def finish(process, what):
    message = process.communicate(timeout=120)[1]
    require(process.returncode == 0, f"{what}: {process.returncode} {message}")


def steer(run, *request):
    done = subprocess.run([WHIPPLE, "steer", run, *request], capture_output=True, text=True)
    require(done.returncode == 0 and "accepted" in done.stdout, f"{request}: {done}")


def processor_time(run, ranks):
    """Of the processes that have the folder of the run among their arguments, s."""
    total, found = 0.0, 0
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            arguments = (process / "cmdline").read_bytes().split(b"\0")
            numbers = (process / "stat").read_text().rpartition(")")[2].split()
            name = (process / "comm").read_text().strip()
        except (FileNotFoundError, ProcessLookupError):
            continue
        if name == "whipple" and str(run).encode() in arguments and b"run" in arguments:
            total += (int(numbers[11]) + int(numbers[12])) / os.sysconf("SC_CLK_TCK")
            found += 1
    require(found >= ranks, f"{found} processes of {ranks} ranks")
    return total


def paused(run, process):
    """Pauses a run. Returns an end a few steps later, with its unit."""
    wait_for(lambda: (run / "control").is_dir() or process.poll() is not None, "the run")
    steer(run, "pause")
    wait_for(lambda: status(run)["state"] == "paused", "the pause")
    return f"{status(run)['time'] + 0.08e-6!r} s"


def status(run):
    return json.loads((run / "status.json").read_text())


def last_snapshot(run):
    """All numbers of the particles, by their id."""
    index = json.loads(next(run.glob("*.particles.hdf.series")).read_text())["files"]
    with h5py.File(run / index[-1]["name"]) as file:
        data, points = file["VTKHDF/PointData"], file["VTKHDF/Points"][:]
        order = data["id"][:].argsort()
        return {"points": points[order].tobytes(), **{name: data[name][:][order].tobytes() for name in data}}, len(index)


def same(one, other, what):
    require((one / "history.csv").read_bytes() == (other / "history.csv").read_bytes(), f"{what}: another history.csv")
    require(last_snapshot(one) == last_snapshot(other), f"{what}: other particles at the end")


def check(ranks):
    free, rested, steered, again = (FOLDER / f"{name}_{ranks}" for name in ("free", "rested", "steered", "again"))
    process = start(rested, ranks, *ENDLESS)
    end = paused(rested, process)
    before, begin = processor_time(rested, ranks), time.monotonic()
    time.sleep(1.0)
    used = (processor_time(rested, ranks) - before) / (time.monotonic() - begin)
    print(f"{ranks} ranks use {used:.3f} cores in a pause")
    require(used < MOST_OF_A_CORE * ranks, f"{used} cores in a pause of {ranks} ranks")
    steer(rested, "end", end)
    steer(rested, "resume")
    finish(process, "the run with a pause")
    finish(start(free, ranks, "--set", f"time.end={end}"), "the undisturbed run")
    same(free, rested, f"a pause, {ranks} ranks")

    process = start(steered, ranks, *ENDLESS)
    end = paused(steered, process)
    for request in (("snapshot_every", "0.03 us"), ("history_every", "2"), ("end", end), ("resume",)):
        steer(steered, *request)
    finish(process, "the steered run")
    finish(start(again, ranks, *ENDLESS, "--replay", steered / "steering.csv"), "the replay")
    same(steered, again, f"a replay, {ranks} ranks")
    require(last_snapshot(steered)[1] > 2, "the interval of the snapshots was not followed")
    with open(steered / "steering.csv", newline="") as file:
        require([row["answer"] for row in csv.DictReader(file)] == ["accepted"] * 5, "answers")


def late():
    """Requests beyond the end of a run: each is answered, or its sender is told that the run has ended; none is left."""
    run = FOLDER / "late"
    process = start(run, 1, *ENDLESS)
    wait_for(lambda: (run / "control").is_dir(), "the run")
    steer(run, "end")
    for _ in range(100):
        asked = subprocess.run([WHIPPLE, "steer", run, "history_every", "1"], capture_output=True, text=True)
        require(asked.returncode == 2 and ("ended" in asked.stderr or "no run is active" in asked.stderr), f"a late request: {asked}")
        if process.poll() is not None:
            break
    finish(process, "the run with requests to its end")
    require(not list((run / "control").iterdir()), "a request is left")
    answers = [(row["request"], row["answer"]) for row in csv.DictReader((run / "steering.csv").open(newline=""))]
    require(answers[0] == ("end", "accepted") and all(answer == "refused" for _, answer in answers[1:]), f"answers: {answers}")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for ranks in (1, 2):
        check(ranks)
    late()
    shutil.rmtree(FOLDER)


if __name__ == "__main__":
    main()
