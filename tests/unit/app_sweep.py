#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Studies by the program: a study killed at random moments ends with the table of the undisturbed one, and computes no
finished point again; failed points are listed and stop nothing; one study at a time in a folder; limits with known answers.

Usage: app_sweep.py WHIPPLE CASE.toml FOLDER [POINTS [TEST ...]]
"""
import csv
import json
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

from checks import require, wait_for

WHIPPLE, CASE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
POINTS = int(sys.argv[4]) if len(sys.argv) > 4 else 5
GRAVITY, START = 1e8, 0.125e-3  # m/s^2; m, of the particle that the gauge follows


def study(name, text):
    file = FOLDER / f"{name}.toml"
    file.write_text(f'case = "{CASE}"\n{text}', encoding="utf-8")
    return file


def command(file, folder, *more):
    return [WHIPPLE, "sweep", file, "-o", folder, "--no-figures", *more]


def sweep(file, folder, *more, code=0):
    done = subprocess.run(command(file, folder, *more), capture_output=True, text=True, timeout=500)
    require(done.returncode == code, f"{file} {more}: {done.returncode} {done.stdout} {done.stderr}")
    return done


def rows(folder, table="points"):
    """Rows without the time that a point took."""
    with open(folder / f"{table}.csv", newline="", encoding="utf-8") as file:
        return [{key: value for key, value in row.items() if key != "wall_time [s]"} for row in csv.DictReader(file)]


def records(folder):
    return {file.name: file.stat().st_mtime_ns for file in (folder / "points").glob("*.json")}


QUANTITIES = """
[[quantity]]
name = "gauge.middle.y"
take = "largest"
[[quantity]]
name = "history.kinetic_energy"
"""


def interrupted():
    speeds = ", ".join(f'"{100 + 10 * i} m/s"' for i in range(POINTS))
    # The last value of the second key lets every run leave its range: exit code 3.
    text = f"""
[[vary]]
key = "body.0.velocity.1"
values = [{speeds}]
[[vary]]
key = "output.maximum_speed_factor"
values = ["10", "0.5"]
[run]
jobs = 2
""" + QUANTITIES
    file, whole, killed = study("grid", text), FOLDER / "whole", FOLDER / "killed"
    sweep(file, whole)
    rng, kept, kills = random.Random(7), {}, 0
    while True:
        process = subprocess.Popen(command(file, killed, "--quiet"), stderr=subprocess.PIPE, text=True)
        try:
            process.wait(timeout=0.2 + rng.random())
        except subprocess.TimeoutExpired:
            process.send_signal(rng.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT]))
            process.wait(timeout=100)
            kills += 1
            now = records(killed)
            require(kept.items() <= now.items(), "a finished point was computed again")
            kept = now
            if kills < 4:
                continue
            sweep(file, killed)
        break
    now = records(killed)
    require(kept.items() <= now.items(), "a finished point was computed again")
    require(kills > 0 and len(now) == 2 * POINTS, f"{kills} kills, {len(now)} points")
    require(rows(whole) == rows(killed), "another table than that of the undisturbed study")
    for row in rows(whole):
        speed = float(row["body.0.velocity.1 [m/s]"])
        if row["output.maximum_speed_factor"] == "0.5":
            require(row["state"] == "failed" and row["exit_code"] == "3" and "maximum_speed_factor" in row["message"], row)
        else:
            height = float(row["largest gauge.middle.y [m]"]) - START
            require(row["state"] == "done" and abs(height / (speed**2 / 2 / GRAVITY) - 1) < 3e-2, row)
    before = records(whole)
    again = sweep(file, whole)
    require("0 of them computed now" in again.stderr and records(whole) == before, again.stderr)
    import h5py
    with h5py.File(whole / "study.h5") as h5:
        require(list(h5["points/history.kinetic_energy"])[-2] == float(rows(whole)[-2]["history.kinetic_energy [J]"]), "HDF5")
        require(h5["points/history.kinetic_energy"].attrs["unit"] == "J", "unit")


def one_at_a_time():
    file = study("lock", '[[vary]]\nkey = "body.0.velocity.1"\nrange = ["100 m/s", "300 m/s"]\ncount = 60\n[run]\njobs = 1\n' + QUANTITIES)
    folder = FOLDER / "lock"
    process = subprocess.Popen(command(file, folder), stderr=subprocess.PIPE, text=True)
    wait_for(lambda: (folder / "points").is_dir(), "the first point")
    refused = sweep(file, folder, code=2)
    require("process" in refused.stderr, refused.stderr)
    process.terminate()
    process.wait(timeout=100)
    require(process.returncode == 128 + signal.SIGTERM, f"ended with {process.returncode}")
    other = study("other", '[[vary]]\nkey = "time.end"\nvalues = ["1 us"]\n' + QUANTITIES)
    require("is the folder of the study" in sweep(other, folder, code=2).stderr, "two studies in one folder")


def limits():
    # The kinetic energy after 1 us, of 4 mm^2 of copper per metre at the speed v - g t.
    exact = 223.6
    energy = 0.5 * 4e-6 * 8930.0 * (exact - GRAVITY * 1e-6)**2

    def interval(tolerance, quantity, bands):
        file = study("limit", f"""
