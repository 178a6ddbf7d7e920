# SPDX-License-Identifier: BSD-3-Clause
"""Tables, interpolation and classes of the study of the wide range."""
import math
import unittest

from studies.wide_range import wide_range as study


class Numbers(unittest.TestCase):
    def test_rows_leave_words_and_comments_out(self):
        rows = study.rows_of("# note\n\nP_GPa,phase,x\n1.5,solid,2e3\n-2,liquid,\n")
        self.assertEqual(rows, [{"P_GPa": 1.5, "x": 2000.0}, {"P_GPa": -2.0}])

    def test_deviations_by_class(self):
        model = [{"u": 0.0, "U": 1.0}, {"u": 4.0, "U": 9.0}]
        self.assertAlmostEqual(study.between(model, "u", 1.0, "U"), 3.0)
        self.assertTrue(math.isnan(study.between(model, "u", 5.0, "U")))
        points = [{"u": 1.0, "U": 2.0}, {"u": 2.0, "U": 10.0}, {"u": 3.0, "U": 7.0}]
        found = study.classes(points, (0.0, 2.0, 4.0), "u", "U", lambda u: study.between(model, "u", u, "U"))
        self.assertEqual(found[0][0], "2")
        self.assertAlmostEqual(found[0][1], 0.0)  # +50 and -50 %
        self.assertAlmostEqual(found[0][2], 50.0)
        self.assertAlmostEqual(found[1][1], 0.0)
        beyond = study.classes([{"u": 5.0, "U": 1.0}], (4.0, 6.0), "u", "U", lambda u: study.between(model, "u", u, "U"))
        self.assertEqual(study.percent(beyond[0][1]), "-")


if __name__ == "__main__":
    unittest.main()
