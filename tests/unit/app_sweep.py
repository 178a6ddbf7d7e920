#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Studies by the program: a study killed at random moments ends with the table of the undisturbed one, and computes no
finished point again; failed points are listed and stop nothing; one study at a time in a folder; limits with known answers.

Usage: app_sweep.py WHIPPLE CASE.toml FOLDER [POINTS]
"""
import csv
import json
import math
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
                           ("", "nothing varies")):
        folder = FOLDER / "wrong"
        message = sweep(study("wrong", text), folder, code=2).stderr
        require(expected in message and not folder.exists(), f"{text}: {message}")
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


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for test in (inputs, limits, one_at_a_time, interrupted):
        begin = time.monotonic()
        test()
        print(f"{test.__name__}: {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    main()
