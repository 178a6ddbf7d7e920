# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of docs/manual/findings.md are the stored ones."""
import functools
import json
import re
import unittest

from studies.commands import ROOT

PAGE = "docs/manual/findings.md"
UNITS = {"%": 1e-2, "mm": 1e-3, "m/s": 1.0, "km/s": 1e3, "GPa": 1e9, "MPa": 1e6, "us": 1e-6}
# Case, run, beginning of the quantity's name, value and band as they stand in the page. The unit is that of the text.
NUMBERS = [
    ("taylor_bars", "cu_allen_214_axisymmetric", "length", "23.98 +- 0.13 mm"),
    ("taylor_bars", "cu_z5_225_axisymmetric", "length", "20.25 +- 0.17 mm"),
    ("plate_impact_spall", "500_m_s", "fall of the free-surface velocity", "159 +- 23 m/s"),
    ("plate_impact_spall", "copper_308", "fall of the free-surface velocity", "71.7 +- 5.5 m/s"),
    ("plate_impact_spall", "titanium_653", "fall of the free-surface velocity", "288 +- 38 m/s"),
    ("plate_impact_spall", "500_m_s", "thickness of the spalled layer", "2.03 +- 0.17 mm"),
    ("plate_impact_spall", "copper_308", "history of the free-surface velocity", "4.0 +- 5.2 % (copper"),
    ("plate_impact_window", "598_m_s", "history of the stress", "34 +- 13 % at 598 m/s"),
    ("plate_impact_window", "765_m_s", "history of the stress", "12.8 +- 1.9 % at 765 m/s"),
    ("copper_disk_on_aluminium", "axisymmetric", "speed of the front", "8.30 +- 0.46 km/s"),
    ("copper_disk_on_aluminium", "axisymmetric", "solid fraction of the copper", "0.981 +- 0.049"),
    ("lead_sphere_on_plate_gray", "axisymmetric", "front of the cloud", "179.0 +- 0.7 mm"),
    ("lead_sphere_on_plate_gray", "axisymmetric", "fastest particle", "11.8 +- 14.5 km/s"),
    ("release_melting", "aluminium_below_completion", "melted fraction", "0.357 +- 0.031"),
    ("release_melting", "aluminium_plane_strain", "melted fraction", "0.357 +- 0.031"),
    ("whipple_shield", "below_limit_axisymmetric", "fraction of the wall left", "0.54 +- 1.46"),
    ("aluminium_crater", "6061_t6_axisymmetric", "depth of the crater", "15.35 +- 0.04 mm"),
    ("aluminium_crater", "6061_t6_axisymmetric", "diameter of the crater", "27.55 +- 0.42 mm"),
    ("aluminium_crater", "1100_o_axisymmetric", "depth of the crater", "19.04 +- 1.1 mm"),
    ("prater_6061", "1100_o", "depth of the crater, plateau", "18.5 +- 0.7 mm"),
    ("prater_6061", "von_mises_axisymmetric", "radius of the crater, plateau", "12.99 +- 0.14 mm"),
    ("prater_6061", "von_mises_axisymmetric", "depth of the crater, plateau", "15.0 +- 0.7 mm"),
    ("prater_6061", "1100_o_axisymmetric", "depth of the crater, plateau", "19.12 +- 0.05 mm"),
    ("shock_decay", "5_km_s", "peak pressure near the point of impact (0 to 0.6", "41.6 GPa"),
    ("shock_decay", "5_km_s_axisymmetric", "peak pressure near the point of impact (0 to 0.6", "45.4 +- 4.1 GPa"),
    ("shock_decay", "20_km_s_axisymmetric", "peak pressure near the point of impact (0 to 0.6", "489 +- 25 GPa"),
    ("shock_decay", "20_km_s_axisymmetric", "exponent of the decay", "2.47 +- 0.51"),
    ("hanchak_concrete", "1058_m_s_axisymmetric", "residual velocity", "814 +- 671 m/s"),
    ("hanchak_concrete", "606_m_s_axisymmetric", "residual velocity", "362 +- 13 m/s"),
    ("hanchak_concrete", "749_m_s_axisymmetric", "residual velocity", "517 +- 144 m/s"),
    ("hanchak_concrete", "434_m_s_axisymmetric", "residual velocity", "158 +- 53 m/s"),
    ("hanchak_concrete", "301_m_s_axisymmetric", "residual velocity", "20 +- 49 m/s"),
    ("ogive_rod_oblique_plate", "adaptive", "residual velocity", "316 +- 153 m/s"),
    ("ogive_rod_oblique_plate", "adaptive_frictionless", "residual velocity", "436 +- 525 m/s"),
    ("ceramic_penetration", "aluminium_nitride_axisymmetric", "penetration velocity", "1.95 +- 0.12 km/s"),
    ("ceramic_penetration", "boron_carbide_axisymmetric", "penetration velocity", "1.94 +- 0.21 km/s"),
    ("ceramic_penetration", "silicon_carbide_axisymmetric", "penetration velocity", "1.14 +- 0.42 km/s"),
    ("two_spheres", "multi_field", "velocity of the target", "98.3 +- 0.7 m/s"),
    ("cylinder_test", "tnt", "speed of the outer wall after 19 mm", "1377 +- 1 m/s"),
    ("cylinder_test", "composition_b", "speed of the outer wall after 19 mm", "1597 +- 1 m/s"),
    ("cylinder_test", "pbx_9404", "speed of the outer wall after 19 mm", "1783 +- 12 m/s"),
    ("jetting_plates", "copper", "velocity of the jet", "4106 +- 144 m/s"),
    ("shaped_charge_81mm", "composition_b", "axial velocity that 0.5 %", "7.99 km/s"),
    ("water_filled_tube", "2.8_g", "greatest speed of the wall", "103.7 +- 2.2 m/s"),
    ("water_filled_tube", "5.5_g", "greatest speed of the wall", "154.3 +- 0.6 m/s"),
    ("water_filled_tube", "2.8_g", "greatest displacement of the wall", "5.35 +- 0.41 mm"),
    ("water_filled_tube", "5.5_g", "greatest displacement of the wall", "9.08 +- 0.55 mm"),
    ("blast_near_field", "tnt", "peak pressure at 0.5 m", "3.4 +- 0.6 MPa"),
    ("rate_stick", "radius_16.7", "velocity of the front", "6212 +- 576 m/s"),
    ("dry_columns", "a_0_4", "radius at the end", "142 +- 22 mm"),
    ("dry_columns", "a_1_0", "radius at the end", "246 +- 30 mm"),
    ("foam_block", "50_m_s", "what 1 %", "95.3 +- 0.6 mm"),
    ("granular_column", "plane_strain", "run-out", "441 +- 28 mm"),
    ("slope_failure", "cohesion_10_kpa", "surface at 30 m", "13.53 +- 0.04 m"),
    ("shock_initiation", "10_gpa", "distance at which", "1.709 +- 0.027 mm"),
]
TEXT = re.compile(r"(?P<value>[\d.]+)(?: \+- (?P<band>[\d.]+))?(?: (?P<unit>[A-Za-z/%]+))?")


