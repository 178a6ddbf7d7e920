#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Disturbs runs and lets them go on; the ends are compared with those of undisturbed runs: bitwise on one rank, to
round-off on several.

Usage: torture.py WHIPPLE CASE.toml FOLDER [--ranks 1] [--runs 40] [--kills 3] [--seed 1]
       torture.py WHIPPLE CASE.toml FOLDER [--ranks 1] --disks 10
       torture.py WHIPPLE CASE.toml FOLDER [--ranks 1] --writers 20
       torture.py WHIPPLE PLAN.toml FOLDER [--ranks 1] --md [--runs 40] [--kills 3]
Default: SIGKILL again and again; on ranks the launcher is killed or one of the ranks, at random. --disks: so many file
systems (tmpfs, which only root may mount) that are too small for the run, and grow before the restart. --writers: so
often a second process wants to write into the folder of a run. --md: kills whipple md, whose store must come to the bytes
of an undisturbed one.
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
import tomllib

OPTIONS = ["--threads", "1", "--quiet"]
MARK = ".torture"  # lies in the folders that this script made
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


def rows_of(run):
    """Rows of the history of a run, without its head and what is half written."""
    try:
        return max((run / "history.csv").read_bytes().count(b"\n") - 1, 0)
    except FileNotFoundError:
        return 0


def wait_for_a_moment(process, run, whole, kills_left, seconds):
    """Waits for a moment of what is left of a run, so that the kills to come find something left too; now and then for one
    of its start. Steps count, for the time of a step and of the start depends on who else uses the machine."""
    if random.random() < 0.2:
        time.sleep(random.uniform(0.0, 0.3) * seconds)
        return
    rows, all_rows = rows_of(run), rows_of(whole)
    row = rows + random.uniform(0.0, 1.0) * (all_rows - rows) / kills_left
    while process.poll() is None and rows_of(run) < row:
        time.sleep(0.003)
    time.sleep(random.uniform(0.0, 2.0) * seconds / max(all_rows, 1))


def disturbed(whipple, case, run, ranks, kills, seconds, whole):
    """Runs a case to its end through so many kills; returns how often it was killed while it ran."""
    killed = 0
    for attempt in range(kills + 1):
        # A run that had no checkpoint yet starts over, as a user would have it.
        goes_on = list(run.glob("checkpoint/checkpoint.*.h5"))
        call = ["run", "--restart", run] if goes_on else ["run", case, "-o", run, "--force"]
        process = subprocess.Popen([whipple, *command(call, ranks)], stderr=subprocess.PIPE, text=True)
        if attempt < kills:
            wait_for_a_moment(process, run, whole, kills - attempt, seconds)
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


def ended(call, seconds=120):
    """The process when it has ended, nothing if it does not end: it is killed, and its ranks with it."""
    try:
        return subprocess.run(call, stderr=subprocess.PIPE, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return None


def on_a_full_disk(whipple, case, run, ranks, size):
    """Runs a case on a disk of so many bytes, which is full before its end; returns what is wrong."""
    run.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "torture", run], check=True)
    try:
        result = ended([whipple, *command(["run", case, "-o", run / "run"], ranks)])
        if result is None:
            return [f"{run}: no end"]
        began = list(run.glob("run/checkpoint/checkpoint.*.h5"))
        # No step was made: a fault of the input; later: the run stops, and can go on.
        if result.returncode not in ((3,) if began else (2, 3)) or "No space left" not in result.stderr:
            return [f"{run}: exit code {result.returncode}: {result.stderr}"]
        if began and "--restart" not in result.stderr:
            return [f"{run}: the message does not name the restart: {result.stderr}"]
        left = [f"{run}: {path} is left" for path in run.rglob("*.partial")]
        print(f"{size:9} bytes: exit code {result.returncode}, {'goes on' if began else 'begins again'}", flush=True)
        subprocess.run(["mount", "-o", "remount,size=1g", run], check=True)
        call = ["run", "--restart", run / "run"] if began else ["run", case, "-o", run / "run", "--force"]
        again = ended([whipple, *command(call, ranks)])
        if again is None:
            return [*left, f"{run}: restart: no end"]
        if again.returncode != 0:
            return [*left, f"{run}: restart: exit code {again.returncode}: {again.stderr}"]
        shutil.copytree(run / "run", run.with_suffix(".end"))
        return left
    finally:
        subprocess.run(["umount", "--lazy", run], check=True)