[[vary]]
key = "time.end"
values = ["1 us"]
[find]
key = "body.0.velocity.1"
between = ["0.1 km/s", "300 m/s"]
{quantity}
tolerance = "{tolerance} m/s"
[bands]
{bands}
""")
        sweep(file, FOLDER / "limit")
        [row] = rows(FOLDER / "limit", "limits")
        require(row["verdict"] == "found", row)
        return 1e3 * float(row["lower [km/s]"]), 1e3 * float(row["upper [km/s]"])

    for tolerance in (20.0, 1.0):
        lower, upper = interval(tolerance, f'quantity = "history.kinetic_energy"\ncrosses = "{energy} J"', "offsets = [0.3]")
        require(lower < exact < upper <= lower + tolerance + 1e-9, f"{exact} m/s: {lower} to {upper}")
    # Particles of other cells begin elsewhere, that of the gauge included: the interval of both holds that of each.
    height = 'quantity = "gauge.middle.y"\ntake = "largest"\ncrosses = "0.25 mm"'
    each = [interval(4.0, height, f'cell_sizes = ["{size} mm"]') for size in (0.5, 0.4)]
    both = interval(4.0, height, 'cell_sizes = ["0.5 mm", "0.4 mm"]')
    require(both == (min(a for a, _ in each), max(b for _, b in each)) and each[0] != each[1], f"{each}: {both}")
    # The height at the end, over the end: up and down again. A step moves particles by the velocity at its end, so that
    # heights are lower by g t dt / 2.
    speed = 150.0 - 0.5 * GRAVITY * 4.4e-8
    up = [(speed - sign * math.sqrt(speed**2 - 2 * GRAVITY * 0.09e-3)) / GRAVITY for sign in (1, -1)]
    file = study("twice", f"""
[find]
key = "time.end"
between = ["0.1 us", "2.8 us"]
scan = 4
quantity = "gauge.middle.y"
crosses = "{1e3 * START + 0.09} mm"
tolerance = "0.1 us"
[[vary]]
key = "body.0.velocity.1"
values = ["150 m/s"]
""")
    done = sweep(file, FOLDER / "twice")
    [row] = rows(FOLDER / "twice", "limits")
    words = row["verdict"].removeprefix("not monotone: the verdict changes at ").split(", ")
    changes = [tuple(1e-6 * float(part) for part in word.split(" to ")) for word in words]
    require(len(changes) == 2 and all(a < t < b for (a, b), t in zip(changes, up)), f"{up}: {row}")
    require("not monotone" in done.stdout, done.stdout)


def inputs():
    study_text = '[[vary]]\nkey = "domain.cell_sizes"\nvalues = ["1 mm"]\n'
    for text, expected in ((study_text, "cell_sizes"), ('[[vary]]\nkey = "time.end"\n', "expected one of 'values'"),
                           ('[[vary]]\nkey = "time.end"\nvalues = ["1 us"]\n[[quantity]]\nname = "history.momentun_x"\n', "momentum_x"),
                           ('[[vary]]\nkey = "time.end"\nvalues = ["1 us"]\n[[quantity]]\nname = "gauge.middle.velocity_q"\n', "gauge.middle.velocity_"),
                           ('[find]\nkey = "time.end"\nbetween = ["1 us", "2 us"]\nquantity = "gauge.middle.y"\ncrosses = "3 kg"\n'
                            'tolerance = "0.5 us"\n', "find.crosses"),
                           ("", "nothing varies")):
        folder = FOLDER / "wrong"
        message = sweep(study("wrong", text), folder, code=2).stderr
        require(expected in message and not folder.exists(), f"{text}: {message}")
    # Faults of a point name the key in the study and the file that it changes, which is no temporary one.
    for key, value, expected in (("body.0.material.eos.gruneisen", "-1 kg", "copper_ofhc_mie_gruneisen.toml"),
                                 ("body.0.material.eos.gruneise", "2", "unknown key"),
                                 ("body.0.velocity.1", "2 kg", "thrown_block.toml")):
        file = study("wrong", f'[[vary]]\nkey = "time.end"\nvalues = ["1 us"]\n[[vary]]\nkey = "{key}"\nvalues = ["{value}"]\n')
        message = sweep(file, folder, code=2).stderr
        require(message.startswith(f"{file}:6:7: error: '{key}' = ") and expected in message and "/whipple_" not in message
                and message.count("error") == 1, message)
    material = '[[vary]]\nkey = "body.0.material"\nvalues = ["copper", "aluminium_1100"]\n'
    for text, expected in ((material + '[[vary]]\nkey = "body.0.material.eos.gruneisen"\nvalues = ["2"]\n', "which varies as a whole"),
                           ('[[vary]]\nkey = "domain.upper.0"\nvalues = ["2 mm"]\n[bands]\noffsets = [0, 0.5]\n', "domain.upper.0")):
        message = sweep(study("wrong", text), folder, code=2).stderr
        require(expected in message and not folder.exists(), message)
    file = study("samples", """
