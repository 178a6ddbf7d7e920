#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does GRAY, continued with the electrons of Thomas and Fermi, hold at terapascals? Compares it with shocks of iron to 19 TPa, ramp
compression of copper to 2.3 TPa, single points of aluminium and molybdenum, varies what is not known of the continuation, audits it to 100 eV,
and writes the tables of README.md.

Usage: studies/wide_range/wide_range.py [--bin build/release/bin]
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
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"
METALS = ("copper", "aluminium", "iron", "molybdenum")
BASE = {"copper": "copper", "aluminium": "aluminium", "iron": "iron_high_pressure", "molybdenum": "molybdenum"}
# The continuation as it is, and with what is not known of it: where the cold curve is continued, where the electrons are replaced.
VARIANTS = {
    "as it is": "",
    "join at 0.65": "cold_join_ratio = 0.65",
    "join at 0.75": "cold_join_ratio = 0.75",
    "electrons from 5000 K": 'electron_onset = "5000 K"\nelectron_temperature = "30000 K"',
}
VELOCITIES = (1.0, 2.0, 4.0, 8.0, 18.0, 50.0)  # km/s: classes of the shocks of iron
PRESSURES = (0.0, 500.0, 1000.0, 1500.0, 2000.0, 2400.0)  # GPa: ends of the classes of the ramp


def rows_of(text):
    """Rows of a table of comma separated values as dictionaries of numbers; words are left out."""
    rows = csv.DictReader(line for line in io.StringIO(text) if line.strip() and not line.startswith("#"))
    return [{name: float(value) for name, value in row.items() if re.fullmatch(r"[-+\d.e]+|nan", value or "")} for row in rows]


def between(rows, x, at, y):
    """Interpolates y linearly in x; nan outside."""
    for a, b in zip(rows, rows[1:]):
        if a[x] <= at <= b[x]:
            return a[y] + (b[y] - a[y]) * (at - a[x]) / (b[x] - a[x])
    return math.nan


def classes(points, edges, x, y, model):
    """For each class of x: number of points, mean and rms of model/measured - 1 in percent; nan without a model."""
    result = []
    for low, high in zip(edges, edges[1:]):
        inside = [point for point in points if low < point[x] <= high]
        deviations = [100 * (model(point[x]) / point[y] - 1) for point in inside]
        mean = sum(deviations) / len(inside) if inside else math.nan
        rms = math.sqrt(sum(d * d for d in deviations) / len(inside)) if inside else math.nan
        result.append((str(len(inside)), mean, rms))
    return result


def percent(value):
    """Formats a deviation in percent; a dash where the model does not reach all points."""
    return "-" if math.isnan(value) else f"{value:+.1f}"


class Curves:
    """Curves of the program, of materials of the library or of variants of them."""

    def __init__(self, binaries, folder):
        self.whipple, self.folder = binaries / "whipple", folder

    def variant(self, metal, lines):
        """Writes a wide material with further lines in its equation of state; returns the file."""
        text = (ROOT / f"eos/materials/{metal}_wide.toml").read_text(encoding="utf-8")
        file = self.folder / f"{metal}_variant.toml"
        file.write_text(text.replace('model = "gray_wide"', f'model = "gray_wide"\n{lines}'), encoding="utf-8")
        return file

    def hugoniot(self, material, end):
        """Returns the principal Hugoniot up to a pressure in GPa, or as far as the model goes."""
        while True:
            got = call([self.whipple, "eos", "hugoniot", material, "--to", f"{end:.0f} GPa", "--points", 600, "--csv", "-", "-q"], (0, 2, 3))
            if got.returncode == 0:
                return rows_of(got.stdout)
            end *= 0.8

    def isentrope(self, material, end):
        """Returns the isentrope from ambient conditions up to a pressure in GPa, or as far as the model goes."""
        while True:
            got = call([self.whipple, "eos", "isentrope", material, "--temperature", "300 K", "--pressure", "0.1 MPa", "--to", f"{end:.0f} GPa",
                        "--points", 400, "--csv", "-", "-q"], (0, 2, 3))
            if got.returncode == 0:
                return sorted(rows_of(got.stdout), key=lambda row: row["P_GPa"])
            end *= 0.8


