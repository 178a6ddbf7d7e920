#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How near do published lines Us = C + S up come to the measured shocks that they are of? Compares every line of eos/data/us_up_fits.csv with
the tables of the same metal that have shock and particle velocities, and writes the table of README.md; beside them equations of state of
iron, of which no joint fit is possible.

Usage: studies/joint_fit/published_lines.py [--bin build/release/bin]
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

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
DATA = ROOT / "eos/data"
BEGIN, END = "<!-- lines: begin -->", "<!-- lines: end -->"
TABLES = {"copper": "cu_hugoniot_marsh1980", "nickel": "ni_hugoniot_marsh1980", "iron": "fe_hugoniot_rusbank"}
IRON = ("iron_high_pressure", "iron_wide", "iron_alpha_epsilon")
IRON_RANGE = (0.9, 5.0)  # km/s: epsilon phase and melt, as far as guns


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def shocks(name):
    """Particle and shock velocities in km/s of a table, without points at rest."""
    return [(float(row["up_km_s"]), float(row["us_km_s"])) for row in rows_of(DATA / f"{name}.csv") if float(row["up_km_s"]) > 0.0]


def bounds(text):
    """Particle velocities that a line is meant for, from `Up a-b`; otherwise all."""
    found = re.match(r"Up ([\d.]+)-([\d.]+)", text)
    return (float(found[1]), float(found[2])) if found else (0.0, math.inf)


def rms(deviations):
    """Root mean square of relative deviations in percent."""
    return 100.0 * math.sqrt(sum(one * one for one in deviations) / len(deviations))


def lines():
    """Metal, line and its rms deviation from the shocks of the metal within its range."""
    for metal, name in TABLES.items():
        points = shocks(name)
        for row in rows_of(DATA / "us_up_fits.csv"):
            if row["library"] != metal or float(row["S2"]) or "molecular-dynamics" in row["material"]:
                continue
            least, most = bounds(row["range"] or "")
            chosen = [(up, us) for up, us in points if least <= up <= most]
            deviations = [(float(row["C_km_s"]) + float(row["S"]) * up) / us - 1.0 for up, us in chosen]
            yield [metal, name, f"{row['C_km_s']} + {row['S']} up: {row['material']}", str(len(chosen)), f"{rms(deviations):.2f} %"]


def materials(whipple):
    """The same of materials of iron, by `whipple compare`."""
    text = call([whipple, "compare", *IRON, "--with", TABLES["iron"], "--csv", "-"]).stdout
    rows = list(csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#")))
    for name in IRON:
        chosen = [float(row["deviation"]) / 100.0 for row in rows
                  if row["material"] == name and IRON_RANGE[0] <= float(row["abscissa_value"]) <= IRON_RANGE[1]]
        yield ["iron", TABLES["iron"], f"material {name}, up {IRON_RANGE[0]} to {IRON_RANGE[1]} km/s", str(len(chosen)), f"{rms(chosen):.2f} %"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    whipple = parser.parse_args().bin.resolve() / "whipple"
    text = table(["metal", "measurement", "Us in km/s", "points", "rms of Us"], [*lines(), *materials(whipple)])
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    PAGE.write_text(f"{head}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
