#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What becomes of decks of MPM3D-F90 and LS-DYNA: imported, checked and, with --run, run to their end and compared with results
of MPM3D-F90, or the physics that is missing. Prints the tables of docs/manual/import.md.

usage: imported_decks.py [--run] WHIPPLE FOLDER DECK.mpm...
       imported_decks.py [--run] --units 'mm ms kg' --cell-size '1 mm' WHIPPLE FOLDER DECK.k...
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from report.history import History

MILLI, GRAM, MICRO = 1e3, 1e3, 1e6  # of m, kg, s
ARRIVAL = 1e9  # Pa, of a detonation


def whipple(program: str, *arguments: object) -> subprocess.CompletedProcess:
    """Runs the program and waits for it."""
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


def particles(run: pathlib.Path) -> dict[str, np.ndarray]:
    """Returns the fields of the last snapshot (SI) and, as "x", the positions."""
    index = json.loads(next(run.glob("*.particles.hdf.series")).read_text())["files"]
    with h5py.File(run / index[-1]["name"]) as file:
        data = file["VTKHDF/PointData"]
        return {name: data[name][:].astype(float) for name in data} | {"x": file["VTKHDF/Points"][:].astype(float)}


def energy(run: pathlib.Path) -> float:
    """Returns the largest error of the total energy in percent."""
    return 100.0 * float(np.abs(History(run / "history.csv")["energy_error"]).max())


def of_taylor(run: pathlib.Path) -> list[float]:
    """Length and diameters of the bar, mm: outermost particles and half a spacing."""
    x, half = MILLI * particles(run)["x"], 0.19
    radius, height = np.hypot(x[:, 0], x[:, 1]), x[:, 2]
    return [height.max() + half, 2 * (radius[height < 0.38 + half].max() + half),
            2 * (radius[np.abs(height - 5.08) < 0.25].max() + half), energy(run)]


def of_detonation(run: pathlib.Path) -> list[float]:
    """Times at which the pressure at four particles exceeds 1 GPa, us."""
    gauges = History(run / "gauges.csv")
    times = [gauges["time"][np.argmax(gauges[f"{name}.pressure"] > ARRIVAL)] for name in GAUGES]
    return [*(MICRO * time for time in times), energy(run)]


def of_charge(run: pathlib.Path) -> list[float]:
    """Kinetic energy (J) and momentum along x (kg m/s) of the octant."""
    history = History(run / "history.csv")
    return [history.last("kinetic_energy"), history.last("momentum_x"), energy(run)]


def of_lead(run: pathlib.Path) -> list[float]:
    """Projectile and debris: mean position (mm) and velocity (m/s), mass beyond x = 8 mm (g), foremost and fastest particle."""
    data = particles(run)
    x, vx, mass, own = data["x"][:, 0], data["velocity"][:, 0], data["mass"], data["body"] == 0
    return [MILLI * np.average(x[own], weights=mass[own]), np.average(vx[own], weights=mass[own]),
            GRAM * mass[x > 8e-3].sum(), MILLI * x.max(), vx.max(), energy(run)]


# Particles 500, 1600, 2800 and 3900 of the deck, whose pressures it asks for: places along x, mm.
GAUGES = {"p500": 12.4875, "p1600": 39.9875, "p2800": 69.9875, "p3900": 97.4875}
OF_ENERGY = "largest energy error, %"
# Measures of a deck: how they are taken, what they are, and what MPM3D-F90 (commit 4a6275f, linear shape functions, MUSL, run
# as the deck says; the lead deck with corrected masses and dtscale 0.2) gives.
MEASURES = {
    "Taylor": (of_taylor, ["length, mm", "diameter at the wall, mm", "diameter at 5.08 mm, mm", OF_ENERGY], [16.43, 13.50, 10.36, 1.6]),
    "Deto1k": (of_detonation, [*(f"arrival at {x} mm, µs" for x in GAUGES.values()), OF_ENERGY], [1.80, 5.77, 10.10, 14.07, 17.0]),
    "TNT3D": (of_charge, ["kinetic energy, J", "momentum along x, kg m/s", OF_ENERGY], [2202.0, 3.632, 0.55]),
    "LeadHypervelocityImpact": (of_lead, ["mean x of the projectile, mm", "its mean velocity, m/s", "mass beyond x = 8 mm, g",
                                          "foremost particle, mm", "fastest particle, m/s", OF_ENERGY],
                                [112.73, 4040.0, 77.5, 217.1, 9172.0, 4.1]),
}


