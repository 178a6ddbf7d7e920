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

    def test_the_table_has_a_row_for_each_number_of_cores(self):
        lines = study.table_of(study.rows_of([measured(1, 1, 80.0), measured(1, 2, 40.0)], 5e-7, 4e9, 1.02)).splitlines()
        self.assertEqual(len(lines), 4)
        self.assertIn("| 2 | 1,000,000 | 40.0 | 2.00 | 100% |", lines[3])