@functools.cache
def runs(case):
    stored = json.loads((ROOT / f"docs/generated/results/{case}.json").read_text(encoding="utf-8"))["runs"]
    return {run["name"]: run for run in stored}


def rounded(number, like):
    """The number with as many decimals as the text."""
    return f"{number:.{len(like.partition('.')[2])}f}"


def faults(numbers, page):
    """Numbers that do not stand in the page or are not the stored ones, one line each."""
    for case, run, name, text in numbers:
        where = f"{case}:{run}, {name}: {text}"
        if not re.search(rf"(?<![\d.]){re.escape(text)}", page):
            yield f"{where}: not in the page"
        quantity, = (q for q in runs(case)[run]["quantities"] if q["name"].startswith(name))
        parts = TEXT.match(text)
        unit = UNITS.get(parts["unit"], 1.0) if parts["unit"] else 1.0
        for part, stored in (("value", quantity["value"]), ("band", quantity["u_num"])):
            if (parts[part] is None) != (stored is None):
                yield f"{where}: {part} stored: {stored}"
            elif stored is not None and rounded(stored / unit, parts[part]) != parts[part]:
                yield f"{where}: {part} stored: {stored / unit:.6g}"


class Findings(unittest.TestCase):
    def setUp(self):
        self.page = " ".join((ROOT / PAGE).read_text(encoding="utf-8").split())

    def test_numbers_are_the_stored_values_and_bands(self):
        self.assertEqual(list(faults(NUMBERS, self.page)), [])

    def test_another_value_band_or_text_is_found(self):
        case, run, name, _ = NUMBERS[0]
        for text, count in (("23.99 +- 0.13 mm", 2), ("23.98 +- 0.14 mm", 2), ("23.98 mm", 2), ("3.98 +- 0.13 mm", 2)):
            self.assertEqual(len(list(faults([(case, run, name, text)], self.page))), count, text)


if __name__ == "__main__":
    unittest.main()
