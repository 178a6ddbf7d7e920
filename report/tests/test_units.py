# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as they are printed, and words for the input."""
import math
import unittest

from report import case_text, units


class Numbers(unittest.TestCase):
    def test_what_is_missing_is_a_dash(self):
        self.assertEqual([units.number(None), units.number(math.nan)], ["–", "–"])
        self.assertEqual([units.number(5550.0), units.number(1 / 3, 2), units.number(0)], ["5550", "0.33", "0"])

    def test_units_of_the_field(self):
        self.assertEqual([units.mass(2e-3), units.mass(5e-5)], ["2 g", "50 mg"])
        self.assertEqual([units.time(7.25e-6), units.percent(0.0123), units.percent(1.23)], ["7.25 µs", "1.2 %", "120 %"])
        self.assertEqual([units.error(3e-15), units.error(-2.34e-3)], ["round-off", "-0.0023"])


class Quantities(unittest.TestCase):
    def test_si_becomes_the_unit_of_the_field(self):
        for text, shown in (("0.004 m", "4 mm"), ("2.5e-06 m", "2.5 µm"), ("1e-05 s", "10 µs"), ("5e-09 s", "5 ns"),
                            ("6580 m/s", "6.58 km/s"), ("3 m/s", "3 m/s"), ("0 m", "0")):
            self.assertEqual(units.quantity(text), shown)

    def test_other_texts_stay(self):
        for text in ("copper.toml", "quadratic_bspline", "300 K", "8", "two words"):
            self.assertEqual(units.quantity(text), text)


class Input(unittest.TestCase):
    def test_values_without_program_text(self):
        self.assertEqual(case_text.describe_value({"x_lower": "symmetry", "turned": True, "at": ["0 m", "0.002 m"]}),
                         "x lower symmetry, turned yes, at (0, 2 mm)")
        self.assertEqual(case_text.describe_shape({"sphere": {"radius": "0.001 m"}}), "sphere (radius 1 mm)")

    def test_keys_of_meshes_that_are_not_there_are_left_out(self):
        keys = {"method": "particles", "per_cell": 8, "element_size": "0.001 m", "mesh": "", "mesh_unit": "m",
                "hourglass_coefficient": 0.1, "bar_diameter": "0.01 m"}
        self.assertEqual(case_text.describe_discretization(keys), "particles; per cell 8")
        self.assertEqual(case_text.describe_discretization({"method": "finite_elements", "element_size": "0.001 m"}),
                         "finite elements; element size 1 mm")
