# SPDX-License-Identifier: BSD-3-Clause
"""What the study of cracks computes itself: Mott's statistics, and rows that are runs of their own."""
import dataclasses
import unittest

import numpy as np

from studies.crack_fragments import crack_fragments, fields_in_cases, mott


class Mott(unittest.TestCase):
    def test_number_is_that_of_the_unloading_and_grows_with_a_delay(self):
        numbers = [mott.fragments(seed, elements=2000) for seed in range(1, 6)]
        self.assertTrue(35 < np.mean(numbers) < 55)
        self.assertGreater(mott.fragments(1, delay=0.4e-6, elements=2000), numbers[0])

    def test_slower_rings_break_into_fewer(self):
        slow = dataclasses.replace(mott.Ring(), stretch_rate=0.25 * mott.Ring.stretch_rate)
        self.assertLess(mott.fragments(1, slow, elements=2000), 0.6 * mott.fragments(1, elements=2000))

    def test_flow_stress_softens_by_its_heat(self):
        self.assertTrue(1.0e9 < mott.flow_stress(0.5) < 1.293e9)


class Rows(unittest.TestCase):
    def test_every_row_has_a_run_of_its_own(self):
        names = [row.name for row in crack_fragments.ROWS]
        self.assertEqual(len(names), len(set(names)))
        for row in crack_fragments.ROWS:
            self.assertTrue(row.case.is_file())

    def test_every_row_of_other_cases_differs_by_the_fields_alone(self):
        names = [row.name for row in fields_in_cases.ROWS]
        self.assertEqual(len(names), len(set(names)))
        for row in fields_in_cases.ROWS:
            self.assertTrue(row.file.is_file())
            none, fields = (row.words(kind) for kind in fields_in_cases.FIELDS)
            self.assertEqual(len(none), len(fields))
            self.assertEqual(sum(a != b for a, b in zip(none, fields)), len(row.bodies))


if __name__ == "__main__":
    unittest.main()
