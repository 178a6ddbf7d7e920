# SPDX-License-Identifier: BSD-3-Clause
"""Fragments of a body, and the theory of jets, on files and numbers made for them."""
import json
import math
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from studies.shaped_charge import penetration, shaped_charge
from report import pieces
from studies.fragment_statistics import weibull_exponent


def write_run(folder, places, fields):
    """A run of two bodies with one snapshot: "air" without particles, "metal" with these."""
    (folder / "run.toml").write_text('[domain]\ncell_size = "0.001 m"\n[[body]]\nname = "air"\n[[body]]\nname = "metal"\n')
    (folder / "made.particles.hdf.series").write_text(json.dumps({"files": [{"name": "made.hdf", "time": 1e-6}]}))
    with h5py.File(folder / "made.hdf", "w") as file:
        data = file.create_group("VTKHDF")
        data["Points"] = places
        for name, values in {"body": np.ones(len(places), dtype=int), **fields}.items():
            data[f"PointData/{name}"] = values


class Measures(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_masses_are_those_of_the_fragments_of_the_body(self):
        write_run(self.folder, np.zeros((1, 3)), {"mass": np.ones(1)})
        (self.folder / "report").mkdir()
        (self.folder / "report/fragments.csv").write_text(
            "mass [kg],copies [1],body [1]\n" + "".join(f"{m},2,1\n" for m in (1.0, 2.0, 4.0)) + "50,1,0\n")
        found = pieces.masses_of_run(self.folder, "metal")
        self.assertEqual((sorted(found.mass), found.number, found.largest), ([1.0, 2.0, 4.0], 6, 4.0))
        self.assertAlmostEqual(found.mean, 7.0 / 3.0)
        self.assertEqual(pieces.masses_of_run(self.folder, "copper").number, 0)


class Theory(unittest.TestCase):
    def test_weibull_exponent_of_its_own_quantiles(self):
        for b in (0.8, 1.1, 2.0):
            masses = (-np.log((np.arange(4000) + 0.5) / 4000)) ** (1.0 / b)
            found = pieces.Masses(masses, np.ones(4000))
            self.assertAlmostEqual(weibull_exponent(found)[0], b, delta=0.01 * b)

    def test_images_are_no_further_observations(self):
        masses = np.array([1.0, 2.0, 4.0, 7.0])
        b, error = weibull_exponent(pieces.Masses(masses, np.ones(4)))
        self.assertAlmostEqual(error, b * np.sqrt(0.608 / 4))
        self.assertEqual(weibull_exponent(pieces.Masses(masses, np.full(4, 4.0))), (b, error))
        # A fragment that counts twice pulls the exponent as two of them do.
        twice = weibull_exponent(pieces.Masses(masses, np.array([1.0, 1.0, 1.0, 2.0])))
        same = weibull_exponent(pieces.Masses(np.append(masses, 7.0), np.ones(5)))
        self.assertAlmostEqual(twice[0], same[0])
        self.assertGreater(twice[1], same[1])

    def test_error_is_the_scatter_of_samples(self):
        generator = np.random.default_rng(1)
        found = np.array([weibull_exponent(pieces.Masses(generator.weibull(1.5, 60), np.full(60, 2.0))) for _ in range(300)])
        self.assertAlmostEqual(found[:, 0].std() / found[:, 1].mean(), 1.0, delta=0.15)

    def test_jet_of_a_cone(self):
        velocity, mass, share = shaped_charge.theory(21.0, "composition_b")
        self.assertTrue(np.all(np.diff(mass) > 0.0) and np.all(np.diff(velocity) < 0.0))
        self.assertAlmostEqual(mass[-1], share, delta=1e-9)
        narrow = shaped_charge.theory(10.0, "composition_b")
        self.assertGreater(narrow[0][0], velocity[0])  # faster and thinner
        self.assertLess(narrow[2], share)

    def test_depth_of_a_jet_from_one_place(self):
        v = np.linspace(8000.0, 2000.0, 400)
        x = 0.1 + 50e-6 * v  # all from 0.1 m
        for density in (8930.0, 7830.0, 2700.0):
            tau, depth = penetration.penetrate(v, x, 0.27, density)
            g = math.sqrt(density / 8930.0)
            self.assertAlmostEqual(depth[-1] / (0.17 * ((8000.0 / 2000.0) ** (1.0 / g) - 1.0)), 1.0, delta=1e-4)
            self.assertTrue(np.all(np.diff(tau) > 0.0) and tau[0] < 0.0)

    def test_a_rod_goes_as_deep_as_the_roots_of_the_densities_say_and_no_deeper_in_what_resists(self):
        v, x = np.linspace(5000.0, 4999.99, 3), np.array([0.2, 0.15, 0.1])
        depth = penetration.penetrate(v, x, 0.2, 7830.0)[1][-1]
        self.assertAlmostEqual(depth, 0.1 * math.sqrt(8930.0 / 7830.0), delta=1e-5)
        self.assertLess(penetration.penetrate(v, x, 0.2, 7830.0, 4e9)[1][-1], 0.95 * depth)
        # rho_j (v - u)^2 = rho_t u^2 + 2 R; nothing penetrates below v = sqrt(2 R/rho_j)
        for density in (7830.0, 8930.0):
            u = float(penetration.penetration_speed(5000.0, density, 4e9))
            self.assertAlmostEqual(8930.0 * (5000.0 - u) ** 2, density * u**2 + 8e9, delta=1.0)
        self.assertEqual(float(penetration.penetration_speed(900.0, 7830.0, 4e9)), 0.0)


if __name__ == "__main__":
    unittest.main()
