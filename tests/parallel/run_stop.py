#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Conditions of a case that end a run: each ends it at the right time and says why; ranks end together, and a run that was
interrupted ends with the history of one that was not.

Usage: run_stop.py WHIPPLE DATA FOLDER
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "unit"))

from checks import require  # noqa: E402

WHIPPLE, DATA, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
LOOK = 10  # steps


def case(name, base, conditions, changes=()):
    text = (DATA / base).read_text(encoding="utf-8")
    for former, new in changes:
        require(former in text, f"{base} has no {former}")
        text = text.replace(former, new)
    file = FOLDER / f"{name}.toml"
    file.write_text(text + "\n" + conditions, encoding="utf-8")
    return file


def run(file, name, *more, code=0):
    folder = FOLDER / name
    done = subprocess.run([WHIPPLE, "run", file, "-o", folder, "--threads", "1", "--quiet", *more], capture_output=True,
                          text=True, timeout=60)
    require(done.returncode == code, f"{name}: {done.returncode} {done.stderr}")
    return folder, done.stderr


def ending(folder):
    status = json.loads((folder / "status.json").read_text())
    require(status["state"] == "done" and status["ended_by"] and status["ended_by"] in status["message"], status)
    require(status["ended_by"] in (folder / "log.txt").read_text(), "log.txt does not say why")
    snapshots = json.loads(next(folder.glob("*.particles.hdf.series")).read_text())["files"]
    require(snapshots[-1]["time"] == status["time"], "no snapshot of the end")
    with open(folder / "history.csv", newline="") as file:
        times = [float(row["time [s]"]) for row in csv.DictReader(file)]
    require(times[-1] == status["time"], "no row of the end")
    return status, times


def on_time(name, folder, exact, words):
    """A condition that holds from a time on is seen within ten steps, and ends the run after one more."""
    status, times = ending(folder)
    require(words in status["ended_by"], status)
    steps = sum(time > exact for time in times)
    require(2 <= steps <= LOOK + 1, f"{name}: ended {steps} steps after {exact} s")


def conditions():
    block = 'when = "{}"\n{}\n'
    # Thrown with 200 m/s against 1e8 m/s^2: 100 m/s after 1 us, a quarter of the energy likewise.
    slow = case("slow", "thrown_block.toml", "[[stop]]\n" + block.format("speed_below", 'body = "block"\nspeed = "100 m/s"'))
    folder, _ = run(slow, "slow")
    on_time("speed", folder, 1e-6, 'body "block" is slower than 100 m/s')
    with open(folder / "history.csv", newline="") as file:
        energy = float(next(csv.DictReader(file))["kinetic_energy [J]"])
    weak = case("weak", "thrown_block.toml", "[[stop]]\n" + block.format("energy_below", f'body = "block"\nenergy = "{energy / 4} J"'))
    on_time("energy", run(weak, "weak")[0], 1e-6, "kinetic energy")
    # A body that begins below the limit must have been above it: the block falls again, from 2 us on, and never is.
    low = case("low", "thrown_block.toml", "[[stop]]\n" + block.format("speed_below", 'body = "block"\nspeed = "250 m/s"'))
    status = json.loads((run(low, "low")[0] / "status.json").read_text())
    require(status["ended_by"] == "" and status["time"] == 3e-6, status)
    # The mass does not change: it has settled once the window has passed; `after` delays that.
    text = block.format("settled", 'column = "mass"\nchange = 0.01\nover = "0.5 us"')
    on_time("settled", run(case("settled", "thrown_block.toml", "[[stop]]\n" + text), "settled")[0], 0.5e-6, "mass has settled")
    text += 'after = "1.5 us"\n'
    on_time("after", run(case("late", "thrown_block.toml", "[[stop]]\n" + text), "late")[0], 1.5e-6, "mass has settled")
    text = "[[stop]]\n" + block.format("wall_time", 'wall_time = "1 ms"')
    status, times = ending(run(case("clock", "thrown_block.toml", text), "clock")[0])
    require(status["time"] < 3e-6 and "has taken" in status["ended_by"], status)


