# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the scaling study from measurements whose scaling is known."""
import argparse
import unittest

from studies.scaling import scaling as study


def measured(ranks, threads, nanoseconds, particles=1_000_000, kernel=30.0):
    stages = [{"stage": name, "ns_per_particle_step": 20.0} for name in ("particles to grid", "grid to particles", "material")]
    return {"ranks": ranks, "threads": threads, "particles": particles, "ns_per_particle_step": nanoseconds, "particles_per_block": 512.0,
            "bandwidth_bytes_per_s": 4e10, "reference_kernel_ns_per_particle_step": kernel, "stages": stages}


class Rows(unittest.TestCase):
    def test_speed_up_and_efficiency_are_those_of_one_core(self):
        rows = study.rows_of([measured(1, 4, 25.0, kernel=10.0), measured(1, 1, 80.0)], 5e-7, 4e9, 1.02)
        self.assertEqual([row["cores"] for row in rows], [1, 4])
        self.assertAlmostEqual(rows[1]["speed_up"], 3.2)
        self.assertAlmostEqual(rows[1]["efficiency"], 0.8)
        self.assertAlmostEqual(rows[1]["kernel_speed_up"], 3.0)

    def test_threads_are_predicted_to_share_the_work_alone(self):
        rows = study.rows_of([measured(1, 1, 80.0), measured(1, 4, 20.0)], 5e-7, 4e9, 1.02)
        self.assertAlmostEqual(rows[1]["predicted_speed_up"], 4.0)
        self.assertAlmostEqual(rows[1]["measured_over_predicted"], 1.0)

    def test_ranks_are_predicted_to_exchange_and_to_wait_for_the_busiest(self):
        rows = study.rows_of([measured(1, 1, 80.0), measured(4, 1, 25.0)], 5e-7, 4e9, 1.02)
        self.assertLess(rows[1]["predicted_speed_up"], 4.0 / 1.02)
        self.assertGreater(rows[1]["predicted_speed_up"], 3.0)

    def test_a_growing_problem_is_compared_by_particle(self):
        rows = study.rows_of([measured(1, 1, 80.0), measured(1, 8, 10.0, particles=8_000_000)], 5e-7, 4e9, 1.02)
        self.assertAlmostEqual(rows[1]["efficiency"], 1.0)
        self.assertAlmostEqual(rows[1]["predicted_speed_up"], 8.0)

    def test_without_one_core_there_is_nothing_to_compare_with(self):
        with self.assertRaises(ValueError):
            study.rows_of([measured(2, 1, 40.0)], 5e-7, 4e9, 1.02)
        with self.assertRaises(argparse.ArgumentTypeError):
            study.numbers("2,4")
        self.assertEqual(study.numbers("4,1,2"), [1, 2, 4])

    def test_of_several_measurements_the_median_and_the_ends_are_shown(self):
        repeats = [study.rows_of([measured(1, 1, 80.0), measured(1, 2, two)], 5e-7, 4e9, 1.02) for two in (50.0, 40.0, 64.0)]
        rows = study.combined(repeats)
        self.assertAlmostEqual(rows[1]["speed_up"], 1.6)
        self.assertEqual([round(end, 6) for end in rows[1]["speed_ups"]], [1.25, 2.0])
        self.assertIn("1.60 (1.25 to 2.00)", study.table_of(rows))
        self.assertNotIn("to", study.table_of(rows).splitlines()[2].split("|")[4])

    def test_what_is_beyond_the_cores_says_that_it_is_predicted(self):
        one = measured(1, 1, 80.0)
        weak, strong = (study.predicted_rows(one, kind, [16, 4096], 5e-7, 4e9, 1.02) for kind in ("weak", "strong"))
        self.assertEqual([row["particles"] for row in weak], [16_000_000, 4_096_000_000])
        self.assertEqual([row["particles"] for row in strong], [1_000_000, 1_000_000])
        self.assertGreater(weak[1]["efficiency"], strong[1]["efficiency"])
        self.assertLess(strong[1]["efficiency"], strong[0]["efficiency"])
        self.assertIn("predicted, not measured", study.prediction_table(weak))

    def test_the_table_has_a_row_for_each_number_of_cores(self):
        lines = study.table_of(study.rows_of([measured(1, 1, 80.0), measured(1, 2, 40.0)], 5e-7, 4e9, 1.02)).splitlines()
        self.assertEqual(len(lines), 4)
        self.assertIn("| 2 | 1,000,000 | 40.0 | 2.00 | 100% |", lines[3])
