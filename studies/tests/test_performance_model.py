# SPDX-License-Identifier: BSD-3-Clause
"""Terms of the performance model in limits that are known."""
import math
import unittest

from studies.performance_model import performance_model as study

KERNELS = (100e-9, 20e-9, 50e-9)


def seconds(particles, cores, **changes):
    machine = {"per_block": 512, "latency": 1e-6, "bandwidth": 1e9, "memory": 1e10, "imbalance": 1.0} | changes
    return study.seconds_per_step(particles, cores, KERNELS, **machine)


class Model(unittest.TestCase):
    def test_one_core_computes_alone(self):
        compute, exchange, collectives = seconds(1e6, 1)
        self.assertAlmostEqual(compute, 0.1)
        self.assertEqual((exchange, collectives), (0.0, 0.0))

    def test_a_cube_borrows_one_layer_of_blocks(self):
        self.assertAlmostEqual(study.halo_blocks(27), 5**3 - 27)
        self.assertAlmostEqual(study.interior_share(27), 1 / 27)
        self.assertEqual(study.interior_share(1), 0.0)

    def test_reductions_grow_with_the_logarithm_of_the_cores(self):
        _, _, collectives = seconds(1e6, 1024, latency=2e-6)
        self.assertAlmostEqual(collectives, study.COLLECTIVES * 2 * math.log2(1024) * 2e-6)

    def test_messages_hide_behind_the_interior_of_large_parts(self):
        """A fast network costs the packing alone, a slow one more."""
        _, fast, _ = seconds(1e7, 64, bandwidth=1e12)
        _, slow, _ = seconds(1e7, 64, bandwidth=1e6)
        blocks = 1e7 / 512
        moved = study.halo_blocks(blocks) * study.CELLS * study.NODE_BYTES
        packing = study.EXCHANGES * moved * study.POSTS_PER_BYTE / 1e10
        self.assertAlmostEqual(fast, packing, delta=1e-12)
        self.assertGreater(slow, fast)
