#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far the materials of the library are from published tests of alloys, row by row of tests.csv.

usage: compare.py [--write | --check]

Prints the table as Markdown. --write stores it as docs/generated/alloy_tests.md, --check fails if that file is another one.
Computed from the constants alone, at a point, at 1e-3 1/s, room temperature and without heat by plastic work. Laws with a rate have
their factor 1 + C ln(rate/reference rate), that of the failure strain with D4; it is 1 below the reference rate, as in the program.
yield: flow stress at a plastic strain of 0.2 %; ultimate: the greatest of Y exp(-ep), where a bar necks (Considere), or where its
damage breaks it before (no damage there: up to a strain of 2.0); shear strength: Y/sqrt(3) at the failure strain in shear (no
damage there: at a strain of 1.0); fracture strain: that of the damage set at the triaxiality of the row; reduction of area:
ln(A0/A) against the failure strain at a triaxiality of 0.4, the mean of a neck. What needs a run (elongation, notches) or a law
that the library does not have (toughness) is said so.
"""
import argparse
import csv
import math
import pathlib
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY, TESTS, PAGE = ROOT / "eos/materials", ROOT / "studies/alloys/tests.csv", ROOT / "docs/generated/alloy_tests.md"
RATE, ROOM = 1e-3, 300.0  # 1/s, K
UNDAMAGED_TENSION, UNDAMAGED_SHEAR = 2.0, 1.0  # plastic strains up to which materials without damage there are followed
STRESS_UNITS = {"Pa": 1e-6, "MPa": 1.0, "GPa": 1e3}
OTHER_UNITS = {"K": 1.0, "1/s": 1.0, "1/K": 1.0, "1/GPa": 1e-3, "MPa/K": 1.0, "g/cm^3": 1e3, "g/mol": 1e-3}


def tables(stem):
    """Tables [strength] and [[failure]] of a material, merged with those of its base: those of one model key by key."""
    own = tomllib.loads((LIBRARY / f"{stem}.toml").read_text())
    if "base" not in own:
        return own
    merged = tables(own["base"])
    strength, above = own.get("strength", {}), merged.get("strength", {})
    same = strength.get("model", above.get("model")) == above.get("model")
    merged["strength"] = {**above, **strength} if same else strength
    if "failure" in own:
        merged["failure"] = own["failure"]
    return merged


def number(value):
    """A constant in MPa, K, 1/s, kg/m^3."""
    if isinstance(value, (int, float)):
        return float(value)
    text, _, unit = value.partition(" ")
    return float(text) * (STRESS_UNITS | OTHER_UNITS)[unit]


def rate_factor(constants, coefficient):
    """Factor of RATE: 1 at and below the reference rate, for the logarithm would soften slow flow without bound."""
    return 1.0 + constants.get(coefficient, 0.0) * math.log(max(1.0, RATE / constants.get("reference_rate", 1.0)))


class Law:
    """Flow stress (MPa) at RATE and room temperature, over the plastic strain."""

    def __init__(self, table):
        self.model = table.get("model", "none")
        self.c = {key: number(value) for key, value in table.items() if key not in ("model", "source", "note")}

    def __call__(self, strain):
        return getattr(self, self.model)(strain)

    def johnson_cook(self, strain):
        c = self.c
        hot = max(0.0, (ROOM - c["reference_temperature"]) / (c["melting_temperature"] - c["reference_temperature"]))
        hard = c["yield_stress"] + c["hardening_coefficient"] * strain ** c["hardening_exponent"]
        return hard * rate_factor(c, "rate_coefficient") * (1 - hot ** c["thermal_exponent"])

    def steinberg_guinan(self, strain):
        c = self.c
        hard = c["yield_stress"] * (1 + c["hardening_coefficient"] * (strain + c.get("initial_plastic_strain", 0.0))) ** c["hardening_exponent"]
        return min(hard, c["maximum_flow_stress"])

    def power_law(self, strain):
        return self.c["yield_stress"] + self.c["hardening_coefficient"] * strain ** self.c["hardening_exponent"]


class Damage:
    """Failure strain at RATE and room temperature, over the triaxiality."""

    def __init__(self, material):
        sets = [t for t in material.get("failure", []) if t["model"] == "johnson_cook_damage"]
        self.c = {key: number(value) for key, value in sets[0].items() if key not in ("model", "source", "note")} if sets else None

    def failure_strain(self, triaxiality):
        """None: no damage there."""
        c = self.c
        if c is None or not c.get("least_triaxiality", -math.inf) <= triaxiality <= c.get("greatest_triaxiality", math.inf):
            return None
        hot = max(0.0, (ROOM - c["reference_temperature"]) / (c["melting_temperature"] - c["reference_temperature"]))
        strain = (c["d1"] + c["d2"] * math.exp(c["d3"] * triaxiality)) * rate_factor(c, "d4") * (1 + c["d5"] * hot)
        return max(strain, c.get("least_failure_strain", 0.001))


def ultimate(law, damage):
    """Greatest force of a smooth bar over its first section (MPa), up to the neck or to its rupture."""
    broken = damage.failure_strain(1 / 3) or UNDAMAGED_TENSION
    return max(law(e) * math.exp(-e) for e in (i * 1e-3 for i in range(2, int(broken * 1000) + 1)))


def computed(row, law, damage):
    """What the constants give of a row in its unit, or the reason why nothing is compared."""
    quantity = row["quantity"]
    if quantity == "yield":
        return law(0.002)
    if quantity == "ultimate":
        return ultimate(law, damage)
    if quantity == "shear_strength":
        return law(damage.failure_strain(0.0) or UNDAMAGED_SHEAR) / math.sqrt(3)
    if quantity == "fracture_strain":
        return damage.failure_strain(float(row["triaxiality"])) or "no damage there"
    if quantity == "cut_off":
        return damage.c["least_triaxiality"]
    if quantity == "reduction_of_area":
        return damage.failure_strain(0.4) or "no damage"
    return {"elongation": "a run: cases/tension_of_alloys", "toughness": "no law: no material has the energy of a crack",
            "energy_of_crack": "no law: no material has the energy of a crack", "notched_strength": "no geometry",
            "velocity_at_which_the_head_breaks": "no geometry", "compressive_fracture_strain": "no damage in compression"}[quantity]


def measured(row):
    """Least and greatest value of a row: of a reduction of area, as strains."""
    low, _, high = row["value"].lstrip("> ").partition(" to ")
    values = [float(low), float(high or low)]
    return [-math.log(1 - v / 100) for v in values] if row["quantity"] == "reduction_of_area" else values


def difference(value, low, high):
    if low <= value <= high:
        return "within"
    near = low if value < low else high
    return f"{100 * (value - near) / abs(near):+.0f} %"


def lines():
    with TESTS.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    yield "# Alloys of the library beside published tests\n"
    yield "Generated by `studies/alloys/compare.py --write` from the constants of the library; what is computed how: its first lines."
    yield "\"memory\": quoted from memory, not checked: neither passed nor failed by it.\n"
    yield "| alloy | material | test | quantity | measured | computed | difference | class |\n| --- | --- | --- | --- | --- | --- | --- | --- |"
    far, compared = {}, 0
    for row in rows:
        show = f"{row['value']} {row['unit'].replace('-', '')}".strip()
        quantity = row["quantity"].replace("_", " ")
        if row["triaxiality"]:
            quantity += f" at {row['triaxiality']}"
        shown, apart = "", ""
        if not row["material"]:
            apart = "not in the library"
        else:
            material = tables(row["material"])
            value = computed(row, Law(material["strength"]), Damage(material))
            if isinstance(value, str):
                apart = value
            else:
                shown, apart = f"{value:.3g}", difference(value, *measured(row))
                compared += 1
                if row["class"] != "memory":
                    gap = 0.0 if apart == "within" else abs(float(apart.split()[0]))
                    far.setdefault(row["quantity"], []).append(gap)
        yield f"| {row['alloy']} | {row['material']} | {row['test']} | {quantity} | {show} | {shown} | {apart} | {row['class']} |"
    yield f"\n{len(rows)} rows, {compared} compared. Without those from memory, by quantity: rows, median and largest difference:\n"
    yield "| quantity | rows | median, % | largest, % |\n| --- | --- | --- | --- |"
    for quantity, gaps in far.items():
        gaps.sort()
        yield f"| {quantity.replace('_', ' ')} | {len(gaps)} | {gaps[len(gaps) // 2]:.0f} | {gaps[-1]:.0f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help=f"store the table as {PAGE.relative_to(ROOT)}")
    parser.add_argument("--check", action="store_true", help="exit code 1 if the stored table is another one")
    arguments = parser.parse_args()
    text = "\n".join(lines()) + "\n"
    if arguments.check:
        if PAGE.read_text() != text:
            print(f"{PAGE.relative_to(ROOT)} is out of date: studies/alloys/compare.py --write")
            return 1
    elif arguments.write:
        PAGE.write_text(text)
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
