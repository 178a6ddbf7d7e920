#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the shock in iron split as its equation of state says? Runs iron on iron at 1.2 km/s with three cell sizes, and writes speeds,
velocities and pressures of both waves beside the exact ones into README.md.

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

HERE = pathlib.Path(__file__).resolve().parent
PAGE, CASE = HERE / "README.md", HERE / "case.toml"
BEGIN, END = "<!-- table: begin -->", "<!-- table: end -->"
CELLS = ("0.2 mm", "0.1 mm", "0.05 mm")
MATERIAL = "iron_alpha_epsilon"
SPEED, DEPTH = 1200.0, 8.0e-3  # m/s, m: of the flyer, of the gauge


def curve(whipple, *words):
    """Rows of `whipple eos hugoniot` in SI: pressure, density, phase."""
    text = call([whipple, "eos", "hugoniot", MATERIAL, *words, "--csv", "-"]).stdout
    rows = csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))
    return [(1e9 * float(row["P_GPa"]), float(row["rho_kg_m3"]), row["phase"]) for row in rows]


def second(pressure, density, state):
    """Jump of the velocity and speed relative to the material ahead of a shock from (pressure, density) to a state."""
    rise, shrink = state[0] - pressure, 1 / density - 1 / state[1]
    return math.sqrt(rise * shrink), math.sqrt(rise / shrink) / density


def exact(first, further, rest, velocity):
    """Both waves of a piston with the given velocity: pressure, velocity and arrival at the gauge after the impact.
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
            arrival = DEPTH / speed
            return [(pressure, step, arrival), (whole, velocity, arrival + (DEPTH - ahead * arrival) / (ahead - step))]
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    whipple = parser.parse_args().bin.resolve() / "whipple"
    folder = ROOT / "run/split_wave"
    folder.mkdir(parents=True, exist_ok=True)
    rest = curve(whipple, "--from", "0 GPa", "--to", "1 GPa", "--points", "2")[0][1]
    first = curve(whipple, "--from", "12 GPa", "--to", "13.2 GPa", "--points", "1201")
    onset = [row for row in first if row[2] == first[0][2]][-1][0]
    further = curve(whipple, "--reflected", f"{onset / 1e9} GPa", "--from", f"{onset / 1e9 + 1} GPa", "--to", "40 GPa", "--points", "800")
    waves = exact(first, further, rest, SPEED / 2)
    rows = [["exact", *(f"{p / 1e9:.2f}" for p in (waves[0][0], waves[1][0])), *(f"{v:.1f}" for v in (waves[0][1], waves[1][1])),
             *(f"{1e6 * t:.3f}" for t in (waves[0][2], waves[1][2])), "0"]]
    for cell in CELLS:
        case = folder / f"{cell.replace(' ', '')}.toml"
        text = re.sub(r'cell_size = "[^"]*"', f'cell_size = "{cell}"', CASE.read_text(encoding="utf-8"))
        case.write_text(text, encoding="utf-8")
        run = folder / case.stem
        call([whipple, "run", case, "-o", run, "--force", "-q"])
        with open(run / "gauges.csv", encoding="utf-8") as file:
            found, largest = measured(list(csv.DictReader(line for line in file if not line.startswith("#"))), waves)
        rows.append([cell, *(f"{p / 1e9:.2f}" for p in (found[0][0], found[1][0])), *(f"{v:.1f}" for v in (found[0][1], found[1][1])),
                     *(f"{1e6 * t:.3f}" for t in (found[0][2], found[1][2])), f"{100 * (largest / (SPEED / 2) - 1):.1f} %"])
    headings = ["cells", "first wave, GPa", "second, GPa", "first, m/s", "second, m/s", "first arrives, us", "second, us", "overshoot"]
    text = "\n".join(["| " + " | ".join(headings) + " |", "|" + " --- |" * len(headings)]
                     + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"
    head, rest_of_page = PAGE.read_text(encoding="utf-8").split(BEGIN)
    _, tail = rest_of_page.split(END)
    PAGE.write_text(f"{head}{BEGIN}\n\n{text}\n{END}{tail}", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
