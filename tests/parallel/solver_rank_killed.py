#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A rank of a distributed run is killed: the job ends with an error, and its last checkpoint goes on with another
number of ranks to the history of an undisturbed run.

Usage: solver_rank_killed.py WHIPPLE CASE.toml FOLDER
"""
import csv
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time


def children_of(process):
    """Process ids below a process, all generations."""
    found = []
    for task in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        for child in task.read_text().split():
            found += [int(child), *children_of(int(child))]
    return found


def name_of(process):
    return pathlib.Path(f"/proc/{process}/comm").read_text().strip()


def last_row(run):
    with open(run / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: float(value) for name, value in rows[-1].items()}


def main():
    whipple, case, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    options = ["--set", "domain.cell_size='1.2 mm'", "--set", "time.end='1.5 us'", "--set",
               "output.checkpoint_every='50 ms'", "--threads", "1", "--quiet"]

    killed = folder / "killed"
    job = subprocess.Popen([whipple, "run", case, "-o", killed, "--ranks", "3", *options], stderr=subprocess.PIPE,
                           text=True)
    deadline = time.monotonic() + 120
    try:
        while not list(killed.glob("checkpoint/checkpoint.*.h5")):
            assert job.poll() is None and time.monotonic() < deadline, "no checkpoint while the job runs"
            time.sleep(0.02)
        ranks = [child for child in children_of(job.pid) if name_of(child) == "whipple"]
        assert len(ranks) == 3, f"expected three ranks, found {ranks}"
        os.kill(ranks[1], signal.SIGKILL)
        _, message = job.communicate(timeout=60)
    finally:
        job.terminate()  # if it still runs: it ends its ranks
    assert job.returncode != 0, "a job with a killed rank must not end with 0"
    assert "signal 9" in message, f"the message does not say that a rank was killed: {message!r}"

    subprocess.run([whipple, "run", "--restart", killed, "--ranks", "2", "--threads", "1", "--quiet"], check=True)
    subprocess.run([whipple, "run", case, "-o", folder / "whole", *options], check=True)
    found, expected = last_row(killed), last_row(folder / "whole")
    energy = expected["total_energy [J]"]
    for name in ("time [s]", "mass [kg]", "kinetic_energy [J]", "internal_energy [J]", "total_energy [J]", "particles [1]"):
        scale = energy if name.endswith("[J]") else max(abs(expected[name]), 1e-300)
        assert abs(found[name] - expected[name]) <= 1e-11 * scale, (name, found[name], expected[name])
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
