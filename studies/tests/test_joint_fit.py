# SPDX-License-Identifier: BSD-3-Clause
"""Plans and tables of the joint fits are there, and deviations are counted as stated."""
import unittest

from studies.joint_fit import joint_fit as study
from studies.joint_fit import published_lines


class JointFit(unittest.TestCase):
    def test_plans_materials_and_measurements_are_there(self):
        for plan, handbook, _, tables, checks in study.METALS.values():
            self.assertTrue((study.ROOT / f"cases/md/{plan}.toml").is_file(), plan)
            self.assertTrue((study.ROOT / f"eos/materials/{handbook}.toml").is_file(), handbook)
            for name in tables + checks:
                self.assertTrue((study.ROOT / f"eos/data/{name}.csv").is_file(), name)
            self.assertFalse(set(tables) & set(checks))

    def test_every_table_of_the_metal_takes_part(self):
        for prefix, metal in (("cu_", "copper"), ("al_", "aluminium"), ("ni_", "nickel"), ("ta_", "tantalum")):
            *_, tables, checks = study.METALS[metal]
            found = {path.stem for path in (study.ROOT / "eos/data").glob(f"{prefix}*.csv")
                     if "_tpa_" not in path.stem}  # beyond the reach of GRAY: studies/wide_range
            self.assertEqual(found, {name for name in tables + checks if name.startswith(prefix)})

    def test_deviations_are_relative_and_within_the_range(self):
        rows = [{"experiment": "a", "measured": "2", "model": "2.2"}, {"experiment": "a", "measured": "4", "model": "3.6"},
                {"experiment": "a", "measured": "1", "model": "nan"}, {"experiment": "b", "measured": "0", "model": "1"}]
        found = study.relative_rms(rows)
        self.assertEqual(list(found), ["a"])
        self.assertAlmostEqual(found["a"], 10.0)

    def test_published_lines_and_their_range(self):
        self.assertEqual(published_lines.bounds("Up 1-4.5"), (1.0, 4.5))
        self.assertEqual(published_lines.bounds("approximate")[0], 0.0)
        self.assertAlmostEqual(published_lines.rms([0.03, -0.04]), 100.0 * (0.00125) ** 0.5)
        rows = {(metal, line.split(":")[0]): (int(points), float(rms.split()[0])) for metal, _, line, points, rms in published_lines.lines()}
        points, deviation = rows["copper", "3.913 + 1.508 up"]
        self.assertEqual(points, 143)
        self.assertTrue(all(deviation <= other for (metal, _), (_, other) in rows.items() if metal == "copper"))


if __name__ == "__main__":
    unittest.main()
