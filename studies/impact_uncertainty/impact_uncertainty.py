#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far do the errors of a fitted equation of state reach into an impact? Draws materials of disk and plate by tier of
the errors (noise, fit, potentials), evaluates the release thresholds of each tier, runs an ensemble of axisymmetric
copper-on-aluminium impacts, and splits the bands on melted mass, front and hole into statistics, model, potential,
lattice and grid (part "bands"); shock pressures of melting and vaporisation ("thresholds"); every default of the fitted
materials changed by itself, and what the cloud makes of it ("defaults"). Writes the tables of README.md.

Usage: studies/impact_uncertainty/impact_uncertainty.py [--stores run/md] [--members 12] [--cell "0.4 mm"]
                                                        [--parts bands thresholds defaults] [--bin build/release/bin]
                                                        [-o run/impact_uncertainty]

Stores: those of studies/fit_calibration (cases/md/*_short.toml).
"""
import argparse
import csv
import hashlib
import math
import pathlib
import re
import shutil
import statistics
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from report.expectations import quantity  # noqa: E402
from studies.commands import call, program  # noqa: E402
from studies.fit_calibration.fit_calibration import METALS, table, usable  # noqa: E402
from studies.validation.bands import STUDENT, grid_study  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
CASE = ROOT / "cases/copper_disk_on_aluminium/case.toml"
AXISYMMETRIC = ["domain.dimension=axisymmetric", "domain.axis=z"]
# Body: metal, its number in the case, measured density at rest (sources: README.md).
BODIES = {"disk": ("copper", 0, "8.9445 g/cm^3"), "plate": ("aluminium", 1, "2.707 g/cm^3")}
TIERS = ("noise", "fit", "potentials")
# Measure of `whipple analyse`: heading, factor from SI, decimals.
MEASURES = {
    "melted_mass": ("melted mass, g", 1e3, 3),
    "melted_fraction.disk": ("melted fraction of the disk, %", 1e2, 2),
    "melted_fraction.plate": ("melted fraction of the plate, %", 1e2, 2),
    "front_speed": ("speed of the front, km/s", 1e-3, 3),
    "hole_diameter.plate": ("diameter of the hole, mm", 1e3, 2),
}
GRIDS = (1.0, 0.75, 0.5)          # cells of the ensemble, and finer ones
SHIFTS = (0.25, 0.5, 0.75, 0.125)  # of a cell along the flight
TENTH = 0.1                        # change of a default of which no error is known
NOT_CHANGED = ("hugoniot_quadratic", "hugoniot_cubic", "reference_energy")  # zero by the form of the law, or arbitrary
THRESHOLD = re.compile(r"^((?:melting|vaporisation) [\w ]+?) ([\d.]+) \+- ([\d.]+|nan) GPa \((\d+) of (\d+) samples\)", re.MULTILINE)


def digest(setting):
    """SHA-256 of the file that a setting names; empty if it names none."""
    file = pathlib.Path(setting.partition("=")[2])
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.suffix == ".toml" and file.is_file() else ""


class Ensemble:
    """Runs of the case with other materials, cells and places of the grid, each once for the same inputs."""

    def __init__(self, options):
        self.binaries = options.bin.resolve()
        self.folder = options.output.resolve()
        self.cell = options.cell

    def run(self, name, changes=(), cell=None):
        """Measures of a run: quantity -> value in the units of MEASURES; NaN where there is none."""
        folder = self.folder / "runs" / name
        quantities = folder / "report/quantities.csv"
        stamp = folder / "ensemble.txt"
        settings = [*AXISYMMETRIC, f"domain.cell_size={cell or self.cell}", *changes]
        inputs = "\n".join([program(self.binaries / "whipple"), *settings, *map(digest, settings)])
        if not quantities.exists() or not stamp.exists() or stamp.read_text(encoding="utf-8") != inputs:
            call([self.binaries / "whipple", "run", CASE, "-o", folder, "--force", "--quiet",
                  *[word for setting in settings for word in ("--set", setting)]], allowed=(0, 3))
            call([self.binaries / "whipple", "analyse", folder, "--quiet"])
            for part in folder.glob("*.vtkhdf"):
                part.unlink()
            shutil.rmtree(folder / "checkpoint", ignore_errors=True)
            stamp.write_text(inputs, encoding="utf-8")
        with quantities.open(encoding="utf-8") as file:
            values = {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}
        return {key: factor * values.get(key, math.nan) for key, (_, factor, _) in MEASURES.items()}


def fitted(options, body, samples, tier):
    """Folder with the central material of a body, and a list of its samples."""
    metal, _, density = BODIES[body]
    central, others, _ = METALS[metal]
    stores = [usable(options.bin.resolve(), options.stores.resolve(), name)[0] for name in [central, *others]]
    if stores[0] is None:
        sys.exit(f"{metal}: the store of {central} can not be fitted")
    if tier == "potentials" and sum(store is not None for store in stores) < 2:
        return None, []
    folder = options.output.resolve() / "materials" / f"{body}_{tier}"
    folder.mkdir(parents=True, exist_ok=True)
    call([options.bin.resolve() / "whipple-fit", *[store for store in stores if store], "-q", "-o", f"{folder}/", "--force",
          "--density", density, "--samples", samples, "--tier", tier])
    return folder / f"{central}.toml", sorted((folder / f"{central}_samples").glob("*.toml"))


def shifted(cell, shift):
    """The assignment that moves the grid by a part of a cell along the flight; `cell`: text with a unit."""
    return f'domain.lower=["0 mm", "0 mm", "{-36 - 1e3 * shift * quantity(cell, "--cell")[0]:.10g} mm"]'


def spread(values):
    """Mean and standard deviation of the finite values."""
    good = [value for value in values if math.isfinite(value)]
    return (statistics.fmean(good), statistics.stdev(good)) if len(good) > 1 else (math.nan, math.nan)


def split(deviations):
    """Standard deviations of the parts of one measure from those of the ensembles.

    deviations: lattice, noise, fit, potentials; each ensemble holds the lattice's scatter of single runs, and that of
    the fit the noise as well. What does not exceed it is zero.
    """
    def beyond(total, *parts):
        return math.sqrt(max(0.0, total**2 - sum(part**2 for part in parts)))

    lattice, noise, fit, potentials = (deviations[key] for key in ("lattice", "noise", "fit", "potentials"))
    statistics_part = beyond(noise, lattice)
    return {"statistics": statistics_part, "model": beyond(fit, lattice, statistics_part),
            "potential": beyond(potentials, lattice), "lattice": lattice}


def thresholds(options, material, tier):
    """Rows of the release thresholds of a material: text -> (mean, standard deviation) in GPa."""
    report = call([options.bin.resolve() / "whipple", "eos", "hugoniot", material, "--from", "1 km/s", "--to", "4 km/s",
                   "--points", 2, "--samples", options.threshold_samples, "--tier", tier]).stdout
    return {text: (float(mean), float(deviation)) for text, mean, deviation, _, _ in THRESHOLD.findall(report)}


def uncertainty_section(options, ensemble):
    centre, samples = {}, {}
    for body in BODIES:
        for tier in TIERS:
            material, samples[body, tier] = fitted(options, body, options.members, tier)
            centre[body] = material or centre[body]
    own = [f"body.{number}.material={centre[body]}" for body, (_, number, _) in BODIES.items()]
    cell = float(options.cell.split()[0])
    unit = options.cell.split()[1]
    central = ensemble.run("central", own)
    print("central", central, flush=True)
    grids = {factor: central if factor == 1.0 else
             ensemble.run(f"grid_{factor:g}", own, cell=f"{factor * cell:g} {unit}") for factor in GRIDS}
    print("grids done", flush=True)
    lattice = [central] + [ensemble.run(f"shift_{shift:g}", [*own, shifted(options.cell, shift)]) for shift in SHIFTS]
    members = {}
    for (body, tier), files in samples.items():
        number = BODIES[body][1]
        for index, file in enumerate(files, start=1):
            changes = [change for change in own if not change.startswith(f"body.{number}.")]
            members.setdefault((body, tier), []).append(
                ensemble.run(f"{body}_{tier}_{index}", [*changes, f"body.{number}.material={file}"]))
        print(f"{body}, {tier} done", flush=True)
    rows = []
    for key, (heading, _, decimals) in MEASURES.items():
        deviations = {"lattice": spread([run[key] for run in lattice])[1]}
        for tier in TIERS:  # disk and plate are drawn by themselves: their variances add up, the lattice's once
            parts = [spread([run[key] for run in members[body, tier]])[1] for body in BODIES if (body, tier) in members]
            if not parts:
                parts = [deviations["lattice"]]
            excess = (len(parts) - 1) * deviations["lattice"]**2
            deviations[tier] = math.sqrt(max(0.0, sum(part**2 for part in parts) - excess))
        parts = split(deviations)
        grid = grid_study([(factor * cell, grids[factor][key]) for factor in GRIDS],
                          STUDENT[len(lattice)] * parts["lattice"])
        disk_potential = spread([run[key] for run in members.get(("disk", "potentials"), [])])[1]
        number = f".{decimals}f"
        band = math.hypot(*[1.96 * parts[part] for part in ("statistics", "model", "potential")],
                          STUDENT[len(lattice)] * parts["lattice"], grid.band)
        rows.append([heading, f"{central[key]:{number}}", *[f"{1.96 * parts[part]:{number}}" for part in
                     ("statistics", "model", "potential")], f"{1.96 * disk_potential:{number}}",
                     f"{STUDENT[len(lattice)] * parts['lattice']:{number}}", f"{grid.band:{number}} ({grid.state})",
                     f"{band:{number}}", f"{grid.value:{number}}"])
    text = table(["", f"central, {options.cell}", "statistics", "model", "potential", "of it the disk's", "lattice", "grid",
                  "all together", f"central, {GRIDS[-1] * cell:g} {unit}"], rows)
    return text


def thresholds_section(options):
    rows = []
    for body, (metal, _, _) in BODIES.items():
        several = fitted(options, body, 1, "potentials")[0]
        material = several or fitted(options, body, 1, "fit")[0]
        by_tier = {tier: thresholds(options, material, tier) for tier in ((*TIERS, "all") if several else ("noise", "fit"))}
        for threshold, (mean, _) in by_tier["fit"].items():
            rows.append([metal, threshold, f"{mean:.1f}",
                         *[f"{by_tier[tier].get(threshold, (math.nan, math.nan))[1]:.1f}" if tier in by_tier
                           else "one potential" for tier in (*TIERS, "all")]])
        print(f"{metal} done", flush=True)
    return table(["material", "shock pressure at which", "mean, GPa", "noise", "fit with its defaults", "potentials",
                  "all"], rows)


QUANTITY = r'(?m)^{} = "?([-+0-9.e]+)( [^"#\n]*)?"?'


def changed(text, name, value):
    """Text of a material file with another value of one constant of [eos], in the unit that it has."""
    found = re.search(QUANTITY.format(re.escape(name)), text)
    unit = (found[2] or "").rstrip()
    written = f'"{value:.8g}{unit}"' if unit else f"{value:.8g}"
    return text[:found.start()] + f"{name} = {written}" + text[found.end():]


def alternatives(material):
    """Defaults of a fitted material with the values beside them: one error where it is known, else a tenth."""
    text = material.read_text(encoding="utf-8")
    errors = tomllib.loads(text)["default_errors"]
    known = dict(zip(errors["names"], errors["errors"], strict=True))
    for name in [*errors["names"], *errors["unknown"]]:
        if name in NOT_CHANGED:
            continue
        found = re.search(QUANTITY.format(re.escape(name)), text)
        value, unit = float(found[1]), (found[2] or "").strip()
        size = known[name] / SI[unit] if name in known else TENTH * value
        if size == 0.0:
            continue
        yield name, f"{found[1]} {unit}".strip(), "one error" if name in known else "a tenth", value - size, value + size


# Practical units of the fitted materials in SI.
SI = {"K": 1.0, "kJ cm^3/g^2": 1.0, "mJ/(mol K^2)": 1e-3, "J/(mol K)": 1.0, "": 1.0}


def defaults_section(options, ensemble):
    centre = {body: fitted(options, body, 1, "fit")[0] for body in BODIES}
    own = [f"body.{number}.material={centre[body]}" for body, (_, number, _) in BODIES.items()]
    central = ensemble.run("central", own)
    folder = options.output.resolve() / "materials/defaults"
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for body, (metal, number, _) in BODIES.items():
        text = centre[body].read_text(encoding="utf-8")
        for name, value, size, low, high in alternatives(centre[body]):
            differences = {}
            for side, other in (("low", low), ("high", high)):
                file = folder / f"{body}_{name}_{side}.toml"
                file.write_text(changed(text, name, other), encoding="utf-8")
                if call([options.bin.resolve() / "whipple", "eos", "state", file, "--density", "9 g/cm^3", "--temperature",
                         "300 K"], allowed=(0, 2, 3)).returncode == 2:
                    differences[side] = None  # no material
                    continue
                changes = [change for change in own if not change.startswith(f"body.{number}.")]
                run = ensemble.run(file.stem, [*changes, f"body.{number}.material={file}"])
                differences[side] = {key: run[key] - central[key] for key in MEASURES}
            cells = []
            for key, (_, _, decimals) in MEASURES.items():
                cells.append(" / ".join("no material" if one is None else f"{one[key]:+.{decimals}f}"
                                        for one in (differences["low"], differences["high"])))
            rows.append([metal, name, value, size, *cells])
            print(f"{body}, {name} done", flush=True)
    return table(["", "default", "value", "changed by", *[heading for heading, _, _ in MEASURES.values()]], rows)


def write(section, text):
    page = PAGE.read_text(encoding="utf-8")
    head, rest = page.split(f"<!-- {section}: begin -->")
    tail = rest.split(f"<!-- {section}: end -->")[1]
    PAGE.write_text(f"{head}<!-- {section}: begin -->\n\n{text}\n<!-- {section}: end -->{tail}", encoding="utf-8")
    print(text)


PARTS = ("bands", "thresholds", "defaults")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    parser.add_argument("--members", type=int, default=12)
    parser.add_argument("--cell", default="0.4 mm")
    parser.add_argument("--threshold-samples", type=int, default=100)
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS,
                        help="bands of the impact; release thresholds of each tier; defaults, one at a time (default: all)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "run/impact_uncertainty")
    options = parser.parse_args()
    ensemble = Ensemble(options)
    sections = {"bands": lambda: uncertainty_section(options, ensemble), "thresholds": lambda: thresholds_section(options),
                "defaults": lambda: defaults_section(options, ensemble)}
    for part in options.parts:
        write(part, sections[part]())


if __name__ == "__main__":
    main()