[[vary]]
key = "body.0.velocity.1"
range = ["100 m/s", "200 m/s"]
[[vary]]
key = "body.0.material.eos.reference_density"
range = ["8.8 g/cm^3", "9 g/cm^3"]
[sample]
count = 6
""" + QUANTITIES)
    sweep(file, FOLDER / "samples")
    tables = json.loads(sweep(file, FOLDER / "samples", "--json", "--quiet").stdout)
    require([row["state"] for row in tables["points"]["rows"]] == 6 * ["done"], tables["points"])
    velocity, density = "body.0.velocity.1", "body.0.material.eos.reference_density"
    for row in tables["points"]["rows"]:
        # Kinetic energy at the end: of the mass, 4 mm^2 per metre, at the speed v - g t.
        exact = 0.5 * 4e-6 * 1e3 * row[density] * (row[velocity] - GRAVITY * 3e-6)**2
        require(abs(row["history.kinetic_energy"] / exact - 1) < 2e-2, f"{exact}: {row}")
    text = sweep(file, FOLDER / "array", "--slurm", "--time=10").stdout
    require("--array=0-5" in (FOLDER / "array/array.sh").read_text() and "sbatch" in text, text)
    sweep(file, FOLDER / "array", "--point", "3")
    require(len(records(FOLDER / "array")) == 1, "one task, one point")
    for words in (["swep", "--help"], ["swep"]):
        done = subprocess.run([WHIPPLE, *words], capture_output=True, text=True)
        require(done.returncode == 2 and "did you mean" in done.stderr and "sweep" in done.stderr, f"{words}: {done}")


def children(process):
    """Processes that a process has started, and their arguments."""
    for file in pathlib.Path(f"/proc/{process.pid}/task").glob("*/children"):
        for pid in file.read_text().split():
            yield int(pid), pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")


def child(process, word, other_than=0):
    """Wait for a child with a word among its arguments, and return its number."""
    found = []

    def look():
        try:
            found[:] = [pid for pid, words in children(process) if word in words and pid != other_than]
        except OSError:  # it has just ended
            return False
        return bool(found)
    wait_for(look, f"a child with {word}")
    return found[0]


SLOW = '[[vary]]\nkey = "domain.cell_size"\nvalues = ["0.2 mm"]\n'  # some tenths of a second a point


def slow_study(name, points, more=""):
    speeds = ", ".join(f'"{100 + 10 * i} m/s"' for i in range(points))
    return study(name, f'[[vary]]\nkey = "body.0.velocity.1"\nvalues = [{speeds}]\n{SLOW}[run]\njobs = 1\n{more}' + QUANTITIES)


def ended_points():
    """A crash is a failure with its name; a point that is killed is computed by the next call; a program that cannot be
    started ends the study."""
    file, folder = slow_study("ends", 3), FOLDER / "ends"
    process = subprocess.Popen(command(file, folder), stderr=subprocess.PIPE, text=True)
    last = 0
    for number in (signal.SIGSEGV, signal.SIGKILL, signal.SIGHUP):
        last = child(process, b"run", last)
        os.kill(last, number)
    message = process.communicate(timeout=100)[1]
    require(process.returncode == 3 and "2 points were ended from outside" in message, f"{process.returncode} {message}")
    states = [(row["state"], row["exit_code"]) for row in rows(folder)]
    require(states == [("failed", "139"), ("missing", "0"), ("missing", "0")], states)
    require("crashed by SIGSEGV" in rows(folder)[0]["message"], rows(folder)[0])
    kept = records(folder)
    require("2 of them computed now" in sweep(file, folder).stderr and kept.items() <= records(folder).items(), "again")
    require([row["state"] for row in rows(folder)] == ["failed", "done", "done"], rows(folder))
    sweep(file, folder, "--retry")
    require([row["state"] for row in rows(folder)] == 3 * ["done"], rows(folder))
    program, folder = FOLDER / "whipple", FOLDER / "gone"
    os.link(WHIPPLE, program)
    process = subprocess.Popen([program, *command(slow_study("gone", 2), folder)[1:]], stderr=subprocess.PIPE, text=True)
    child(process, b"run")
    program.unlink()
    message = process.communicate(timeout=100)[1]
    require(process.returncode == 2 and "cannot start" in message and str(program) in message, f"{process.returncode} {message}")


def measured_later():
    """Measures, and options of their analysis, that are added to a finished study are measured from its runs."""
    text = '[[vary]]\nkey = "time.end"\nvalues = ["0.5 us", "1 us"]\n[run]\njobs = 1\n{}[[quantity]]\nname = "history.mass"\n'
    measure = '[[quantity]]\nname = "piece_mass.block"\n[[quantity]]\nname = "time"\n'
    for keep in ("all", "tables"):
        folder = FOLDER / f"later_{keep}"
        file = study(f"later_{keep}", text.format(f'keep = "{keep}"\n'))
        sweep(file, folder)
        former = {path: path.stat().st_mtime_ns for path in folder.glob("points/*/history.csv")}
        require(len(former) == 2 and "time [s]" not in rows(folder)[0], rows(folder))
        for options in ("", 'analyse = ["--by-distance"]\n'):
            study(f"later_{keep}", text.format(f'keep = "{keep}"\n{options}') + measure)
            message = sweep(file, folder).stderr
            require("0 of them computed now" in message, message)
            require(all(path.stat().st_mtime_ns == time for path, time in former.items()), "a run was computed again")
            for row, end in zip(rows(folder), ("5e-07", "1e-06")):
                if keep == "all":
                    require(row["time [s]"] == end and row["message"] == "", row)
                    record = json.loads((folder / "points" / f"{row['point']}.json").read_text())
                    require(record["measured"] == (["--by-distance"] if options else []), record)
                else:  # without snapshots nothing can be measured: said by name, what the run has shown remains
                    require(row["time"] == "nan" and row["message"].startswith("not measured: "), row)
                    require(row["state"] == "done" and float(row["history.mass [kg]"]) > 0.0, row)
                    require(f"{row['point']} cannot be measured" in message, message)
        before = records(folder)
        sweep(file, folder)
        require(records(folder) == before, "measured again")


FITTED = """
name = "fitted"
source = "test"
[eos]
model = "gray"
molar_mass = "63.546 g/mol"
reference_specific_volume = "0.1118 cm^3/g"
hugoniot_intercept = "3.94 km/s"
hugoniot_slope = 1.489
gruneisen = 1.97
gruneisen_slope = 1.5
electronic_heat_coefficient = "4.9e-7 kJ/(mol K^2)"
melting_temperature = "1790 K"
vapour_attraction = "0.62 kJ cm^3/g^2"
[covariance]
names = ["hugoniot_intercept"]
units = ["m/s"]
[covariance.matrix]
hugoniot_intercept = [400.0]
"""


def holds(process, number):
    """Whether a process holds a signal back, to ask for it."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    mask = next(line for line in status.splitlines() if line.startswith("SigBlk:"))
    return bool(int(mask.split()[1], 16) >> (number - 1) & 1)


