# SPDX-License-Identifier: BSD-3-Clause
"""The table of alloys beside published tests."""
import pathlib
import subprocess
import sys
import unittest

from studies.alloys import compare

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Table(unittest.TestCase):
    def test_is_that_of_the_library(self):
        done = subprocess.run([sys.executable, ROOT / "studies/alloys/compare.py", "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"studies/alloys/compare.py --write\n{done.stdout}{done.stderr}")


class AtAPoint(unittest.TestCase):
    """By hand; T* is 7/600 of 7075-T651 and 6/631 of 6061-T6 at 300 K."""

    def test_rate_above_the_reference_hardens(self):
        # 7075-T651, reference rate 5e-4 1/s, ln(1e-3/5e-4) = 0.69315: (520 + 477 x 0.039494) x 1.00069315 x 0.9883333
        self.assertAlmostEqual(compare.Law(compare.tables("aluminium_7075_mie_gruneisen")["strength"])(0.002), 532.92, delta=0.01)

    def test_rate_below_the_reference_does_not_soften(self):
        # 6061-T6, reference rate 1 1/s: (324 + 114 x 0.073525) x (1 - 0.0019530)
        self.assertAlmostEqual(compare.Law(compare.tables("aluminium_6061_fracture_mie_gruneisen")["strength"])(0.002), 331.73, delta=0.01)

    def test_rate_above_the_reference_delays_damage(self):
        # 7075-T651: (0.11 + 0.573 x 0.252122) x (1 + 0.016 x 0.69315) x (1 + 1.099 x 7/600)
        damage = compare.Damage(compare.tables("aluminium_7075_mie_gruneisen"))
        self.assertAlmostEqual(damage.failure_strain(0.4), 0.26059, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