def perforation():
    wider = [('upper = ["4 mm", "4 mm", "4 mm"]', 'upper = ["4 mm", "4 mm", "8 mm"]'), ('end = "0.5 us"', 'end = "5 us"'),
             ('snapshot_every = "0.02 us"', 'snapshot_every = "0.5 us"'), ('checkpoint_every = "1 ms"', "")]
    file = case("plate", "small_impact.toml", '[[stop]]\nwhen = "perforated"\nbody = "plate"\n', wider)
    ends = []
    for ranks in (1, 2):
        folder, _ = run(file, f"plate{ranks}", "--ranks", str(ranks))
        status, times = ending(folder)
        require(status["ended_by"] == 'body "plate" is perforated', status)
        require(1e-6 == times[-2] < status["time"], f"ended at {times[-2:]}, one step after the snapshot at 1 us")
        ends.append(status["step"])
    require(ends[0] == ends[1], f"steps on one rank and two: {ends}")
    text = '[[stop]]\nwhen = "speed_below"\nbody = "ball"\nspeed = "1.8 km/s"\n'
    text += '[[stop]]\nwhen = "settled"\ncolumn = "mass"\nchange = 0.1\nover = "4 us"\n'
    file = case("ball", "small_impact.toml", text, wider)
    ends = [ending(run(file, f"ball{ranks}", "--ranks", str(ranks))[0])[0] for ranks in (1, 2)]
    require(ends[0]["step"] == ends[1]["step"] and "slower" in ends[0]["ended_by"], ends)
    done = subprocess.run([WHIPPLE, "analyse", FOLDER / "plate1", "--json", "--quiet"], capture_output=True, text=True)
    require(json.loads(done.stdout)["perforated.plate"]["value"] == 1.0, done)


def outcome_of(folder):
    done = subprocess.run([WHIPPLE, "shield", folder, "--outcome", "--body", "plate", "--json", "--quiet"], capture_output=True, text=True)
    require(done.returncode == 0, done.stderr)
    return json.loads(done.stdout)


def outcome():
    stop = '[[stop]]\nwhen = "decided"\nbody = "plate"\n'
    faster = [('upper = ["4 mm", "4 mm", "4 mm"]', 'upper = ["4 mm", "4 mm", "8 mm"]'), ('end = "0.5 us"', 'end = "5 us"'),
              ('snapshot_every = "0.02 us"', 'snapshot_every = "0.5 us"\nfields = ["density", "failed", "plastic_strain"]'),
              ('checkpoint_every = "1 ms"', "")]
    file = case("struck", "small_impact.toml", stop, faster)
    for ranks in (1, 2):
        folder, _ = run(file, f"struck{ranks}", "--ranks", str(ranks))
        status, times = ending(folder)
        require(status["ended_by"] == 'the outcome of body "plate" is decided' and times[-2] == 1e-6, (status, times[-2:]))
        found = outcome_of(folder)
        require(found["outcome"] == "perforated" and found["defeated"] and found["time"] == 1e-6, found)
    # Slower the plate holds. That is known only after the past that a restart must not forget.
    slower = [*faster, ("2 km/s", "0.2 km/s"), ('"8 mm"]', '"16 mm"]'), ('end = "5 us"', 'end = "200 us"'), ('"0.5 us"\nfields', '"5 us"\nfields')]
    file = case("held", "small_impact.toml", stop, slower)
    whole, _ = run(file, "held")
    found = outcome_of(whole)
    require(found["outcome"] in ("bulge", "whole") and not found["defeated"] and ending(whole)[0]["time"] < 200e-6, found)
    part = FOLDER / "held_part"
    command = [WHIPPLE, "run", file, "-o", part]
    for stops in range(5):
        limit = ["--wall-time", "0.3 s"] if stops < 3 else []
        done = subprocess.run([*command, "--threads", "1", "--quiet", *limit], capture_output=True, text=True)
        if done.returncode != 124:
            break
        command = [WHIPPLE, "run", "--restart", part]
    require(done.returncode == 0 and stops > 0, f"{done.returncode} after {stops} stops: {done.stderr}")
    require(ending(part)[0]["step"] == ending(whole)[0]["step"] and outcome_of(part) == found, "another end after restarts")


