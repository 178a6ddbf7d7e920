# SPDX-License-Identifier: BSD-3-Clause
"""Reading of the calibration table, and that the named potentials and measurements are there."""
import unittest

from studies.fit_calibration import fit_calibration as study

REPORT = """
experiment             kind      material       points  range   rms   mean  largest  unit
cu_hugoniot_marsh1980  Hugoniot  copper_mishin     144  up 0.21 km/s ... 4.16 km/s  1.69  -0.21  -4.0  % of Us
calibration with 400 samples
experiment             material       points  half-width  measurement  in band  50 %  68 %  80 %  90 %  95 %   99 %
cu_hugoniot_marsh1980  copper_mishin     144      2.50 %       0.90 %   96.5 %  50.0  70.1  81.9  93.1  97.9  100.0
"""


class Calibration(unittest.TestCase):
    def test_plans_and_measurements_are_there(self):
        for metal, (central, others, experiments) in study.METALS.items():
            for name in [central, *others, *study.FURTHER.get(metal, [])]:
                self.assertTrue((study.ROOT / f"cases/md/{name}_short.toml").is_file(), name)
            for name in experiments:
                self.assertTrue((study.ROOT / f"eos/data/{name}.csv").is_file(), name)

    def test_rows_of_the_program_are_read(self):
        rows = study.calibration_rows(REPORT)
        self.assertEqual(list(rows), ["cu_hugoniot_marsh1980"])
        row = rows["cu_hugoniot_marsh1980"]
        self.assertEqual((row["points"], row["width"], row["error"], row["band"]), (144, 2.5, 0.9, 96.5))
        self.assertEqual(row["levels"], {50: 50.0, 68: 70.1, 80: 81.9, 90: 93.1, 95: 97.9, 99: 100.0})

    def test_deviations_are_those_of_the_comparison(self):
        found = study.deviations(REPORT, ["cu_hugoniot_marsh1980"])
        self.assertEqual(found["cu_hugoniot_marsh1980"], "1.69 (-0.21) % of Us")

    def test_sections_name_what_makes_no_fit(self):
        rows = {study.TIERS["fit"]: study.calibration_rows(REPORT)}
        text = study.sections({"copper": (rows, {"copper_zhou": "no points"}, {})})
        self.assertIn("| copper | cu_hugoniot_marsh1980 | the fit | 144 | 2.50 % | 0.90 % | 97.9 % | 96.5 % |  |", text)
        self.assertIn("Copper, copper_zhou: no fit, no points.", text)

    def test_rows_of_other_metals_are_kept(self):
        rows = {"nickel": ({study.TIERS["fit"]: {"ni_hugoniot_marsh1980": study.calibration_rows(REPORT)["cu_hugoniot_marsh1980"]}}, {}, {})}
        former = ("| metal | measurement |\n| --- | --- |\n| copper | one | the fit | 144 |  |\n| nickel | old | the fit | 18 |  |\n")
        text = study.sections(rows, study.former_rows(former, rows))
        self.assertIn("| copper | one | the fit | 144 |  |", text)
        self.assertNotIn("old", text)
        self.assertIn("| nickel | ni_hugoniot_marsh1980 | the fit | 144 |", text)
