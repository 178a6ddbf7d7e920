#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the corrected equation of state follow its atoms, and what does it change in a debris cloud? Fits one potential of each metal by GRAY
alone and with corrected free energies, compares both with simulations and measurements, flies the copper disk with both at two cell sizes,
and writes the tables of README.md.

Usage: studies/corrected_eos/corrected_eos.py [--bin build/release/bin] [--stores run/md] [--no-clouds]

The stores are those of the plans below; `whipple md` computes what is missing (aluminium: scripts/install_deps.sh --kim).
"""
import argparse
import csv
import json
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402
from studies.joint_fit.joint_fit import relative_rms, table  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"
# Metal: store, plans that fill it, measured density, measurements beside it.
METALS = {
    "copper": ("copper_mishin_short", ["copper_mishin_short"], "8.9445 g/cm^3",
               ["cu_hugoniot_marsh1980", "cu_isotherm_298K_dewaele2004", "cu_melting"]),
    "copper, with melting": ("copper_mishin_with_melting", ["copper_mishin_short", "copper_mishin_melting_short"], "8.9445 g/cm^3",
                             ["cu_hugoniot_marsh1980", "cu_isotherm_298K_dewaele2004", "cu_melting"]),
    "aluminium": ("aluminium_zhakhovsky_short", ["aluminium_zhakhovsky_short"], "2.70 g/cm^3",
                  ["al_hugoniot_mcqueen1970_2024", "al_isotherm_298K_dewaele2004", "al_melting_boehler_ross1997"]),
    "nickel": ("nickel_u3_short", ["nickel_u3_short"], "8.90 g/cm^3", ["ni_hugoniot_marsh1980"]),
    "tantalum": ("tantalum_ravelo_with_expansion", ["tantalum_ravelo_short", "tantalum_ravelo_expanded_short"], "16.69 g/cm^3", ["ta_isotherm_298K_dewaele2004"]),
}
CELLS = ("0.8 mm", "0.4 mm")


def rows_below(report, heading, counts, figures):
    """Returns the rows below a heading in the report of `whipple fit --correct`: a name, whole numbers, and figures, as texts."""
    lines = report.splitlines()
    begin = next((i for i, line in enumerate(lines) if line.startswith(heading)), len(lines))
    pattern = re.compile(r"(\S.*?)" + counts * r"\s+(\d+)" + figures * r"\s+([\d.]+)" + "$")
    rows = []
    for line in lines[begin + 1:]:
        found = pattern.match(line)
        if not found:
            break
        rows.append([*found.groups()])
    return rows


def residuals(report):
    """Returns kind, number, deviation of GRAY and of the corrected model in percent, and the latter over its errors."""
    return rows_below(report, "correction of the free energy", 1, 3)


def coverage(report):
    """Returns kind, number of data and of curves, fractions within 68 and 95 %, half-width and rms in percent of data predicted without
    their curve, and the factor of their errors."""
    return rows_below(report, "each curve predicted without itself", 2, 5)


COVERAGE = ["data", "number", "curves", "within 68 %", "within 95 %", "half-width %", "rms %", "widened"]
COVERAGE_IS = ("Coverage: each curve predicted by all others (fit.md, section 10); median half-width of the 95 % band of the prediction and rms "
               "deviation in percent of the same scales; factor of the errors of such predictions:\n\n")


def outcomes(audit):
    """Returns melting temperature at rest, boiling temperature and critical temperature in K and the verdict of an audit."""
    def number(pattern):
        found = re.search(pattern, audit)
        return f"{float(found.group(1)):.0f}" if found else "-"

    return [number(r"melting +([\d.]+) \.\.\."), number(r"boils at ([\d.]+) K"), number(r"critical point ([\d.]+) K"),
            re.search(r"verdict: (.*)", audit).group(1)]


def fly(whipple, material, cell, folder):
    """Flies the copper disk with a material by its table; returns masses of the disk that are not solid and vapour, in percent, and
    nanoseconds per particle and step."""
    text = (ROOT / "cases/copper_disk_on_aluminium/case.toml").read_text(encoding="utf-8")
    text = text.replace('material = "copper.toml"', f'material = "{material}"\nequation_of_state = "table"')
    case = folder / f"{material.stem}_{cell.replace(' ', '')}.toml"
    case.write_text(re.sub(r'cell_size = "[^"]*"', f'cell_size = "{cell}"', text), encoding="utf-8")
    run = folder / case.stem
    if not (run / "profile.json").is_file():
        call([whipple, "run", case, "-o", run, "--force", "-q"])
    with open(run / "history.csv", encoding="utf-8") as file:
        last = list(csv.DictReader(line for line in file if not line.startswith("#")))[-1]
    mass = {phase: float(last[f"mass_{phase}.disk [kg]"]) for phase in ("solid", "melting", "liquid", "vapour")}
    total = sum(mass.values()) + float(last["outflow_mass.disk [kg]"])
    profile = json.loads((run / "profile.json").read_text(encoding="utf-8"))
    seconds = sum(stage["seconds"] for stage in profile["stages"])
    steps = max(stage["calls"] for stage in profile["stages"])
    return [f"{100 * (1 - mass['solid'] / total):.2f} %", f"{100 * mass['liquid'] / total:.2f} %", f"{100 * mass['vapour'] / total:.3f} %",
            f"{1e9 * seconds / steps / profile['particles']:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    parser.add_argument("--only", nargs="+", choices=METALS, default=list(METALS), help="these metals; the rows of the others stay")
    parser.add_argument("--no-clouds", action="store_true", help="leave the runs of the disk out; their table stays as it is")
    options = parser.parse_args()
    whipple, folder = options.bin.resolve() / "whipple", ROOT / "run/corrected_eos"
    folder.mkdir(parents=True, exist_ok=True)
    results = folder / "rows.json"  # of every metal so far
    known = json.loads(results.read_text(encoding="utf-8")) if results.is_file() else {}
    for metal in options.only:
        name, plans, density, tables = METALS[metal]
        followed, covered, measured, audited, materials = [], [], [], [], {}
        store = options.stores / f"{name}.md.h5"
        for plan in plans:
            call([whipple, "md", ROOT / "cases/md" / f"{plan}.toml", "-o", store, "-q"], allowed=(0, 3))  # 3: some points failed or melted
        for label, flags in (("GRAY", []), ("corrected", ["--correct"])):
            material = folder / f"{name}_{label.lower()}.toml"
            fit = call([whipple, "fit", store, "--density", density, *flags, "-o", material, "--force"], allowed=(0, 2, 3))
            if fit.returncode != 0:
                audited.append([metal, label, "-", "-", "-", "refused: " + fit.stderr.strip().rsplit("error: ", 1)[-1]])
                continue
            materials[label] = material
            followed += [[metal, *row] for row in residuals(fit.stdout)]
            covered += [[metal, *row] for row in coverage(fit.stdout)]
            audited.append([metal, label, *outcomes(call([whipple, "eos", "audit", material]).stdout)])
        found = {}
        for label in ("GRAY", "corrected"):
            if label not in materials:
                continue
            figures = folder / "figures.csv"
            call([whipple, "compare", materials[label], "--with", *tables, "--csv", figures, "--force"])
            with open(figures, encoding="utf-8") as file:
                found[label] = relative_rms(csv.DictReader(line for line in file if not line.startswith("#")))
        measured += [[metal, curve, *(f"{found[label].get(curve, math.nan):.2f} %" if label in found else "-" for label in ("GRAY", "corrected"))]
                     for curve in sorted(found["GRAY"])]
        known[metal] = {"followed": followed, "covered": covered, "audited": audited, "measured": measured}
        results.write_text(json.dumps(known, indent=1), encoding="utf-8")
    of_metals = [known[metal] for metal in METALS if metal in known]
    followed, covered, audited, measured = ([row for one in of_metals for row in one[part]]
                                            for part in ("followed", "covered", "audited", "measured"))
    parts = ["Deviation of the models from the simulated states, rms in percent of the scale of each kind (fit.md, section 10), and of the "
             "corrected one in units of its errors:\n\n"
             + table(["metal", "data", "number", "GRAY %", "corrected %", "corrected/errors"], followed),
             COVERAGE_IS + table(["metal", *COVERAGE], covered),
             "Complete models:\n\n"
             + table(["metal", "model", "melts at rest, K", "boils, K", "critical point, K", "audit"], audited),
             "Deviation from measurements, rms of (material - measured)/measured; it contains that of the potential:\n\n"
             + table(["metal", "measurement", "GRAY", "corrected"], measured)]
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    before, tail = rest.split(END)
    heading = "Copper disk of 5.55 km/s, 10 us after the impact"
    if options.no_clouds:
        parts.append(heading + before.split(heading)[1].rstrip("\n") + "\n" if heading in before else "")
    else:
        rows = [[cell, label, *fly(whipple, folder / f"copper_mishin_with_melting_{label.lower()}.toml", cell, folder)]
                for cell in CELLS for label in ("GRAY", "corrected")]
        parts.append(f"{heading}, by tables of both models (copper, with melting):\n\n"
                     + table(["cells", "model", "not solid", "liquid", "vapour", "ns per particle and step"], rows))
    tables = "\n".join(part for part in parts if part)
    PAGE.write_text(f"{head}{BEGIN}\n\n{tables}\n{END}{tail}", encoding="utf-8")
    print(tables)


if __name__ == "__main__":
    main()