def interrupted():
    text = """
[[stop]]
when = "settled"
column = "momentum_y"
change = 0.12
over = "0.15 us"
after = "1 us"
[[stop]]
when = "speed_below"
body = "block"
speed = "40 m/s"
"""
    file = case("whole", "thrown_block.toml", text)
    whole, _ = run(file, "whole")
    part = FOLDER / "part"
    command = [WHIPPLE, "run", file, "-o", part]
    for stops in range(4):
        limit = ["--wall-time", "0.004 s"] if stops < 3 else []  # a few steps
        done = subprocess.run([*command, "--threads", "1", "--quiet", *limit], capture_output=True, text=True)
        if done.returncode != 124:
            break
        command = [WHIPPLE, "run", "--restart", part]
    require(done.returncode == 0 and stops > 0, f"{done.returncode} after {stops} stops: {done.stderr}")
    require(ending(part)[0]["ended_by"] == ending(whole)[0]["ended_by"], "another reason")
    require((part / "history.csv").read_bytes() == (whole / "history.csv").read_bytes(), "another history")
    print(f"{stops} restarts")


def restarted():
    """A run that a condition ended has ended, unless the case no longer has that condition."""
    block = '[[stop]]\nwhen = "speed_below"\nbody = "block"\nspeed = "100 m/s"\n'
    clock = '[[stop]]\nwhen = "wall_time"\nwall_time = "1 ms"\n'
    for name, text, words in (("again", block, "slower than 100 m/s"), ("again_clock", clock, "has taken")):
        folder, _ = run(case(name, "thrown_block.toml", text), name)
        before = {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in folder.rglob("*") if path.is_file()}
        for ranks in ([], ["--ranks", "2"]):
            again = subprocess.run([WHIPPLE, "run", "--restart", folder, *ranks], capture_output=True, text=True, timeout=60)
            require(again.returncode == 0 and "has ended because" in again.stderr and words in again.stderr, again)
            now = {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in folder.rglob("*") if path.is_file()}
            require(now == before, "the restart has written something")
    # Killed after its last checkpoint, before its last status: the restart makes no step and completes the outputs.
    folder, reason = FOLDER / "again", json.loads((FOLDER / "again/status.json").read_text())
    (folder / "status.json").write_text(json.dumps({**reason, "state": "running", "ended_by": "", "message": ""}))
    subprocess.run([WHIPPLE, "run", "--restart", folder, "--quiet"], check=True, timeout=60)
    status = ending(folder)[0]
    require((status["step"], status["ended_by"]) == (reason["step"], reason["ended_by"]), status)
    # Another condition, or none, lets it go on.
    words = ["--set", "stop.0.speed=50 m/s"]
    subprocess.run([WHIPPLE, "run", "--restart", folder, "--quiet", *words], check=True, timeout=60)
    on_time("changed", folder, 1.5e-6, 'body "block" is slower than 50 m/s')
    subprocess.run([WHIPPLE, "run", "--restart", folder, "--quiet", "--set", "stop=[]"], check=True, timeout=60)
    status = json.loads((folder / "status.json").read_text())
    require((status["state"], status["ended_by"], status["time"]) == ("done", "", 3e-6), status)


def faults():
    for text, expected in (('when = "perforated"', "needs 'body'"), ('when = "speed_below"\nbody = "block"', "needs 'speed'"),
                           ('when = "wall_time"\nwall_time = "1 s"\nspeed = "1 m/s"', "does not belong"),
                           ('when = "perforated"\nbody = "block"', "output.snapshot_every"),
                           ('when = "decided"\nbody = "block"', "output.snapshot_every"),
                           ('when = "perforated"\nbody = "blocks"', 'no body "blocks"'),
                           ('when = "settled"\ncolumn = "mas"\nchange = 0.1\nover = "1 us"', 'did you mean "mass"')):
        message = run(case("wrong", "thrown_block.toml", "[[stop]]\n" + text), "wrong", code=2)[1]
        require(expected in message and not (FOLDER / "wrong").exists(), f"{text}: {message}")
    # The column is at fault where it stands; all columns are listed.
    lines = len((FOLDER / "wrong.toml").read_text().splitlines())
    place = f"{FOLDER / 'wrong.toml'}:{lines - 2}:10: error: 'column'"
    require(message.startswith(place) and "accepted: step, time, dt," in message, message)
    found = subprocess.run([WHIPPLE, "check", FOLDER / "wrong.toml", "--json"], capture_output=True, text=True)
    [fault] = json.loads(found.stdout)["faults"]
    require(found.returncode == 2 and (fault["key"], fault["line"]) == ("stop.0.column", lines - 2), fault)


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for test in (faults, conditions, restarted, perforation, outcome, interrupted):
        test()


if __name__ == "__main__":
    main()
