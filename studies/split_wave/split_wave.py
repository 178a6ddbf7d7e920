#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the shock in iron split as its equation of state says? Runs iron on iron at 1.2 km/s with three cell sizes, and writes speeds,
velocities and pressures of both waves beside the exact ones into README.md; then runs at the particle velocities of record.csv up to 30 GPa,
and writes pressures behind the second wave beside the measured ones.

Usage: studies/split_wave/split_wave.py [--bin build/release/bin]
"""
import argparse
import csv
import io
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402
from studies.joint_fit.joint_fit import table  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
PAGE, CASE, RECORD = HERE / "README.md", HERE / "case.toml", HERE / "record.csv"
BEGIN, END = "<!-- table: begin -->", "<!-- table: end -->"
CELLS = ("0.2 mm", "0.1 mm", "0.05 mm")
MATERIAL = "iron_alpha_epsilon"
SPEED, DEPTH = 1200.0, 8.0e-3  # m/s, m: of the flyer, of the gauge
# Of the record: the second wave of 21.8 GPa reaches a gauge at 8 mm with the reflected first one. Runs up to the greatest pressure, Pa.
RECORD_DEPTH, RECORD_END, RECORD_MOST = 5.0e-3, "1.6 us", 30e9


def curve(whipple, *words):
    """Rows of `whipple eos hugoniot` in SI: pressure, density, phase."""
    text = call([whipple, "eos", "hugoniot", MATERIAL, *words, "--csv", "-"]).stdout
    rows = csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))
    return [(1e9 * float(row["P_GPa"]), float(row["rho_kg_m3"]), row["phase"]) for row in rows]


def second(pressure, density, state):
    """Jump of the velocity and speed relative to the material ahead of a shock from (pressure, density) to a state."""
    rise, shrink = state[0] - pressure, 1 / density - 1 / state[1]
    return math.sqrt(rise * shrink), math.sqrt(rise / shrink) / density


def exact(first, further, rest, velocity, depth=DEPTH):
    """Both waves of a piston with the given velocity: pressure, velocity and arrival at a gauge of the given depth after the impact.
    @param first    states of the Hugoniot from rest, up to beyond the transition
    @param further  states shocked from the last one of the first phase
    @param rest     density at rest"""
    pressure, density, _ = [row for row in first if row[2] == first[0][2]][-1]
    step = math.sqrt(pressure * (1 / rest - 1 / density))
    speed = math.sqrt(pressure / (1 / rest - 1 / density)) / rest
    before = None
    for state in further:
        jump, relative = second(pressure, density, state)
        if step + jump >= velocity:
            share = (velocity - before[0]) / (step + jump - before[0])
            whole = before[1] + share * (state[0] - before[1])
            ahead = step + before[2] + share * (relative - before[2])  # speed of the second wave in space
            # The gauge moves with the first wave from its arrival on.
            arrival = depth / speed
            return [(pressure, step, arrival), (whole, velocity, arrival + (depth - ahead * arrival) / (ahead - step))]
        before = (step + jump, state[0], relative)
    raise ValueError("the shocked states end below the velocity of the piston")


def measured(gauge, waves):
    """Plateaus and arrivals of both waves in the record of the gauge: mean pressure and velocity between the arrivals, and over the last
    part of the record behind the second one; arrival: half of the step of the velocity. Largest velocity behind the second wave."""
    time = [float(row["time [s]"]) for row in gauge]
    velocity = [float(row["inside.velocity_z [m/s]"]) for row in gauge]
    pressure = [float(row["inside.pressure [Pa]"]) for row in gauge]

    def arrival(level):
        i = next(i for i, v in enumerate(velocity) if v >= level)
        return time[i - 1] + (level - velocity[i - 1]) / (velocity[i] - velocity[i - 1]) * (time[i] - time[i - 1])

    first, other = arrival(0.5 * waves[0][1]), arrival(0.5 * (waves[0][1] + waves[1][1]))
    gap = other - first

    def mean(values, begin, end):
        chosen = [v for t, v in zip(time, values) if begin <= t <= end]
        return sum(chosen) / len(chosen)

    plateau = [mean(values, first + 0.3 * gap, other - 0.3 * gap) for values in (pressure, velocity)]
    behind = [mean(values, other + 0.04e-6, other + 0.16e-6) for values in (pressure, velocity)]
    return [(*plateau, first), (*behind, other)], max(velocity[i] for i, t in enumerate(time) if other <= t <= other + 0.16e-6)


def run_case(whipple, folder, name, cell, changes=()):
    """Runs the case with cells of the given size and changed texts (old, new); returns the rows of its gauge."""
    text = re.sub(r'cell_size = "[^"]*"', f'cell_size = "{cell}"', CASE.read_text(encoding="utf-8"))
    for old, new in changes:
        if old not in text:
            raise ValueError(f"{CASE}: no {old}")
        text = text.replace(old, new)
    case = folder / f"{name}{cell.replace(' ', '')}.toml"
    case.write_text(text, encoding="utf-8")
    call([whipple, "run", case, "-o", folder / case.stem, "--force", "-q"])
    with open(folder / case.stem / "gauges.csv", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def records():
    """Measured states of record.csv: particle velocity, shock velocity, pressure in SI."""
    with open(RECORD, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(1e3 * float(row["up_km_s"]), 1e3 * float(row["us_km_s"]), 1e9 * float(row["P_GPa"])) for row in rows]


def as_second_wave(wave, rest, velocity, shock):
    """Pressure behind a second wave of the given speed in space that follows the first one: P1 + rho1 (U - u1) (u - u1)."""
    pressure, ahead, _ = wave
    return pressure + rest * (shock - ahead) / (1 - ahead / (pressure / (rest * ahead))) * (velocity - ahead)


def by_arrivals(first, second_wave, rest, velocity):
    """Pressure behind both waves from their arrivals at the gauge, as in an experiment: the sum of rho0 (depth/arrival) times the step of the
    velocity. A gauge shows the pressure of single particles, 1 to 3 % of which is frozen noise behind the ringing second wave."""
    return rest * RECORD_DEPTH * (first[1] / first[2] + (velocity - first[1]) / second_wave[2])


def rows_of_waves(whipple, folder, waves):
    """Table of both waves at the speed of the case: exact, and by cell size."""
    rows = [["exact", *(f"{p / 1e9:.2f}" for p in (waves[0][0], waves[1][0])), *(f"{v:.1f}" for v in (waves[0][1], waves[1][1])),
             *(f"{1e6 * t:.3f}" for t in (waves[0][2], waves[1][2])), "0"]]
    for cell in CELLS:
        found, largest = measured(run_case(whipple, folder, "", cell), waves)
        rows.append([cell, *(f"{p / 1e9:.2f}" for p in (found[0][0], found[1][0])), *(f"{v:.1f}" for v in (found[0][1], found[1][1])),
                     *(f"{1e6 * t:.3f}" for t in (found[0][2], found[1][2])), f"{100 * (largest / (SPEED / 2) - 1):.1f} %"])
    return rows


def rows_of_record(whipple, folder, of_piston, rest):
    """Table of the record: pressures as listed, of a second wave, of the equation of state, and of runs up to RECORD_MOST.
    @param of_piston  gives both waves of a piston velocity"""
    rows = []
    for velocity, shock, pressure in records():
        waves = of_piston(velocity)
        runs = ["-"] * len(CELLS)
        if pressure <= RECORD_MOST:
            changes = [('"1200 m/s"', f'"{2 * velocity:.0f} m/s"'), ('"8 mm"', f'"{1e3 * RECORD_DEPTH:.0f} mm"'), ('end = "2.25 us"', f'end = "{RECORD_END}"')]
            found = [measured(run_case(whipple, folder, f"record_{velocity:.0f}_", cell, changes), waves)[0] for cell in CELLS]
            runs = [f"{by_arrivals(*both, rest, velocity) / 1e9:.2f}" for both in found]
        other = as_second_wave(waves[0], rest, velocity, shock)
        rows.append([f"{velocity:.0f}", f"{pressure / 1e9:.2f}", f"{other / 1e9:.2f}", f"{waves[1][0] / 1e9:.2f}", *runs,
                     f"{100 * (waves[1][0] / pressure - 1):+.1f} %", f"{100 * (waves[1][0] / other - 1):+.1f} %"])
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    whipple = parser.parse_args().bin.resolve() / "whipple"
    folder = ROOT / "run/split_wave"
    folder.mkdir(parents=True, exist_ok=True)
    rest = curve(whipple, "--from", "0 GPa", "--to", "1 GPa", "--points", "2")[0][1]
    first = curve(whipple, "--from", "12 GPa", "--to", "13.2 GPa", "--points", "1201")
    onset = [row for row in first if row[2] == first[0][2]][-1][0]
    further = curve(whipple, "--reflected", f"{onset / 1e9} GPa", "--from", f"{onset / 1e9 + 1} GPa", "--to", "60 GPa", "--points", "1500")
    text = table(["cells", "first wave, GPa", "second, GPa", "first, m/s", "second, m/s", "first arrives, us", "second, us", "overshoot"],
                 rows_of_waves(whipple, folder, exact(first, further, rest, SPEED / 2)))
    text += ("\nPressure in GPa behind the second wave at the particle velocities of the record (class: table of a data base): as listed (one "
             "shock), of a second wave if the listed velocity is its speed, of the equation of state, of runs by the arrivals of both waves; deviations of "
             "the equation of state from both readings:\n\n")
    text += table(["particle velocity, m/s", "listed", "as second wave", "equation of state", *CELLS, "from listed", "from second wave"],
                  rows_of_record(whipple, folder, lambda velocity: exact(first, further, rest, velocity, RECORD_DEPTH), rest))
    head, rest_of_page = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, tail = rest_of_page.split(END)
    PAGE.write_text(f"{head}{BEGIN}\n\n{text}\n{END}{tail}", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