def ctrl_c():
    """A signal ends the drawing of samples, the preparation of points and the drawing of figures at once."""
    (FOLDER / "fitted.toml").write_text(FITTED, encoding="utf-8")
    text = CASE.read_text(encoding="utf-8").replace('"copper_ofhc_mie_gruneisen"', '"fitted.toml"')
    (FOLDER / "fitted_case.toml").write_text(text, encoding="utf-8")
    samples = FOLDER / "many_samples.toml"
    samples.write_text('case = "fitted_case.toml"\n[[vary]]\nkey = "body.0.material"\ncovariance = true\n[sample]\ncount = 100000\n')
    process = subprocess.Popen(command(samples, FOLDER / "many_samples"), stderr=subprocess.PIPE, text=True)
    wait_for(lambda: holds(process, signal.SIGINT), "the program's hold on signals")
    process.send_signal(signal.SIGINT)
    message = process.communicate(timeout=10)[1]
    require(process.returncode == 128 + signal.SIGINT and not (FOLDER / "many_samples").exists(), f"{process.returncode} {message}")
    temporary = FOLDER / "temporary"
    temporary.mkdir()
    many = study("many", '[[vary]]\nkey = "body.0.velocity.1"\nrange = ["100 m/s", "300 m/s"]\ncount = 90000\n' + QUANTITIES)
    for number in (signal.SIGINT, signal.SIGTERM):
        process = subprocess.Popen(command(many, FOLDER / "many"), stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "TMPDIR": str(temporary)})
        wait_for(lambda: any(temporary.iterdir()), "the preparation of points")
        process.send_signal(number)
        message = process.communicate(timeout=20)[1]
        require(process.returncode == 128 + number and "the same command goes on" in message, f"{process.returncode} {message}")
        require(not any(temporary.iterdir()) and not (FOLDER / "many").exists(), "something is left")
    python = FOLDER / "slow_python"
    python.write_text("#!/bin/sh\nexec sleep 100\n")
    python.chmod(0o755)
    file, folder = study("figures", '[[vary]]\nkey = "time.end"\nvalues = ["0.5 us"]\n' + QUANTITIES), FOLDER / "figures"
    for number in (signal.SIGINT, signal.SIGTERM):
        process = subprocess.Popen([WHIPPLE, "sweep", file, "-o", folder], stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "WHIPPLE_PYTHON": str(python)})
        drawing = child(process, b"sleep")
        process.send_signal(number)
        message = process.communicate(timeout=20)[1]
        require(process.returncode == 128 + number and "the same command goes on" in message, f"{process.returncode} {message}")
        require(not pathlib.Path(f"/proc/{drawing}").exists() and len(rows(folder)) == 1, "drawing goes on")
    sweep(file, folder)


