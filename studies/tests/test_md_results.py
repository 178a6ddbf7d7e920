# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the molecular-dynamics constants, and that their plans and measurements are there."""
import types
import unittest

from studies.md_results import md_results as study


class Tables(unittest.TestCase):
    def test_plans_and_measurements_are_there(self):
        for potentials, experiments in study.METALS.values():
            for name in potentials:
                self.assertTrue((study.ROOT / f"cases/md/{name}_short.toml").is_file(), name)
            for name in experiments:
                self.assertTrue((study.ROOT / f"eos/data/{name}.csv").is_file(), name)

    def test_a_table_is_markdown(self):
        self.assertEqual(study.table(["a", "b"], [["1", "2"]]), "| a | b |\n| --- | --- |\n| 1 | 2 |\n")

    def test_distance_is_the_rms_of_relative_deviations(self):
        keys = ("hugoniot_intercept", "hugoniot_slope", "gruneisen", "gruneisen_slope")
        fit = types.SimpleNamespace(values=dict(zip(keys, (4.0, 1.5, 2.0, 1.5))))
        self.assertAlmostEqual(study.distance(fit, (0.0, 4.0, 1.5, 2.0, 1.0, 0.0)), 0.25)

    def test_published_constants_are_those_of_the_fit(self):
        report = ("                                                    V0       C      S  gamma0     a\n"
                  "copper_mishin                          0.11185(12)  3.9(1)  1.4(1)  2.0  1.5  7.0  1800  9.1\n"
                  "experiment (Anderson et al. 1990; Steinberg 1996)  0.08818  2.092  1.450   2.740  2.20  2.98  760\n")
        self.assertEqual(study.published_rows(report), {
            "experiment (Anderson et al. 1990; Steinberg 1996)": (0.08818, 2.092, 1.45, 2.74, 2.2, 760.0)})

    def test_a_section_says_why_there_is_no_fit(self):
        fit = types.SimpleNamespace(fault="whipple fit: no points", label="one")
        self.assertIn("| one | no fit: no points |", study.metal_section("lead", [fit], []))

    def test_the_largest_factor_names_its_kind_of_data(self):
        self.assertEqual(study.largest_factor({"inflation_shock_velocity": 4.44, "inflation_heat_of_fusion": 1.0,
                                               "model_error_volume": 9.0}), "4.4 (shock velocity)")
        self.assertEqual(study.largest_factor({"inflation_shock_velocity": 1.0}), "1")

    def test_deviations_are_those_of_the_table_and_not_of_its_notes(self):
        report = ("experiment             kind      material   points  range                   rms    mean  largest  unit\n"
                  "cu_hugoniot_marsh1980  Hugoniot  copper_u3     144  up 0.21 ... 4.16 km/s  4.85   -4.46    -9.48  % of Us\n"
                  "cu_hugoniot_marsh1980: lines 7-26 initially denser than copper_u3 by more than 1 %, compared as of its density\n")
        self.assertEqual(study.deviation_of(report, "cu_hugoniot_marsh1980", "copper_u3"), "4.85 % of Us")
        self.assertIsNone(study.deviation_of(report, "cu_hugoniot_marsh1980", "copper_u6"))