def measured(name):
    return rows_of((ROOT / f"eos/data/{name}.csv").read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    options = parser.parse_args()
    folder = ROOT / "run/wide_range"
    folder.mkdir(parents=True, exist_ok=True)
    curves = Curves(options.bin.resolve(), folder)
    iron, ramp = measured("fe_hugoniot_rusbank"), measured("cu_isentrope_fratanduono2020") + measured("cu_isentrope_tpa_fratanduono2020")
    ramp = [point for point in ramp if point["P_GPa"] > 0]
    shocks, ramps, points = [], [], []
    for label, lines in {"GRAY": None, **VARIANTS}.items():
        name = {metal: BASE[metal] if lines is None else curves.variant(metal, lines) for metal in METALS}
        hugoniot = curves.hugoniot(name["iron"], 25000)
        shocks += [[label, f"{low:g} to {high:g}", n, percent(mean), percent(rms).lstrip("+")]
                   for (low, high), (n, mean, rms) in zip(zip(VELOCITIES, VELOCITIES[1:]), classes(
                       iron, VELOCITIES, "up_km_s", "us_km_s", lambda up: between(hugoniot, "up_km_s", up, "us_km_s")))]
        isentrope = curves.isentrope(name["copper"], 2400)
        ramps += [[label, f"{low:g} to {high:g}", n, percent(mean), percent(rms).lstrip("+")]
                  for (low, high), (n, mean, rms) in zip(zip(PRESSURES, PRESSURES[1:]), classes(
                      ramp, PRESSURES, "P_GPa", "rho_g_cm3", lambda P: between(isentrope, "P_GPa", P, "rho_kg_m3") / 1000))]
        al, mo, cu = (curves.hugoniot(name[metal], end) for metal, end in (("aluminium", 1200), ("molybdenum", 6000), ("copper", 10000)))
        slope = (between(cu, "P_GPa", 9000, "us_km_s") - between(cu, "P_GPa", 1000, "us_km_s")) / (
            between(cu, "P_GPa", 9000, "up_km_s") - between(cu, "P_GPa", 1000, "up_km_s"))
        values = (1 / between(al, "P_GPa", 1085, "V_over_V0"), between(mo, "up_km_s", 4970 / (10.2 * 27.0), "us_km_s"),
                  between(mo, "P_GPa", 4970, "rho_kg_m3") / 1000, slope)
        points.append([label, *("-" if math.isnan(v) else f"{v:.{digits}f}" for v, digits in zip(values, (3, 2, 2, 3)))])
    points.insert(0, ["measured", "2.57", "27.0(3)", "30.8", "1.2"])
    audits = []
    for metal in METALS:
        text = call([curves.whipple, "eos", "audit", f"{metal}_wide"], (0, 3)).stdout
        valid = re.search(r"density (\S+) \.\.\. (\S+) kg/m\^3, temperature \S+ \.\.\. (\S+) K, shocks to (\S+) GPa", text)
        defects = [float(word) for line in text.splitlines() if re.search(r"\be-\d\d.* sound", line) or line.endswith("sound")
                   for word in re.findall(r"\d\.\de-\d\d", line)]
        audits.append([metal, f"{float(valid.group(2)):.0f}", f"{float(valid.group(3)):.2g}", f"{float(valid.group(4)) / 1000:.1f}",
                       f"{max(defects):.0e}", re.search(r"verdict: (.*)", text).group(1)])
    parts = ["Shock velocity of iron at the measured particle velocity, (model - measured)/measured in percent:\n\n"
             + table(["model", "particle velocity, km/s", "shocks", "mean", "rms"], shocks),
             "Density of copper on its isentrope at the measured pressure, in percent:\n\n"
             + table(["model", "pressure, GPa", "points", "mean", "rms"], ramps),
             "Single points:\n\n"
             + table(["model", "Al, density ratio at 1085 GPa", "Mo, shock velocity at 18.05 km/s, km/s", "Mo, density at 4970 GPa, g/cm^3",
                      "Cu, dUs/dup from 1 to 9 TPa"], points),
             "Audit (`whipple eos audit`):\n\n"
             + table(["material", "densest, kg/m^3", "hottest, K", "strongest shock, TPa", "largest defect of an identity", "verdict"], audits)]
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    tables = "\n".join(parts)
    PAGE.write_text(f"{head}{BEGIN}\n\n{tables}\n{END}{tail}", encoding="utf-8")
    print(tables)


if __name__ == "__main__":
    main()
