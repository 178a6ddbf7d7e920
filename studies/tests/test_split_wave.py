# SPDX-License-Identifier: BSD-3-Clause
"""Exact waves and plateaus of the study of the split wave."""
import unittest

from studies.split_wave import split_wave as study


class Waves(unittest.TestCase):
    def test_two_shocks_of_known_states(self):
        # Rest 1000 kg/m^3; the first shock: 10 GPa at 1100 kg/m^3; then to 20 GPa at 1400 or 30 GPa at 1500 kg/m^3.
        first = [(5e9, 1050.0, "low"), (10e9, 1100.0, "low"), (12e9, 1200.0, "high")]
        step = (10e9 * (1 / 1000 - 1 / 1100)) ** 0.5
        jumps = [study.second(10e9, 1100.0, state) for state in ((20e9, 1400.0), (30e9, 1500.0))]
        self.assertAlmostEqual(jumps[0][0], (10e9 * (1 / 1100 - 1 / 1400)) ** 0.5)
        self.assertAlmostEqual(jumps[0][0] * jumps[0][1] * 1100.0, 10e9, delta=1.0)  # rho (U - u) du = dP
        waves = study.exact(first, [(20e9, 1400.0, "high"), (30e9, 1500.0, "high")], 1000.0, step + 0.5 * (jumps[0][0] + jumps[1][0]))
        self.assertEqual(waves[0][:2], (10e9, step))
        self.assertAlmostEqual(waves[1][0], 25e9, delta=1.0)
        self.assertAlmostEqual(waves[0][2], study.DEPTH / (10e9 / 1000.0 / step), delta=1e-12)  # U = P/(rho0 u)
        self.assertGreater(waves[1][2], waves[0][2])

    def test_plateaus_of_a_record(self):
        gauge = []
        for i in range(2000):
            t = 1e-9 * i
            v, p = (0.0, 0.0) if t < 1e-6 else (300.0, 12e9) if t < 1.5e-6 else (600.0 + (30.0 if t < 1.52e-6 else 0.0), 20e9)
            gauge.append({"time [s]": t, "inside.velocity_z [m/s]": v, "inside.pressure [Pa]": p})
        found, largest = study.measured(gauge, [(12e9, 300.0, 0.0), (20e9, 600.0, 0.0)])
        self.assertAlmostEqual(found[0][1], 300.0)
        self.assertAlmostEqual(found[1][0], 20e9)
        self.assertAlmostEqual(found[0][2], 1e-6, delta=2e-9)
        self.assertAlmostEqual(largest, 630.0)

    def test_pressure_of_a_second_wave_both_ways(self):
        # 1000 kg/m^3; first wave 5 km/s with 200 m/s: 1 GPa, 1041.67 kg/m^3; then to 500 m/s at 4 km/s in space: 1 + 1.1875 GPa.
        first = (1e9, 200.0, 0.0)
        self.assertAlmostEqual(study.as_second_wave(first, 1000.0, 500.0, 4000.0), 2.1875e9, delta=1.0)
        # Seen by a gauge that moves: the second wave runs (4000 - 200)/0.96 m/s in the coordinates of the material at rest.
        arrivals = study.RECORD_DEPTH / 5000.0, study.RECORD_DEPTH / (3800.0 / 0.96)
        waves = (0.0, 200.0, arrivals[0]), (0.0, 0.0, arrivals[1])
        self.assertAlmostEqual(study.by_arrivals(*waves, 1000.0, 500.0), 2.1875e9, delta=1.0)

    def test_the_record_is_read(self):
        rows = study.records()
        self.assertEqual(len(rows), 18)
        for velocity, shock, pressure in rows:  # rho0 Us up with the density of the data base
            self.assertAlmostEqual(pressure / (7857.3 * velocity * shock), 1.0, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
