# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the study of corrected equations of state are read from reports as the program writes them."""
import unittest

from studies.corrected_eos import corrected_eos as study


class Reports(unittest.TestCase):
    def test_residuals_end_with_the_table(self):
        report = ("chi\ncorrection of the free energy: data                GRAY %  corrected %  of errors\n"
                  "isotherm, pressure                        11        1.531        0.012       0.37\n"
                  "film, pressure of the vapour               3       46.871       43.876       0.68\n"
                  "in percent of rho0 C^2\nshock 1 2.0 3.0 4.0\n")
        self.assertEqual(study.residuals(report), [["isotherm, pressure", "11", "1.531", "0.012", "0.37"],
                                                   ["film, pressure of the vapour", "3", "46.871", "43.876", "0.68"]])
        self.assertEqual(study.residuals("no correction\n"), [])

    def test_outcomes(self):
        audit = ("melting     1322.8 ... 1322.8 K at zero pressure; by shock 225.3 ... 289.7 GPa\n"
                 "vapour      critical point 9433.3 K, 0.8982 GPa; boils at 2551.3 K (1 atm)\n\nverdict: sound\n")
        self.assertEqual(study.outcomes(audit), ["1323", "2551", "9433", "sound"])
        self.assertEqual(study.outcomes("verdict: not usable: x")[:3], ["-", "-", "-"])


if __name__ == "__main__":
    unittest.main()