def missing(report: str) -> list[str]:
    """Returns what a report of an import lists as missing, each once."""
    lines = report.partition("\nmissing (")[2].splitlines()[1:]
    found = [re.sub(r"^  line \d+\s+", "", line) for line in lines if line.startswith("  line ")]
    return list(dict.fromkeys(re.sub(r"\s{2,}", ": ", line) for line in found))


def add_gauges(case: pathlib.Path) -> None:
    """Adds moving gauges at particles that the deck asks for."""
    text = case.read_text()
    for name, x in GAUGES.items():
        text += f'\n[[gauge]]\nname = "{name}"\nkind = "moving"\nposition = ["{x} mm", "0.0125 mm", "0.0125 mm"]\n'
    case.write_text(text)


def row_of(program: str, deck: pathlib.Path, folder: pathlib.Path, runs: bool, given: list[str]) -> list[str]:
    """Imports, checks and, if wanted, runs a deck. Returns its row of the table.

    given: options of the import"""
    case = folder / deck.stem
    options: list[str] = []
    done = whipple(program, "import", deck, "-o", case, *given)
    if done.returncode and "--old-mass takes it" in done.stdout:
        options = ["--old-mass"]
        done = whipple(program, "import", deck, "-o", case, *given, *options)
    name = f"`{deck.name}`" + (f" with `{options[0]}`" if options else "")
    if done.returncode:
        return [name, "missing: " + "; ".join(missing(done.stdout) or [done.stderr.splitlines()[0]]), "", ""]
    checked = whipple(program, "check", case / "case.toml")
    if checked.returncode:
        return [name, f"refused: {checked.stderr.splitlines()[0]}", "", ""]
    count = (re.search(r"(?m)^particles: (\d+)", checked.stdout) or ["", "?"])[1]
    if not runs:
        return [name, f"can run: {count} particles", "", ""]
    if deck.stem == "Deto1k":
        add_gauges(case / "case.toml")
    run = folder / f"{deck.stem}.run"
    begin = time.monotonic()
    done = whipple(program, "run", case / "case.toml", "-o", run, "--quiet", "--threads", "1", "--force")
    seconds = time.monotonic() - begin
    if done.returncode:
        return [name, f"ends with exit code {done.returncode}: {(done.stderr or done.stdout).splitlines()[-1]}", "", ""]
    status = json.loads((run / "status.json").read_text())
    return [name, f"runs to its end: {count} particles", f"{1e6 * status['time']:.4g} µs, {status['step']} steps", f"{seconds:.0f} s"]


def run_coarse(program: str, stem: str, folder: pathlib.Path) -> bool:
    """Runs an imported deck with cells twice as large. Returns whether it came to its end."""
    case = folder / stem / "case.toml"
    cell, unit = re.search(r'(?m)^cell_size = "(\S+) (\S+)"', case.read_text()).groups()
    done = whipple(program, "run", case, "-o", folder / f"{stem}.coarse", "--quiet", "--threads", "1", "--force",
                   "--set", f"domain.cell_size={2 * float(cell):g} {unit}")
    return done.returncode == 0


def print_table(head: list[str], rows: list[list[str]]) -> None:
    """Prints a table of Markdown."""
    print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |", flush=True)


def main(words: list[str]) -> int:
    """Prints the tables. Returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", action="store_true")
    parser.add_argument("--units", help="units of decks that do not name them")
    parser.add_argument("--cell-size", help="edge of the cells for decks without a grid")
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("decks", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args(words)
    runs, program, folder, decks = arguments.run, arguments.program, arguments.folder, arguments.decks
    given = [word for option, value in (("--units", arguments.units), ("--cell-size", arguments.cell_size)) if value
             for word in (option, value)]
    folder.mkdir(parents=True, exist_ok=True)
    print_table(["deck", "outcome", "until", "one core"], [row_of(program, deck, folder, runs, given) for deck in decks])
    compared = [deck.stem for deck in decks if deck.stem in MEASURES and (folder / f"{deck.stem}.run" / "history.csv").exists()]
    if runs and compared:
        print()
        rows = []
        for stem in compared:
            measure, names, others = MEASURES[stem]
            coarse = measure(folder / f"{stem}.coarse") if run_coarse(program, stem, folder) else [np.nan] * len(names)
            rows += [[f"`{stem}.mpm`", name, *(f"{value:.4g}" for value in values)]
                     for name, *values in zip(names, coarse, measure(folder / f"{stem}.run"), others)]
        print_table(["deck", "measure", "whipple, cells twice as large", "whipple", "MPM3D-F90"], rows)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
