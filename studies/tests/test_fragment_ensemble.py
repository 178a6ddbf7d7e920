# SPDX-License-Identifier: BSD-3-Clause
"""Tests of studies/fragment_ensemble: offsets lie within a cell and differ; numbers over masses; statistics over members."""
import random
import types
import unittest

import numpy as np

from studies.fragment_ensemble import fragment_ensemble as ensemble
from studies.validation.cases import BadExpectation


class FragmentEnsembleTest(unittest.TestCase):
    def test_offsets_are_parts_of_a_cell_of_their_own(self):
        band = types.SimpleNamespace(offsets=[['domain.lower=["{-1 - 0.25 cell} mm", "0 mm", "{-30 - 0.25 cell} mm"]']])
        run = types.SimpleNamespace(band=band, case=types.SimpleNamespace(name="a case"))
        generator = random.Random(1)
        found = []
        for _ in range(50):
            (text,) = ensemble.offset(run, 2e-3, generator)
            x, y, z = (float(part.strip(' "[]').split()[0]) for part in text.partition("=")[2].split(","))
            self.assertEqual(y, 0.0)
            found.append((-1.0 - x, -30.0 - z))
        found = np.array(found)
        self.assertTrue(((found >= 0.0) & (found <= 2.0)).all())
        self.assertGreater(np.ptp(found[:, 0]), 1.5)
        self.assertLess(abs(np.corrcoef(found.T)[0, 1]), 0.4)
        run.band.offsets = []
        with self.assertRaisesRegex(BadExpectation, "a case"):
            ensemble.offset(run, 2e-3, generator)

    def test_numbers_above_a_mass(self):
        distribution = np.array([[8.0, 1.0], [4.0, 3.0], [1.0, 10.0]])
        self.assertEqual([ensemble.number_above(distribution, m) for m in (9.0, 8.0, 5.0, 4.0, 0.5)], [0.0, 1.0, 1.0, 3.0, 10.0])

    def test_statistics_leave_out_what_is_not_there(self):
        mean, error, spread, low, high = ensemble.statistics([1.0, 2.0, 3.0, np.nan])
        self.assertEqual((mean, spread), (2.0, 1.0))
        self.assertAlmostEqual(error, 1.0 / np.sqrt(3.0))
        self.assertTrue(1.0 <= low < 1.1 and 2.9 < high <= 3.0)
        self.assertTrue(np.isnan(ensemble.statistics([1.0])[0]))

    def test_tables_hold_every_measure_and_half_decades_of_mass(self):
        members = [({name: float(i) for name in ensemble.MEASURES}, np.array([[1e-3, 1.0], [1e-6, 100.0 + i]])) for i in (1, 3)]
        lines = ensemble.tables(members)
        self.assertIn("| exponent b of N(>m) ~ m^-b | 2 |", "\n".join(lines))
        self.assertIn("| 0.001 | 102 | 1.4 |", "\n".join(lines))


if __name__ == "__main__":
    unittest.main()
