#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Is the fit of simulations and measurements together as good as the constants of handbooks, and do its bands hold? Fits one potential of
each metal alone and with all tables of the metal in eos/data (README.md: the rule), and writes the tables of README.md.

Usage: studies/joint_fit/joint_fit.py [--bin build/release/bin] [--stores run/md]

The stores are those of cases/md/NAME_short.toml; `whipple md` computes what is missing (aluminium: scripts/install_deps.sh --kim).
"""
import argparse
import csv
import math
import pathlib
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"

# Metal: plan of the potential, material of the library with constants of a handbook, density, tables in the fit, tables it predicts.
METALS = {
    "copper": ("copper_mishin_short", "copper", None,
               ["cu_hugoniot_marsh1980", "cu_isotherm_298K_dewaele2004", "cu_isotherm_aip_handbook", "cu_melting",
                "cu_thermal_expansion_nist_hahn1"], ["cu_isentrope_fratanduono2020"]),
    "aluminium": ("aluminium_zhakhovsky_short", "aluminium", "2.70 g/cm^3",
                  ["al_hugoniot_mcqueen1970_2024", "al_hugoniot_mitchell_nellis1981", "al_isotherm_298K_dewaele2004",
                   "al_static_vaidya1970", "al_melting_boehler_ross1997", "al_cp_desai1987"], []),
    "nickel": ("nickel_u3_short", "nickel", "8.90 g/cm^3", ["ni_hugoniot_marsh1980"], []),
    "tantalum": ("tantalum_ravelo_short", "tantalum", "16.69 g/cm^3", ["ta_isotherm_298K_dewaele2004", "us_up_fits"], []),
}


def relative_rms(rows):
    """Root mean square of (model - measured)/measured in percent of each experiment of `whipple compare --csv`, without points outside the
    range of the model. Expansions and heat capacities are left out: those of classical nuclei differ from the measured ones."""
    sums = {}
    for row in rows:
        measured, model = float(row["measured"]), float(row["model"])
        if measured > 0.0 and math.isfinite(model):
            total, count = sums.get(row["experiment"], (0.0, 0))
            sums[row["experiment"]] = (total + ((model - measured) / measured) ** 2, count + 1)
    return {name: 100.0 * math.sqrt(total / count) for name, (total, count) in sums.items()}


def table(headings, rows):
    return "\n".join(["| " + " | ".join(headings) + " |", "|" + " --- |" * len(headings)]
                     + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def fits_of(binaries, stores, metal, folder):
    """Fits a metal alone and jointly; returns both material files."""
    plan, _, density, tables, checks = METALS[metal]
    store = stores / f"{plan}.md.h5"
    call([binaries / "whipple", "md", ROOT / "cases/md" / f"{plan}.toml", "-o", store, "-q"], allowed=(0, 3))  # 3: some points failed or melted
    given = ["--density", density] if density else ["--density", "8.93 g/cm^3"]
    alone, joint = folder / f"{metal}_alone.toml", folder / f"{metal}_joint.toml"
    call([binaries / "whipple", "fit", store, *given, "-o", alone, "--force", "-q"])
    call([binaries / "whipple", "fit", store, *given, "--with", *tables, *(["--check", *checks] if checks else []), "-o", joint,
          "--force", "-q"])
    return alone, joint


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    options = parser.parse_args()
    folder = ROOT / "run/joint_fit"
    folder.mkdir(parents=True, exist_ok=True)
    deviations, coverage = [], []
    for metal, (_, handbook, _, tables, checks) in METALS.items():
        alone, joint = fits_of(options.bin.resolve(), options.stores, metal, folder)
        figures = folder / f"{metal}.csv"
        compared = [name for name in tables + checks if not any(word in name for word in ("expansion", "_cp_"))]
        found = {}
        for label, material in (("handbook", handbook), ("alone", alone), ("joint", joint)):
            call([options.bin.resolve() / "whipple", "compare", material, "--with", *compared, "--csv", figures, "--force"])
            with open(figures, encoding="utf-8") as file:
                found[label] = relative_rms(csv.DictReader(line for line in file if not line.startswith("#")))
        for name in sorted(found["joint"]):
            check = " (not in the fit)" if name in checks else ""
            deviations.append([metal, name + check, *(f"{found[label].get(name, math.nan):.2f} %" for label in found)])
        for row in tomllib.loads(joint.read_text(encoding="utf-8")).get("coverage", []):
            coverage.append([metal, row["curve"], f"{row['points']}", f"{100 * row['inside_68']:.0f} %", f"{100 * row['inside_95']:.0f} %",
                             f"{100 * row['half_width']:.2f} %", f"{100 * row['half_width_with_form']:.2f} %", f"{100 * row['rms']:.2f} %"])
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    _, tail = rest.split(END)
    tables = ("Root mean square of (material - measured)/measured:\n\n"
              + table(["metal", "measurement", "handbook", "simulations alone", "together"], deviations)
              + "\nEach curve predicted by the fit without it:\n\n"
              + table(["metal", "measurement", "points", "within 68 %", "within 95 %", "half-width of 95 %", "with the form", "rms"], coverage))
    PAGE.write_text(f"{head}{BEGIN}\n\n{tables}\n{END}{tail}", encoding="utf-8")
    print(tables)


if __name__ == "__main__":
    main()
