#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the corrected equation of state follow hot and expanded fluid? Fits potentials of copper, aluminium and lead by GRAY alone and with
corrected free energies to solid states, shocks, films of melt and vapour and fluid at constant volume, and writes the tables of README.md.

Usage: studies/hot_fluid/hot_fluid.py [--bin build/release/bin] [--stores run/md] [--only NAME...]

`whipple md` computes what the stores lack, about eight minutes of two cores per potential (those of OpenKIM: scripts/install_deps.sh --kim).
"""
import argparse
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402
from studies.corrected_eos.corrected_eos import COVERAGE, COVERAGE_IS, coverage, outcomes, residuals  # noqa: E402
from studies.joint_fit.joint_fit import table  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"
# Potential: its plans are NAME_short.toml and NAME_fluid_short.toml; measured density.
POTENTIALS = {
    "copper_mishin": "8.9445 g/cm^3",
    "copper_u3": "8.9445 g/cm^3",
    "aluminium_zhakhovsky": "2.70 g/cm^3",
    "aluminium_zhou": "2.70 g/cm^3",
    "aluminium_winey": "2.70 g/cm^3",
    "lead_zhou": "11.34 g/cm^3",
    "lead_landa": "11.34 g/cm^3",
}
FLUID = ("fluid", "film", "melt", "molten")  # beginnings of the kinds of data that are shown


def vaporisation(whipple, material):
    """Boiling temperature in K and heat of vaporisation there in MJ/kg, from the audit; dashes if it has none."""
    found = re.search(r"boils at ([\d.]+) K \(1 atm\), latent heat ([\d.]+) MJ/kg", call([whipple, "eos", "audit", material], (0, 3)).stdout)
    return [f"{float(found.group(1)):.0f}", f"{float(found.group(2)):.2f}"] if found else ["-", "-"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    parser.add_argument("--only", nargs="+", choices=POTENTIALS, default=list(POTENTIALS), help="these potentials; the tables of the others stay")
    options = parser.parse_args()
    whipple, folder = options.bin.resolve() / "whipple", ROOT / "run/hot_fluid"
    folder.mkdir(parents=True, exist_ok=True)
    results = folder / "rows.json"  # of every potential so far
    known = json.loads(results.read_text(encoding="utf-8")) if results.is_file() else {}
    for name in options.only:
        store = options.stores / f"{name}_with_fluid.md.h5"
        for plan in (f"{name}_short", f"{name}_fluid_short"):
            call([whipple, "md", ROOT / "cases/md" / f"{plan}.toml", "-o", store, "-q"], allowed=(0, 3))  # 3: some points failed or melted
        followed, covered, models = [], [], []
        for label, flags in (("GRAY", []), ("corrected", ["--correct"])):
            material = folder / f"{name}_{label.lower()}.toml"
            fit = call([whipple, "fit", store, "--density", POTENTIALS[name], *flags, "-o", material, "--force"], allowed=(0, 2, 3))
            if fit.returncode != 0:
                models.append([name, label, "-", "-", "-", "-", "refused: " + " ".join(fit.stderr.rsplit("error: ", 1)[-1].split())[:200]])
                continue
            followed += [[name, *row] for row in residuals(fit.stdout) if row[0].startswith(FLUID)]
            covered += [[name, *row] for row in coverage(fit.stdout) if row[0].startswith(FLUID)]
            melts, _, critical, verdict = outcomes(call([whipple, "eos", "audit", material], (0, 3)).stdout)
            models.append([name, label, melts, *vaporisation(whipple, material), critical, verdict])
        known[name] = {"followed": followed, "covered": covered, "models": models}
        results.write_text(json.dumps(known, indent=1), encoding="utf-8")
    rows = [known[name] for name in POTENTIALS if name in known]
    tables = "\n".join([
        "Deviation of the models from the simulated fluid, rms in percent of the scale of each kind (pressures rho0 C^2, energies 3RT, films "
        "R T/V and R T), and of the corrected one in units of its errors:\n\n"
        + table(["potential", "data", "number", "GRAY %", "corrected %", "corrected/errors"], [row for one in rows for row in one["followed"]]),
        COVERAGE_IS + table(["potential", *COVERAGE], [row for one in rows for row in one["covered"]]),
        "Complete models:\n\n"
        + table(["potential", "model", "melts at rest, K", "boils, K", "heat of vaporisation, MJ/kg", "critical point, K", "audit"],
                [row for one in rows for row in one["models"]])])
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    PAGE.write_text(f"{head}{BEGIN}\n\n{tables}\n{END}{tail}", encoding="utf-8")
    print(tables)


if __name__ == "__main__":
    main()