def array():
    """Tasks of one array: one process a point; the collecting command says what is computed elsewhere."""
    file, folder = slow_study("tasks", 3), FOLDER / "tasks"
    sweep(file, folder, "--slurm", "--time=10")
    sweep(file, folder, "--point", "2")
    task = subprocess.Popen(command(file, folder, "--point", "0"), stderr=subprocess.PIPE, text=True)
    run = child(task, b"run")
    os.kill(run, signal.SIGSTOP)
    refused = sweep(file, folder, "--point", "0", code=2)
    require(f"is being computed by process {task.pid} on" in refused.stderr, refused.stderr)
    beside = sweep(file, folder, code=3).stderr
    require("1 of them computed now" in beside and f"is being computed by process {task.pid} on" in beside, beside)
    require([row["state"] for row in rows(folder)] == ["missing", "done", "done"], rows(folder))
    task.kill()  # the lock ends with it, and so does its run
    os.kill(run, signal.SIGCONT)
    task.communicate()
    sweep(file, folder, "--point", "0")
    require("0 of them computed now" in sweep(file, folder).stderr, "a point of a task was computed again")
    require([row["state"] for row in rows(folder)] == 3 * ["done"], rows(folder))
    other = study("not_its_own", '[[vary]]\nkey = "time.end"\nvalues = ["1 us"]\n' + QUANTITIES)
    require("is the folder of the study" in sweep(other, folder, "--point", "0", code=2).stderr, "a task of another study")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    chosen = sys.argv[5:]
    for test in (inputs, limits, one_at_a_time, ended_points, measured_later, ctrl_c, array, interrupted):
        if chosen and test.__name__ not in chosen:
            continue
        begin = time.monotonic()
        test()
        print(f"{test.__name__}: {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    main()
