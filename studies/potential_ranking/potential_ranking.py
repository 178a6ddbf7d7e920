#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Ranks the potentials of ten metals for shocks: runs what is missing of their short plans, fits every store, compares points and fits with
measurements by the rule of README.md (rule.py), and writes the tables there.

Usage: studies/potential_ranking/potential_ranking.py [--bin build/release/bin] [--stores run/md] [--ranks N] [--no-md] [--speeds]
"""
import argparse
import csv
import dataclasses
import io
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402
from studies.potential_ranking import rule  # noqa: E402
from studies.potential_ranking.measured import METALS, Reference  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent
PAGE, SPEEDS = FOLDER / "README.md", FOLDER / "speeds.csv"
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"
GPA, KM_S = 1e9, 1e3


class Store:
    """What the ranking needs of a store of `whipple md`, in GPa, km/s and cm^3/g."""

    def __init__(self, path):
        import h5py  # here, since the tests of the rule need none

        self.shocks, self.isotherm, self.melting, self.volume = [], [], None, None
        self.structure = self.stable_to = ""
        self.lost = {"hugoniot": [], "isotherm": []}  # specific volumes where the crystal was lost or the point failed
        self.volumes = {"hugoniot": [], "isotherm": []}  # of the whole crystals
        with h5py.File(path) as file:
            for point in file["points"].values():
                protocol = point.attrs["protocol"].decode()
                done = point.attrs["status"] == b"done"
                if done and not ("solid" in point["results"] and point["results"]["solid"][0] == 0.0):
                    self._take(protocol, point)
                elif protocol in self.lost:
                    self.lost[protocol].append(1e3 * float(point["conditions"]["specific_volume"][0]))

    def _take(self, protocol, point):
        def result(name):
            return float(point["results"][name][0])

        def condition(name):
            return float(point["conditions"][name][0])

        provenance = point["provenance"].attrs
        self.structure = provenance["structure"].decode()
        if "validity_pressure" in provenance:
            self.stable_to = provenance["validity_pressure"].decode()
        if protocol == "hugoniot":
            self.shocks.append((result("particle_velocity") / KM_S, result("shock_velocity") / KM_S))
            self.volumes["hugoniot"].append(1e3 * condition("specific_volume"))
        elif protocol == "zero_pressure_volume" and condition("temperature") < 310.0:
            self.volume = 1e3 * result("specific_volume")
        elif protocol == "isotherm" and condition("temperature") < 310.0:
            self.volumes["isotherm"].append(1e3 * condition("specific_volume"))
            self.isotherm.append((1e3 * condition("specific_volume"), result("pressure") / GPA))
        elif protocol == "coexistence" and condition("pressure") == 0.0:
            self.melting = result("melting_temperature")

    def ends_by_itself(self, protocol):
        """Whether the potential and not its plan ends a curve: the crystal was lost, or the point failed, where it is denser still."""
        return bool(self.lost[protocol]) and min(self.lost[protocol]) < min(self.volumes[protocol], default=0.0)

    def shock_curve(self):
        return rule.Curve([up for up, _ in self.shocks], [us for _, us in self.shocks])

    def isotherm_curve(self):
        """P as a function of V/V0: the factor F of Birch joined by straight lines over the strain."""
        points = [(volume / self.volume, pressure) for volume, pressure in self.isotherm if volume < 0.985 * self.volume]
        factor = rule.Curve([rule.strain(ratio) for ratio, _ in points], [pressure / rule.birch_factor(ratio) for ratio, pressure in points])

        def pressure(ratio):
            value = factor(rule.strain(ratio))
            return None if value is None else value * rule.birch_factor(ratio)

        return pressure


@dataclasses.dataclass
class Judged(rule.Candidate):
    """A candidate with what the table shows beside its score: how far shocks and isotherm stay within their bounds, each a pressure and
    whether that may not be the end, and to which pressure the crystal is that of lowest energy."""

    label: str = ""
    shocks_to: tuple = (0.0, False)
    isotherm_to: tuple = None
    stable_to: str = ""


def fitted_curve(binaries, store, material):
    """Us(up) of the fitted material, and why there is none."""
    result = call([binaries / "whipple-fit", store, "-o", material, "--force"], allowed=(0, 2, 3))
    if result.returncode:
        return None, result.stderr.strip().splitlines()[-1].replace(str(store), store.name)
    for top in (210, 180, 150, 120, 105, 90, 70, 50, 30):  # the largest that the range of the fit allows
        table = call([binaries / "whipple", "eos", "hugoniot", material, "--to", f"{top} GPa", "--points", 80, "--csv", "-"], allowed=(0, 2, 3))
        if table.returncode == 0:
            lines = [line for line in table.stdout.splitlines() if not line.startswith("#")]
            rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
            return rule.Curve([float(row["up_km_s"]) for row in rows], [float(row["us_km_s"]) for row in rows]), ""
    return None, "no Hugoniot to 30 GPa"


def judge(name, label, metal, reference, store, fit, fault, speed):
    """The candidate of the rule, with what the table shows beside its score."""
    shocks = store.shock_curve()
    places = rule.even(*reference.window)
    deviations = {"points": rule.root_mean_square(shocks, reference.velocity, places, rule.BOUNDS["points"]), "fit": None,
                  "isotherm": None, "density": store.volume * reference.density - 1.0, "melting": None}
    if fit:
        deviations["fit"] = rule.root_mean_square(fit, reference.velocity, places, rule.BOUNDS["fit"])
    if store.melting:
        deviations["melting"] = store.melting / metal.melting_point - 1.0
    isotherm_to = None
    if reference.isotherm:
        curve = store.isotherm_curve()
        ratios = reference.isotherm_ratios(*reference.pressures)
        deviations["isotherm"] = rule.root_mean_square(curve, reference.isotherm_pressure, ratios, rule.BOUNDS["isotherm"])
        isotherm_to = reference.valid_on_isotherm(curve, store.ends_by_itself("isotherm"))
    shocks_to = reference.valid_on_hugoniot(shocks, store.ends_by_itself("hugoniot"))
    validity = min(end[0] for end in (shocks_to, isotherm_to) if end)
    return Judged(name, deviations, store.structure == metal.structure, fault, validity, speed, label, shocks_to, isotherm_to,
                  store.stable_to)


def percent(value, sign=False):
    return "" if value is None else f"{100.0 * value:{'+' if sign else ''}.1f}"


def end_text(end):
    """A pressure of validity: empty where nothing was measured."""
    if end is None:
        return ""
    pressure, is_open = end
    return f"{'> ' if is_open else ''}{pressure:.0f}" if pressure else f"< {rule.LOWEST:.0f}"


def row_of(candidate, place, last):
    deviations = candidate.deviations
    melting = "not asked" if deviations["melting"] is None else percent(deviations["melting"], sign=True)
    stable_to = f"{float(candidate.stable_to.split()[0]):.0f}" if candidate.stable_to else ""
    return [place, candidate.label, percent(deviations["points"]), percent(deviations["fit"]), percent(deviations["isotherm"]),
            percent(deviations["density"], sign=True), melting, end_text(candidate.shocks_to), end_text(candidate.isotherm_to),
            stable_to, f"{candidate.speed:.1e}" if candidate.speed else "", last]


def table(headings, rows):
    return "\n".join(["| " + " | ".join(headings) + " |", "|" + " --- |" * len(headings)]
                     + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def section(metal, reference, candidates, missing):
    scored, out = rule.rank(candidates)
    rows = [row_of(one, str(place), f"{value:.2f}") for place, (one, value) in enumerate(scored, 1)]
    rows += [row_of(one, "", f"out: {reason}") for one, reason in out]
    rows += [["", label, *[""] * 9, f"out: {why}"] for label, why in missing]
    begin, end = reference.pressures
    text = f"## {metal.capitalize()}\n\n{reference.text}; window {begin:.0f} to {end:.0f} GPa.\n\n"
    return text + table(["rank", "potential", "Us, points %", "Us, fit %", "isotherm %", "V0 %", "T_m %", "Us within 2 % to GPa",
                         "P within 5 % to GPa", "own crystal to GPa", "atom-steps/s", "score"], rows)


def summary(best):
    """Of each metal the potential to take, to which pressure, and the next one."""
    rows = []
    for metal, scored in best:
        if not scored:
            rows.append([metal, "none qualified", *[""] * 5])
            continue
        one, value = scored[0]
        following = f"{scored[1][0].label} ({scored[1][1]:.2f})" if len(scored) > 1 else ""
        rows.append([metal, one.label, f"{value:.2f}", percent(one.deviations["points"]), end_text(one.shocks_to),
                     end_text(one.isotherm_to), following])
    return table(["metal", "take", "score", "Us, points %", "Us within 2 % to GPa", "P within 5 % to GPa", "next"], rows)


def speed_of(binaries, plan):
    """Atoms times steps per second of one processor, as `whipple-md` measures at its start; it is stopped after that line."""
    with tempfile.TemporaryDirectory() as folder:
        command = [binaries / "whipple-md", plan, "-o", pathlib.Path(folder) / "speed.md.h5"]
        with subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT) as process:
            found = None
            for line in process.stdout:
                if found := re.search(r"atom-steps at ([\d.e+]+) per second of one processor", line):
                    break
            process.kill()
    return float(found[1]) if found else 0.0


def read_speeds():
    if not SPEEDS.is_file():
        return {}
    with SPEEDS.open(encoding="utf-8") as file:
        return {row["plan"]: float(row["atom_steps_per_s"]) for row in csv.DictReader(file)}


def write_speeds(speeds):
    lines = [f"{plan},{value:.2g}" for plan, value in sorted(speeds.items())]
    SPEEDS.write_text("plan,atom_steps_per_s\n" + "\n".join(lines) + "\n", encoding="utf-8")


def candidates_of(name, metal, options, speeds):
    """The potentials of a metal that have points, and those that do not with the reason."""
    binaries, stores = options.bin.resolve(), options.stores.resolve()
    reference = Reference(metal)
    found, missing = [], []
    for plan, label in metal.potentials.items():
        store = stores / f"{plan}.md.h5"
        for suffix in () if options.no_md else ("", "_strong", "_melting_point"):
            file = ROOT / "cases/md" / f"{plan.removesuffix('_short')}{suffix or '_short'}.toml"
            if file.is_file():
                ranks = ["--ranks", options.ranks] if options.ranks else []
                call([binaries / "whipple", "md", file, "-o", store, "-q", *ranks], allowed=(0, 2, 3))
        if not store.exists():
            missing.append((label, "no points"))
            continue
        data = Store(store)
        if not data.volume or len(data.shocks) < 2:
            missing.append((label, f"{len(data.shocks)} shock points"))
            continue
        if options.speeds or plan not in speeds:
            speeds[plan] = speed_of(binaries, ROOT / "cases/md" / f"{plan}.toml")
        fit, fault = fitted_curve(binaries, store, store.with_suffix("").with_suffix(".toml"))
        found.append(judge(plan, label, metal, reference, data, fit, fault, speeds[plan]))
        if fault:
            print(f"{name}, {label}: {fault}")
    return reference, found, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    parser.add_argument("--ranks", type=int, default=0)
    parser.add_argument("--no-md", action="store_true", help="take the stores as they are")
    parser.add_argument("--speeds", action="store_true", help="measure all speeds again")
    options = parser.parse_args()
    options.stores.mkdir(parents=True, exist_ok=True)
    speeds, sections, best = read_speeds(), [], []
    for name, metal in METALS.items():
        reference, candidates, missing = candidates_of(name, metal, options, speeds)
        sections.append(section(name, reference, candidates, missing))
        best.append((name, rule.rank(candidates)[0]))
        print(f"{name}: {len(candidates)} potentials", flush=True)
    write_speeds(speeds)
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    tail = rest.split(END)[1]
    body = f"{BEGIN}\n\n" + summary(best) + "\n" + "\n".join(sections) + f"\n{END}"
    PAGE.write_text(head + body + tail, encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
