# SPDX-License-Identifier: BSD-3-Clause
"""Oblique shocks, the angle from which a contact sends out a jet, and the bound on the jet."""
import math
import unittest

from studies.closing_contact import closing_contact as study

C, S = 2.0, 1.5


class ObliqueShocks(unittest.TestCase):
    def test_normal_ones_do_not_turn_the_stream_and_have_the_pressure_of_the_line(self):
        turn, pressure = study.polar(5.0, C, S)
        self.assertAlmostEqual(turn[-1], 0.0, places=12)
        self.assertAlmostEqual(pressure[-1], 5.0 * (5.0 - C) / S)

    def test_the_weakest_is_a_sound_wave(self):
        turn, pressure = study.polar(5.0, C, S)
        self.assertAlmostEqual(turn[0], 0.0, places=9)
        self.assertAlmostEqual(pressure[0], 0.0, places=9)

    def test_momentum_along_a_shock_is_kept(self):
        turn, pressure = study.polar(5.0, C, S)
        i = len(turn) // 3
        angle = math.asin(C / 5.0) + i / (len(turn) - 1) * (0.5 * math.pi - math.asin(C / 5.0))
        along = 5.0 * math.cos(angle)
        behind = 5.0 * math.sin(angle) - pressure[i] / (5.0 * math.sin(angle))
        self.assertAlmostEqual(math.atan2(behind, along), angle - turn[i], places=12)


class CriticalAngle(unittest.TestCase):
    def test_divides_contacts_that_close_from_those_with_a_jet(self):
        phi = study.critical_angle(6.0, C, S)
        self.assertTrue(study.closes_without_jet(phi - 1e-3, 6.0, C, S))
        self.assertFalse(study.closes_without_jet(phi + 1e-3, 6.0, C, S))

    def test_grows_with_the_impact_speed(self):
        angles = [study.critical_angle(speed, C, S) for speed in (1.0, 2.0, 4.0, 8.0)]
        self.assertEqual(angles, sorted(angles))
        self.assertLess(math.tan(angles[0]), 1.0 / C)  # the place of contact is faster than sound


class Bound(unittest.TestCase):
    def test_at_the_equator_the_sphere_passes_the_plate(self):
        self.assertAlmostEqual(study.bound(6.0, 3.0, 0.5), 6.0)
        for late in (0.7, 1.5):
            self.assertAlmostEqual(study.bound(6.0, 3.0, late), 6.0)

    def test_falls_with_time(self):
        self.assertAlmostEqual(study.bound(6.0, 3.0, 0.25), 6.0 / math.tan(math.pi / 6.0))


if __name__ == "__main__":
    unittest.main()