def two_writers(whipple, case, run, ranks):
    """Starts a second run or a restart in the folder of a run that goes on; returns what is wrong."""
    endless = ["run", case, "-o", run, "--set", "time.end='1 s'"]
    first = subprocess.Popen([whipple, *command(endless, ranks)], stderr=subprocess.PIPE, text=True)
    while first.poll() is None and not list(run.glob("checkpoint/checkpoint.*.h5")):
        time.sleep(0.01)
    call = random.choice((["run", "--restart", run], ["run", case, "-o", run, "--force"]))
    second = subprocess.run([whipple, *command(call, ranks)], stderr=subprocess.PIPE, text=True, timeout=300)
    faults = []
    if second.returncode != 2 or "process " not in second.stderr:
        faults.append(f"{run}: second writer: exit code {second.returncode}: {second.stderr}")
    first.send_signal(signal.SIGINT)
    message = first.communicate(timeout=300)[1]
    if first.returncode != 130:
        faults.append(f"{run}: first writer: exit code {first.returncode}: {message}")
    return faults


def killed_plan(whipple, plan, store, ranks, kills, seconds):
    """Computes a plan through so many kills of the launcher or a rank; returns how often it was killed, and what is wrong."""
    killed = 0
    for attempt in range(kills + 1):
        process = subprocess.Popen([whipple, "md", plan, "-o", store, "--quiet", "--ranks", str(ranks)],
                                   stderr=subprocess.PIPE, text=True)
        if attempt < kills:
            time.sleep(random.uniform(0.1, 1.0) * seconds)
            victims = [process.pid] + [p for p in processes_below(process.pid) if name_of(p) == "whipple-md"]
            try:
                os.kill(random.choice(victims), signal.SIGKILL)
                killed += 1
            except ProcessLookupError:
                pass
        message = process.communicate(timeout=600)[1]
        if attempt == kills and process.returncode != 0:
            return killed, [f"{store}: exit code {process.returncode}: {message}"]
        # Lets the ranks of a killed launcher end: they hold the store.
        time.sleep(0.2)
    return killed, []


def torture_plan(options):
    """Repeats `killed_plan`; returns the exit code."""
    whole = options.folder / "whole.md.h5"
    begin = time.monotonic()
    subprocess.run([options.whipple, "md", options.case, "-o", whole, "--quiet", "--ranks", str(options.ranks)], check=True)
    seconds = time.monotonic() - begin
    kills, faults = 0, []
    for number in range(options.runs):
        store = options.folder / f"{number:03}.md.h5"
        killed, found = killed_plan(options.whipple, options.case, store, options.ranks, options.kills, seconds)
        kills += killed
        faults += found
        if not found and store.read_bytes() != whole.read_bytes():
            faults.append(f"{store}: differs from that of an undisturbed call")
        if not found:
            store.unlink()
    print(f"{options.runs} plans on {options.ranks} ranks, {kills} kills: {len(faults)} faults")
    print("\n".join(faults))
    if not faults:
        shutil.rmtree(options.folder)
    return 1 if faults else 0


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


def metres(quantity):
    """A length of run.toml, which is in metres: a number, or a text with its unit."""
    return float(str(quantity).split()[0])


