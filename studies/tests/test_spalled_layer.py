# SPDX-License-Identifier: BSD-3-Clause
"""Which fragment is the spalled layer, and the case of a cloud of grains in sections and in three dimensions."""
import pathlib
import tempfile
import tomllib
import unittest

import numpy as np

from studies.debris_grains import debris_grains
from studies.spalled_layer import spalled_layer


class Layer(unittest.TestCase):
    def test_is_the_rearmost_fragment_of_a_twentieth_of_the_wall(self):
        with tempfile.TemporaryDirectory() as name:
            run = pathlib.Path(name)
            (run / "report").mkdir()
            (run / "run.toml").write_text('[[body]]\nname = "flyer"\n[[body]]\nname = "wall"\n')
            (run / "report/bodies.csv").write_text("body part,mass [kg]\nflyer whole,9\nwall whole,2\n")
            (run / "report/fragments.csv").write_text("mass [kg],body [1],x [m],velocity_x [m/s]\n"
                                                      "9,0,0.9,1\n1.2,1,0.1,50\n0.7,1,0.4,250\n0.05,1,0.6,400\n")
            mass, speed, whole = spalled_layer.layer_of(run)
            self.assertAlmostEqual(mass, 35.0)
            self.assertEqual((speed, whole), (250.0, False))
            (run / "report/fragments.csv").write_text("mass [kg],body [1],x [m],velocity_x [m/s]\n1.97,1,0.1,56\n")
            self.assertTrue(spalled_layer.layer_of(run)[2])

    def test_walls_of_other_porosities_are_the_librarys_with_one_key_more(self):
        with tempfile.TemporaryDirectory() as name:
            text = (pathlib.Path(name) / spalled_layer.wall_of(pathlib.Path(name), 0.05)).read_text()
        self.assertEqual(tomllib.loads(text)["failure"][0]["failure_porosity"], 0.05)


class Cloud(unittest.TestCase):
    def test_fragments_are_connected_intact_particles_with_what_failed_beside_them(self):
        row = np.array([[0.1 * i, 0.0] for i in range(5)])
        points = np.vstack([row, row + [0.0, 1.0], [[0.0, 0.12], [0.0, 0.5], [0.4, 0.88]], row[:3] + [2.0, 0.0]])
        failed = np.array([False] * 10 + [True] * 3 + [False] * 3)
        found = sorted(sorted(map(int, own)) for own in debris_grains.fragments_of(points, failed, 0.15))
        self.assertEqual(found, [[0, 1, 2, 3, 4, 10], [5, 6, 7, 8, 9, 12]])

    def test_sizes_by_number_and_by_mass_without_the_largest(self):
        pieces = debris_grains.Pieces(np.array([1.0, 1.0, 3.0, 50.0]), np.array([0.1, 0.2, 0.3, 0.9]), np.array([1.0, 2.0, 2.0, 1.0]), "")
        self.assertEqual(pieces.at_half(pieces.copies), 0.2)
        self.assertEqual(pieces.at_half(pieces.copies * pieces.mass), 0.9)
        self.assertEqual(pieces.at_half(pieces.copies * pieces.mass, without_largest=True), 0.3)

    def test_cases_hold_whole_cells_and_are_toml(self):
        for space in (False, True):
            for cell in (0.2, 0.12, 0.05):
                domain = tomllib.loads(debris_grains.case_of(space, cell, "", 3.0))["domain"]
                lower, upper = ([float(x.split()[0]) for x in domain[key]] for key in ("lower", "upper"))
                self.assertEqual(len(lower), 3 if space else 2)
                for a, b in zip(lower, upper):
                    self.assertAlmostEqual((b - a) / cell, round((b - a) / cell), places=6)


if __name__ == "__main__":
    unittest.main()
