# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the bands, thresholds that the program prints, and materials with one changed default."""
import math
import pathlib
import tempfile
import unittest

from studies.impact_uncertainty import impact_uncertainty as study

MATERIAL = """name = "copper"
[eos]
melting_temperature = "1790 K"  # default, +- 38 K
electronic_heat_coefficient = "0.69 mJ/(mol K^2)"
join_shape = 1
hugoniot_cubic = 0
[default_errors]
names = ["melting_temperature"]
errors = [3.8e+01]
unknown = ["electronic_heat_coefficient", "hugoniot_cubic", "join_shape"]
"""


class Bands(unittest.TestCase):
    def test_parts_add_up_to_the_ensembles(self):
        parts = study.split({"lattice": 3.0, "noise": 5.0, "fit": 13.0, "potentials": 5.0})
        self.assertEqual(parts["statistics"], 4.0)
        self.assertAlmostEqual(math.hypot(parts["model"], parts["statistics"], 3.0), 13.0)
        self.assertEqual(parts["potential"], 4.0)

    def test_what_the_lattice_explains_is_no_error_of_the_fit(self):
        parts = study.split({"lattice": 3.0, "noise": 2.0, "fit": 2.9, "potentials": 3.0})
        self.assertEqual((parts["statistics"], parts["model"], parts["potential"]), (0.0, 0.0, 0.0))

    def test_spread_leaves_out_what_is_not_finite(self):
        self.assertEqual(study.spread([1.0, math.nan, 3.0]), (2.0, math.sqrt(2.0)))
        self.assertTrue(math.isnan(study.spread([1.0])[1]))

    def test_the_grid_moves_by_cells_of_any_unit(self):
        self.assertEqual(study.shifted("0.4 mm", 0.25), 'domain.lower=["0 mm", "0 mm", "-36.1 mm"]')
        self.assertEqual(study.shifted("400 um", 0.25), study.shifted("0.4 mm", 0.25))

    def test_thresholds_are_read(self):
        found = study.THRESHOLD.findall("melting on release begins at 132.1 +- 1.1 GPa (100 of 100 samples)\n")
        self.assertEqual(found, [("melting on release begins at", "132.1", "1.1", "100", "100")])


class Defaults(unittest.TestCase):
    def test_alternatives_are_one_error_or_a_tenth(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "copper.toml"
            file.write_text(MATERIAL, encoding="utf-8")
            found = {name: (value, size, low, high) for name, value, size, low, high in study.alternatives(file)}
        self.assertEqual(found["melting_temperature"], ("1790 K", "one error", 1752.0, 1828.0))
        self.assertEqual(found["join_shape"], ("1", "a tenth", 0.9, 1.1))
        self.assertNotIn("hugoniot_cubic", found)
        self.assertEqual(found["electronic_heat_coefficient"][1], "a tenth")

    def test_one_constant_is_changed(self):
        text = study.changed(MATERIAL, "melting_temperature", 1752.0)
        self.assertIn('melting_temperature = "1752 K"  # default', text)
        self.assertEqual(text.replace('"1752 K"', '"1790 K"'), MATERIAL)
        self.assertIn("join_shape = 1.1\n", study.changed(MATERIAL, "join_shape", 1.1))