def difference(run, whole):
    """Largest difference of the histories and its column, relative to the largest value of the column; of energies to the
    total, of momenta to the largest, of angular momenta to that at the distance of the domain's extent: a component may be
    round-off alone."""
    (names, found), (_, expected) = table(run / "history.csv"), table(whole / "history.csv")
    if len(found) != len(expected):
        return math.inf, "rows"
    energy = max(abs(row[names.index("total_energy [J]")]) for row in expected)
    momentum = max(abs(row[names.index(f"momentum_{axis} [kg m/s]")]) for row in expected for axis in "xyz")
    domain = tomllib.loads((whole / "run.toml").read_text(encoding="utf-8"))["domain"]
    extent = max(abs(a - b) for a, b in zip(map(metres, domain["upper"]), map(metres, domain["lower"])))
    largest = 0.0, ""
    for column, name in enumerate(names):
        if "error" in name:
            continue
        scale = max(abs(row[column]) for row in expected) or 1.0
        if name.endswith("[J]"):
            scale = energy
        elif name.endswith(("[kg m/s]", "[N s]")):
            scale = momentum
        elif name.endswith("[kg m^2/s]"):
            scale = momentum * extent
        largest = max(largest, (max(abs(a[column] - b[column]) for a, b in zip(found, expected)) / scale, name))
    return largest


def same_files(run, whole):
    """Names of the results that differ in any byte."""
    names = {path.name for folder in (run, whole) for path in folder.iterdir() if path.suffix in (".hdf", ".csv", ".series")}
    return sorted(name for name in names if not (run / name).exists() or not (whole / name).exists()
                  or (run / name).read_bytes() != (whole / name).read_bytes())


def make_folder(folder):
    """Makes the folder again. Of what is there only a folder that an earlier call made is removed.

    @raises ValueError if it is any other"""
    if os.path.lexists(folder):
        if folder.is_symlink() or not (folder / MARK).is_file():
            raise ValueError(f"{folder}: exists, and was not made by this script: name a new folder")
        shutil.rmtree(folder)
    folder.mkdir(parents=True)
    (folder / MARK).touch()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("whipple")
    parser.add_argument("case")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--disks", type=int, default=0)
    parser.add_argument("--writers", type=int, default=0)
    parser.add_argument("--md", action="store_true")
    options = parser.parse_args()
    random.seed(options.seed)
    try:
        make_folder(options.folder)
    except (ValueError, OSError) as error:
        parser.error(str(error))
    if options.md:
        return torture_plan(options)
    whole = options.folder / "whole"
    begin = time.monotonic()
    subprocess.run([options.whipple, *command(["run", options.case, "-o", whole], options.ranks)], check=True)
    seconds = time.monotonic() - begin
    size = sum(path.stat().st_size for path in whole.rglob("*"))
    kills, faults, largest = 0, [], (0.0, "")
    what = [options.whipple, options.case]
    for number in range(options.disks or options.writers or options.runs):
        run = options.folder / f"run_{number:03}"
        end = run
        if options.disks:
            found = on_a_full_disk(*what, run, options.ranks, int(size * (number + 0.2) / options.disks))
            end = run.with_suffix(".end")
        elif options.writers:
            found = two_writers(*what, run, options.ranks)
        else:
            kills += disturbed(*what, run, options.ranks, options.kills, seconds, whole)
            found = [f"{run}: {path} is left" for path in run.rglob("*.partial")]
        faults += found
        if not options.writers and end.exists():
            if options.ranks == 1:
                faults += [f"{run}: {name} differs" for name in same_files(end, whole)]
            largest = max(largest, difference(end, whole))
        for folder in {run, end}:
            shutil.rmtree(folder, ignore_errors=True)
    bound = 0.0 if options.ranks == 1 else ROUND_OFF
    if not largest[0] <= bound:
        faults.append(f"histories differ by {largest[0]:.2e} in {largest[1]}, more than {bound:.0e}")
    runs = options.disks or options.writers or options.runs
    events = "full disks" if options.disks else "second writers" if options.writers else f"{kills} kills"
    print(f"{runs} runs on {options.ranks} ranks, {events}: largest difference {largest[0]:.1e}, {len(faults)} faults")
    print("\n".join(faults))
    if not faults:
        shutil.rmtree(options.folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
