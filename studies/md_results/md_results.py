#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Constants of all metals and potentials from molecular dynamics: runs what is missing of the short plans, fits every store,
compares with experiments, and writes the tables of docs/generated/results_md.md.

Usage: studies/md_results/md_results.py [--bin build/release/bin] [--stores run/md] [--ranks N] [--metal NAME ...]
                                        [--no-melting] [-o docs/generated/results_md.md]

Models of OpenKIM need scripts/install_deps.sh --kim. With --metal only the sections of these metals are written again.
"""
import argparse
import pathlib
import re
import statistics
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402

PAGE = ROOT / "docs/generated/results_md.md"

# Metal, its plans (cases/md/NAME_short.toml; _melting.toml too where there is one) with the potentials, and the
# measurements of eos/data.
METALS = {
    "copper": (
        {
            "copper_mishin": "Mishin et al. 2001",
            "copper_u3": "Foiles et al. 1986, universal 3",
            "copper_u6": "Adams et al. 1989, universal 6",
            "copper_zhou": "Zhou et al. 2004",
        },
        ["cu_hugoniot_marsh1980", "cu_isotherm_298K_dewaele2004"],
    ),
    "aluminium": (
        {
            "aluminium_zhou": "Zhou et al. 2004",
            "aluminium_voter": "Voter, Chen 1987",
            "aluminium_mendelev": "Mendelev et al. 2008",
            "aluminium_winey": "Winey et al. 2010 (KIM)",
            "aluminium_zhakhovsky": "Zhakhovsky et al. 2009 (KIM)",
        },
        ["al_hugoniot_mitchell_nellis1981", "al_isotherm_298K_dewaele2004"],
    ),
    "lead": ({"lead_zhou": "Zhou et al. 2004", "lead_landa": "Landa et al. 2000 (KIM)"}, []),
    "nickel": ({"nickel_u3": "Foiles et al. 1986, universal 3", "nickel_zhou": "Zhou et al. 2004",
                "nickel_mishin": "Mishin et al. 1999 (KIM)"}, ["ni_hugoniot_marsh1980"]),
    "tantalum": ({"tantalum_zhou": "Zhou et al. 2004", "tantalum_ravelo": "Ravelo et al. 2013 (KIM)",
                  "tantalum_derlet": "Derlet et al. 2007 (KIM)"},
                 ["ta_isotherm_298K_dewaele2004"]),
    "tungsten": ({"tungsten_zhou": "Zhou et al. 2004"}, ["w_isotherm_298K_dewaele2004"]),
}

# A row of published constants below those of `whipple fit`: name, then V0 cm3/g, C km/s, S, gamma0, a, g, T_m0 K.
PUBLISHED = re.compile(r"^((?:experiment|MD) \(.*?\))" + r"\s+([\d.]+)" * 7, re.MULTILINE)

CONSTANTS = [  # key of the material, its unit there, heading, factor from SI for the errors, decimals
    ("reference_specific_volume", "V0 cm^3/g", 1e3, 5),
    ("hugoniot_intercept", "C km/s", 1e-3, 3),
    ("hugoniot_slope", "S", 1.0, 3),
    ("gruneisen", "gamma0", 1.0, 2),
    ("gruneisen_slope", "a", 1.0, 2),
    ("anharmonic_heat_coefficient", "g_anh mJ/(mol K^2)", 1e3, 2),
    ("melting_temperature", "T_m0 K", 1.0, 0),
    ("melting_entropy", "Delta S J/(mol K)", 1.0, 2),
]


def number(text):
    return float(str(text).split()[0])


def published_rows(report):
    """Reads the published constants of a report of `whipple fit`: name -> (V0, C, S, gamma0, a, T_m0)."""
    rows = {}
    for name, *numbers in PUBLISHED.findall(report):
        volume, intercept, slope, gruneisen, gruneisen_slope, _, melting = map(float, numbers)
        rows[name] = (volume, intercept, slope, gruneisen, gruneisen_slope, melting)
    return rows


def largest_factor(provenance):
    """The largest factor by which chi^2 of a kind of data raised its model errors, with that kind."""
    prefix = "inflation_"
    factors = {key.removeprefix(prefix).replace("_", " "): value for key, value in provenance.items() if key.startswith(prefix)}
    kind = max(factors, key=factors.get)
    return f"{factors[kind]:.1f} ({kind})" if factors[kind] > 1.05 else "1"


class Fitted:
    """One potential: constants, errors, and how far C and S move with the window of particle velocities."""

    def __init__(self, name, label, binaries, stores):
        self.name, self.label = name, label
        store = stores / f"{name}.md.h5"
        self.material = stores / f"{name}.toml"
        self.values, self.errors, self.noise, self.published = {}, {}, {}, {}
        if not store.exists():
            self.fault = "its plan was not run"
            return
        result = call([binaries / "whipple-fit", store, "-o", self.material, "--force"], allowed=(0, 2, 3))
        self.fault = result.stderr.strip().splitlines()[-1].replace(str(store), store.name) if result.returncode else ""
        if self.fault:
            return
        text = tomllib.loads(self.material.read_text(encoding="utf-8"))
        covariance = text["covariance"]
        for key, _, factor, _ in CONSTANTS:
            self.values[key] = number(text["eos"][key])
            if key in covariance["names"]:
                place = covariance["names"].index(key)
                self.errors[key] = factor * covariance["matrix"][key][place] ** 0.5
                self.noise[key] = factor * covariance["statistical_error"][place]
        self.factor = largest_factor(text["provenance"]["fit"])
        found = re.search(r"over the windows: C ([\d.]+) \.\.\. ([\d.]+) km/s, S ([\d.]+) \.\.\. ([\d.]+)", result.stdout)
        self.windows = tuple(map(float, found.groups()))
        self.left_out = int(re.search(r"(\d+) isochore states above", result.stdout + "0 isochore states above").group(1))
        self.published = published_rows(result.stdout)
        self.deviations = {}

    def cell(self, key, factor_decimals):
        decimals = factor_decimals
        value = self.values[key]
        if key not in self.errors:
            return f"({value:.{decimals}f})"
        return f"{value:.{decimals}f} ± {self.errors[key]:.{decimals}f} ({self.noise[key]:.{max(decimals, 3)}f})"


def deviation_of(report, experiment, material):
    """The rms of a material against an experiment with its unit, in the table of `whipple compare`; None if it is not there."""
    row = re.compile(rf"^{re.escape(experiment)} .*\s{re.escape(material)}\s.*$", re.MULTILINE).search(report)
    if not row:
        return None
    words = row[0].split()
    unit_at = next(i for i, word in enumerate(words) if word in ("%", "GPa"))
    return f"{words[unit_at - 3]} {' '.join(words[unit_at:])}"


def compare(fits, experiments, binaries):
    """rms of each material against each experiment, with its unit."""
    good = [fit for fit in fits if not fit.fault]
    if not experiments or not good:
        return
    out = call([binaries / "whipple", "compare", *[fit.material for fit in good], "--with", *experiments]).stdout
    for fit in good:
        for experiment in experiments:
            if text := deviation_of(out, experiment, fit.material.stem):
                fit.deviations[experiment] = text


def distance(fit, row):
    """rms of the relative deviations of C, S, gamma0 and a from a published row."""
    keys = ["hugoniot_intercept", "hugoniot_slope", "gruneisen", "gruneisen_slope"]
    return statistics.fmean(((fit.values[key] - row[i + 1]) / row[i + 1]) ** 2 for i, key in enumerate(keys)) ** 0.5


def table(headings, rows):
    return "\n".join(["| " + " | ".join(headings) + " |", "|" + " --- |" * len(headings)]
                     + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def metal_section(metal, fits, experiments):
    text = [f"## {metal.capitalize()}\n"]
    rows = []
    for fit in fits:
        if fit.fault:
            rows.append([fit.label, f"no fit: {fit.fault.removeprefix('whipple fit: ')}"] + [""] * len(CONSTANTS))
            continue
        rows.append([fit.label] + [fit.cell(key, decimals) for key, _, _, decimals in CONSTANTS] + [fit.factor])
    published = next((fit.published for fit in fits if not fit.fault), {})
    for name, row in published.items():
        rows.append([name, f"{row[0]:.5f}", *[f"{value:g}" for value in row[1:5]], "", f"{row[5]:g}", "", ""])
    text.append(table(["", *[heading for _, heading, _, _ in CONSTANTS], "model errors times"], rows))
    good = [fit for fit in fits if not fit.fault]
    rows = []
    for fit in good:
        low_c, high_c, low_s, high_s = fit.windows
        rows.append([fit.label, f"{low_c:.3f} ... {high_c:.3f}", f"{low_s:.3f} ... {high_s:.3f}",
                     *[fit.deviations.get(experiment, "") for experiment in experiments]])
    text.append(table(["over the fit windows", "C km/s", "S", *[f"rms against {one}" for one in experiments]], rows))
    if len(good) > 1:
        rows = []
        for key, heading, _, decimals in CONSTANTS[1:5]:
            values = [fit.values[key] for fit in good]
            noise = statistics.fmean(fit.noise[key] for fit in good)
            error = statistics.fmean(fit.errors[key] for fit in good)
            spread = statistics.stdev(values)
            rows.append([heading, f"{min(values):.{decimals}f} ... {max(values):.{decimals}f}", f"{spread:.3f}",
                         f"{error:.3f}", f"{noise:.4f}", f"{spread / noise:.0f}"])
        text.append(table(["over the potentials", "range", "standard deviation", "mean total error", "mean noise",
                           "spread/noise"], rows))
        for name, row in published.items():
            ordered = sorted(good, key=lambda fit: distance(fit, row))
            text.append(f"Nearest to {name}, by the rms of the relative deviations of C, S, gamma0 and a: "
                        + ", ".join(f"{fit.label} ({100 * distance(fit, row):.1f} %)" for fit in ordered) + ".\n")
    return "\n".join(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    parser.add_argument("--ranks", type=int, default=0)
    parser.add_argument("--metal", nargs="+", choices=METALS, default=list(METALS))
    parser.add_argument("--no-md", action="store_true", help="take the stores as they are")
    parser.add_argument("--no-melting", action="store_true", help="leave out the melting plans: T_m0 and Delta S stay defaults")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=PAGE)
    options = parser.parse_args()
    binaries, stores = options.bin.resolve(), options.stores.resolve()
    stores.mkdir(parents=True, exist_ok=True)
    text = options.output.read_text(encoding="utf-8") if options.output.exists() else ""
    begin, end = "<!-- tables: begin -->", "<!-- tables: end -->"
    if begin not in text:
        text = f"{begin}\n{end}\n"
    head, rest = text.split(begin)
    former, tail = rest.split(end)
    sections = {part.split("\n", 1)[0].lower(): f"## {part.strip()}\n" for part in former.split("## ")[1:]}
    for metal in options.metal:
        potentials, experiments = METALS[metal]
        fits = []
        for name, label in potentials.items():
            store = stores / f"{name}.md.h5"
            for kind in () if options.no_md else ("short",) if options.no_melting else ("short", "melting"):
                plan = ROOT / f"cases/md/{name}_{kind}.toml"
                if plan.exists():
                    ranks = ["--ranks", options.ranks] if options.ranks else []
                    call([binaries / "whipple", "md", plan, "-o", store, *ranks], allowed=(0, 3))
            fits.append(Fitted(name, label, binaries, stores))
        compare(fits, experiments, binaries)
        sections[metal] = metal_section(metal, fits, experiments)
        print(f"{metal}: {len(fits)} potentials", flush=True)
    body = "\n".join(sections[metal] for metal in METALS if metal in sections)
    options.output.write_text(f"{head}{begin}\n\n{body}\n{end}{tail}", encoding="utf-8")
    print(f"written: {options.output}")


if __name__ == "__main__":
    main()
