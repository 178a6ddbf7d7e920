#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Melts the first potentials of the ranking: crystal and melt in contact at zero pressure, for every metal but copper, whose potentials were
all asked; writes the table of melting points into README.md.

Usage: studies/potential_ranking/melting.py [--bin build/release/bin] [--stores run/melting] [--no-md]
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402
from studies.joint_fit.joint_fit import table  # noqa: E402
from studies.potential_ranking.measured import METALS, melting_point  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- melting: begin -->", "<!-- melting: end -->"
HEADINGS = ["metal", "potential", "T_m, K", "measured, K", "difference", "heat of fusion, MJ/kg", "core minutes"]


def plans():
    """Metal, label of the potential, its plan of coexistence and the measured melting point in K."""
    for name, metal in METALS.items():
        for plan, label in metal.potentials.items():
            file = ROOT / "cases/md" / f"{plan.removesuffix('_short')}_melting_point.toml"
            if name != "copper" and file.is_file():
                yield name, label, file, melting_point(metal.symbol)


def coexistence(path):
    """Melting temperature in K and heat of fusion in J/kg with their errors; none if it failed."""
    import h5py  # here, since the tests need none

    with h5py.File(path) as file:
        for point in file["points"].values():
            if point.attrs["protocol"] == b"coexistence" and point.attrs["status"] == b"done":
                results = point["results"]
                return [tuple(float(x) for x in results[name][:2]) for name in ("melting_temperature", "latent_heat")]
    return None


def row(name, label, found, measured, minutes):
    """Row of the table; failed points have dashes."""
    if found is None:
        return [name, label, "-", f"{measured:.0f}", "-", "-", minutes]
    (temperature, error), (heat, heat_error) = found
    return [name, label, f"{temperature:.0f} +- {error:.0f}", f"{measured:.0f}", f"{100 * (temperature / measured - 1):+.1f} %",
            f"{heat / 1e6:.3f} +- {heat_error / 1e6:.3f}", minutes]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/melting")
    parser.add_argument("--no-md", action="store_true", help="take the stores as they are")
    options = parser.parse_args()
    options.stores.mkdir(parents=True, exist_ok=True)
    rows = []
    for name, label, plan, measured in plans():
        stem = plan.stem.removesuffix("_melting_point")
        store, log = options.stores / f"{stem}.md.h5", options.stores / f"{stem}.log"
        if not options.no_md:
            report = call([options.bin.resolve() / "whipple", "md", plan, "-o", store, "--ranks", "1"], allowed=(0, 3))
            if not log.is_file():  # of the call that computed the points, with their time
                log.write_text(report.stdout + report.stderr, encoding="utf-8")
        if not store.is_file():
            continue
        times = [line for line in log.read_text(encoding="utf-8").splitlines() if line.startswith("processor time in points")] if log.is_file() else []
        minutes = times[-1].split(":")[1].split()[0] if times else "-"
        rows.append(row(name, label, coexistence(store), measured, minutes))
    text = table(HEADINGS, rows)
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    PAGE.write_text(f"{head}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
