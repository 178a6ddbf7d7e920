#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Processes of a run and what befalls them: a second writer, signals, a killed launcher, a full disk, requests, on one rank and two.

Usage: run_processes.py WHIPPLE CASE.toml PLAN.toml FOLDER
"""
import csv
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "unit"))

from checks import require, wait_for  # noqa: E402

WHIPPLE, CASE, PLAN, FOLDER = *sys.argv[1:4], pathlib.Path(sys.argv[4])
# A million snapshots are refused: a run without an end writes the first and the last one. At 2 km/s all material has left the
# domain after a few seconds of an idle machine.
ENDLESS = ["--set", "time.end='1 s'", "--set", "output.snapshot_every=0", "--set", "body.0.velocity=['0 m/s', '0 m/s', '1 m/s']"]


def start(*arguments):
    # OMP_WAIT_POLICY is whipple's to set.
    environment = {name: value for name, value in os.environ.items() if name != "OMP_WAIT_POLICY"}
    return subprocess.Popen([WHIPPLE, "run", *map(str, arguments), "--threads", "1", "--quiet"], stderr=subprocess.PIPE,
                            text=True, env=environment)


def finish(process):
    _, message = process.communicate(timeout=120)
    return process.returncode, message


def processes_below(process):
    found = []
    for task in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        try:
            children = task.read_text().split()
        except (FileNotFoundError, ProcessLookupError):  # it has just ended
            continue
        for child in children:
            found += [int(child), *processes_below(int(child))]
    return found


def name_of(process):
    try:
        return pathlib.Path(f"/proc/{process}/comm").read_text().strip()
    except (FileNotFoundError, ProcessLookupError):
        return ""


def ranks_of(launcher, program="whipple"):
    return [process for process in processes_below(launcher) if name_of(process) == program]


def is_alive(process):
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def last_step(run):
    """Rows of a history that is being written may be cut."""
    with open(run / "history.csv", newline="") as file:
        rows = [row for row in csv.reader(file)]
    return int(rows[-1][0]) if len(rows) > 2 else 0


def goes_on(run, launcher):
    """Waits until a run makes steps again."""
    wait_for(lambda: (run / ".lock").exists(), "the lock")
    before = last_step(run)
    wait_for(lambda: launcher.poll() is not None or last_step(run) > before + 2, "steps")
    require(launcher.poll() is None, "the run has ended")


def one_rank():
    """A limit on the size of files stands for a full disk; the process meets it in the middle of the run."""
    whole, run = FOLDER / "whole", FOLDER / "full"
    require(finish(start(CASE, "-o", whole))[0] == 0, "the undisturbed run fails")
    process = start(CASE, "-o", run)
    wait_for(lambda: list(run.glob("checkpoint/*.h5")), "a checkpoint")
    require(b"OMP_WAIT_POLICY=passive" in pathlib.Path(f"/proc/{process.pid}/environ").read_bytes(),
            "threads would wait in a loop")
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (20000, resource.RLIM_INFINITY))
    code, message = finish(process)
    require(code == 3 and "--restart" in message and "internal" not in message, f"full disk: {code}, {message}")
    require(not list(run.rglob("*.partial")), "a file that could not be written takes room")
    (run / "checkpoint" / "checkpoint.00000001.h5.0123abcd.partial").write_text("half")
    require(finish(start("--restart", run))[0] == 0, "the restart fails")
    require(not list(run.rglob("*.partial")), "what a killed run leaves is not removed")
    require((run / "history.csv").read_bytes() == (whole / "history.csv").read_bytes(), "the restart is not bitwise")


def two_ranks():
    run = FOLDER / "ranks"
    launcher = start(CASE, "-o", run, "--ranks", "2", *ENDLESS)
    wait_for(lambda: list(run.glob("checkpoint/*.h5")), "a checkpoint")
    ranks = ranks_of(launcher.pid)
    require(len(ranks) == 2, f"expected two ranks, found {ranks}")

    for arguments in (["--restart", run], [CASE, "-o", run, "--force"]):
        code, message = finish(start(*arguments))
        named = re.search(r"process (\d+) on ", message)
        require(code == 2 and named and int(named[1]) in ranks, f"second writer: {code}, {message}")

    os.kill(launcher.pid, signal.SIGKILL)
    launcher.communicate()
    wait_for(lambda: not any(map(is_alive, ranks)), "ranks to end with their launcher", 20)

    launcher = start("--restart", run, "--ranks", "2")
    goes_on(run, launcher)
    launcher.send_signal(signal.SIGINT)
    code, message = finish(launcher)
    require(code == 130, f"after SIGINT: {code}, {message}")

    launcher = start("--restart", run, "--ranks", "2")
    goes_on(run, launcher)
    for rank in ranks_of(launcher.pid):
        resource.prlimit(rank, resource.RLIMIT_FSIZE, (20000, resource.RLIM_INFINITY))
    code, message = finish(launcher)
    require(code == 3 and "--restart" in message, f"full disk: {code}, {message}")


def small_disk():
    """A disk without room for checkpoints is refused; one that is full amid the run ends it on all ranks."""
    if os.geteuid() != 0:
        print("a disk of its own is root's to mount: not tested")
        return
    disk = FOLDER / "disk"
    disk.mkdir()
    for size, more, expected, words in (("72k", (), 2, "for checkpoints, but the disk has"),
                                        ("2500k", ("--set", "output.snapshot_every='0.02 us'"), 3, "No space left on device")):
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "run_processes", disk], check=True)
        try:
            code, message = finish(start(CASE, "-o", disk / "run", "--ranks", "2", *more))
            require(code == expected and words in message, f"disk of {size}: {code}, {message}")
        finally:
            subprocess.run(["umount", "--lazy", disk], check=True)


def little_memory():
    """No limit of the address space makes a crash: too little to start is refused, too little to go on is exit code 3."""
    if "-fsanitize" in subprocess.run([WHIPPLE, "version"], capture_output=True, text=True).stdout:
        return  # sanitizers take all addresses for themselves

    def limited(megabytes):
        run = FOLDER / f"memory_{megabytes}"
        arguments = [CASE, "-o", run, "--threads", "1", "--quiet", "--set", "domain.cell_size='0.25 mm'",
                     "--set", "time.end='0.03 us'"]
        size = megabytes << 20
        result = subprocess.run([WHIPPLE, "run", *map(str, arguments)], stderr=subprocess.PIPE, text=True, timeout=120,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))
        return result.returncode, result.stderr

    code, message = limited(250)
    require(code == 3 and "ulimit -v" in message, f"too little to start: {code}, {message}")
    for megabytes in (301, 304, 312):
        code, message = limited(megabytes)
        require(code == 0 or code == 3 and "memory" in message, f"{megabytes} MB: {code}, {message}")


def steered():
    """A run on two ranks is paused, goes on, is asked nonsense and ends, from another process; then it is restarted."""
    run = FOLDER / "group" / "steered"  # whipple status searches at any depth
    launcher = start(CASE, "-o", run, "--ranks", "2", *ENDLESS)

    def steer(*request):
        return subprocess.run([WHIPPLE, "steer", run, *request], capture_output=True, text=True)

    def status():
        return json.loads((run / "status.json").read_text())

    def answers():
        file = run / "steering.csv"
        return list(csv.DictReader(file.open(newline=""))) if file.exists() else []

    wait_for(lambda: (run / "history.csv").exists(), "the history")
    goes_on(run, launcher)
    require(status()["state"] == "running", f"status of a run that goes on: {status()}")
    asked = steer("pause")
    require(asked.returncode == 0 and "accepted" in asked.stdout, f"a request is refused: {asked}")
    wait_for(lambda: status()["state"] == "paused", "the pause")
    step = status()["step"]
    time.sleep(1.2)
    require(last_step(run) == step and status()["step"] == step, "a paused run makes steps")
    require(steer("snapshots").returncode == 2 and not list(run.glob("control/*")), "a bad request is not refused")
    (run / "control" / "bad.toml").write_text("request = 'nothing'")
    wait_for(lambda: len(answers()) == 2, "the answer to a bad request")
    asked = steer("end", "1e-15 s")  # long past
    require(asked.returncode == 2 and "already" in asked.stderr, f"what a run refuses is not told: {asked}")
    require(steer("resume").returncode == 0, "a request is refused")
    goes_on(run, launcher)
    listed = subprocess.run([WHIPPLE, "status", FOLDER], capture_output=True, text=True).stdout
    require(re.search(r"steered +running", listed), f"whipple status: {listed}")
    require(steer("end").returncode == 0, "a request is refused")
    code, message = finish(launcher)
    require(code == 0 and status()["state"] == "done", f"ended by request: {code}, {message}, {status()}")
    results = [row["answer"] for row in answers()]
    require(results == ["accepted", "refused", "refused", "accepted", "accepted"], f"answers: {answers()}")
    require(steer("snapshot").returncode == 2, "a run that has ended takes requests")
    before = last_step(run)
    require(finish(start("--restart", run))[0] == 0 and last_step(run) == before, "the end is not that of the restart")
    code, message = finish(start("--restart", run, "--set", "time.end='1e-15 s'"))
    require(code == 2 and "already" in message, f"an end before the present time is accepted: {code}, {message}")


def a_rank_without_particles():
    """All matter on one rank: the other one takes part in every sum, that of the summary included."""
    block = pathlib.Path(__file__).resolve().parents[1] / "data/thrown_block.toml"
    code, message = finish(start(block, "--output", FOLDER / "one_block", "--ranks", "2"))
    require(code == 0, f"a rank without particles: {code}, {message}")


def molecular_dynamics():
    launcher = subprocess.Popen([WHIPPLE, "md", PLAN, "-o", FOLDER / "store.md.h5", "--ranks", "2", "--quiet"],
                                stderr=subprocess.PIPE, text=True)
    ranks = []

    def started():
        ranks[:] = ranks_of(launcher.pid, "whipple-md")
        return len(ranks) == 2

    wait_for(started, "two ranks")
    launcher.send_signal(signal.SIGTERM)
    code, message = finish(launcher)
    require(code == 143, f"whipple md after SIGTERM: {code}, {message}")
    wait_for(lambda: not any(map(is_alive, ranks)), "ranks to end", 20)


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    one_rank()
    two_ranks()
    small_disk()
    little_memory()
    steered()
    a_rank_without_particles()
    molecular_dynamics()
    shutil.rmtree(FOLDER)


if __name__ == "__main__":
    main()
