# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the molecular-dynamics constants, and that their plans and measurements are there."""
import types
import unittest

from studies.md_results import md_results as study


class Tables(unittest.TestCase):
    def test_plans_and_measurements_are_there(self):
        for metal, (potentials, experiments) in study.METALS.items():
            for name in potentials:
                self.assertTrue((study.ROOT / f"cases/md/{name}_short.toml").is_file(), name)
            for name in experiments:
                self.assertTrue((study.ROOT / f"eos/data/{name}.csv").is_file(), name)
            self.assertIn(metal, study.PUBLISHED)

    def test_a_table_is_markdown(self):
        self.assertEqual(study.table(["a", "b"], [["1", "2"]]), "| a | b |\n| --- | --- |\n| 1 | 2 |\n")

    def test_distance_is_the_rms_of_relative_deviations(self):
        keys = ("hugoniot_intercept", "hugoniot_slope", "gruneisen", "gruneisen_slope")
        fit = types.SimpleNamespace(values=dict(zip(keys, (4.0, 1.5, 2.0, 1.5))))
        self.assertAlmostEqual(study.distance(fit, (0.0, 4.0, 1.5, 2.0, 1.0, 0.0)), 0.25)

    def test_a_section_says_why_there_is_no_fit(self):
        fit = types.SimpleNamespace(fault="whipple fit: no points", label="one")
        self.assertIn("| one | no fit: no points |", study.metal_section("lead", [fit], []))
