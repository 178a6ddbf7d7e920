# SPDX-License-Identifier: BSD-3-Clause
"""Loads, grains and what is left of a wall in the study of grains on a wall."""
import pathlib
import tempfile
import tomllib
import unittest

import numpy as np

from studies.grains_on_wall import grains_on_wall as study

LOAD = study.Load(0.095, 5.7, 0.8)


def lattice(lower, upper, spacing):
    """Points of a cubic lattice within a box, half a spacing from its faces."""
    axes = [np.arange(a + spacing / 2, b, spacing) for a, b in zip(lower, upper)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


class Arrival(unittest.TestCase):
    def test_of_a_plug_that_flies_straight(self):
        x, r = np.meshgrid(np.linspace(-1.0, 0.0, 401), np.arange(0.05, 10.0, 0.1))
        mass = 0.2 * r.ravel() * 2 * np.pi * 0.1 / 401  # rings of 0.2 mg/mm2 in all
        velocity = np.column_stack([np.full(mass.size, 5.0), np.zeros(mass.size)])
        r50, load, core = study.arrival(np.column_stack([x.ravel(), r.ravel()]), velocity, mass, 50.0)
        self.assertAlmostEqual(r50, 10 / np.sqrt(2), delta=0.1)
        for found in (load, core):
            self.assertAlmostEqual(found.mass, 0.2, delta=0.01)
            self.assertAlmostEqual(found.speed, 5.0)
            self.assertAlmostEqual(found.duration, 0.8 * 1.0 / 5.0, delta=0.01)

    def test_spreads_and_leaves_out_what_flies_back(self):
        position = np.array([[0.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
        velocity = np.array([[5.0, 1.0], [1.0, 1.0], [-3.0, 0.0]])
        r50, load, _ = study.arrival(position, velocity, np.array([1.0, 1.0, 9.0]), 10.0)
        self.assertAlmostEqual(r50, 1.0 + 10.0 / 5.0)
        self.assertAlmostEqual(load.mass, 1.0 / (np.pi * 9.0))


class Grains(unittest.TestCase):
    def test_have_the_mass_of_the_load_and_do_not_overlap(self):
        for size in (0.25, 0.5, 1.0):
            diameters = study.diameters_of(LOAD, [size])
            places = study.places_of(LOAD, diameters, 1)
            mass = len(places) * study.DENSITY * np.pi / 6 * size**3
            self.assertAlmostEqual(mass, LOAD.mass * LOAD.side**2, delta=0.51 * study.DENSITY * np.pi / 6 * size**3)
            np.testing.assert_array_equal(places, study.places_of(LOAD, diameters, 1))
            distance = np.linalg.norm(places[:, None] - places[None], axis=-1) + 10 * np.eye(len(places))
            self.assertGreater(distance.min(), size)
            self.assertLess(places[:, 0].max(), -size / 2)
            self.assertTrue(((places[:, 1:] >= size / 2) & (places[:, 1:] <= LOAD.side - size / 2)).all())

    def test_of_several_sizes_have_an_equal_part_of_the_mass_each(self):
        diameters = study.diameters_of(LOAD, [0.25, 0.5])
        self.assertEqual((diameters[0], diameters[-1]), (0.5, 0.25))
        mass = [(diameters[diameters == size]**3).sum() for size in (0.25, 0.5)]
        self.assertAlmostEqual(mass[0], mass[1], delta=0.5 * 0.5**3)
        places = study.places_of(LOAD, diameters, 1)
        distance = np.linalg.norm(places[:, None] - places[None], axis=-1) - (diameters[:, None] + diameters[None]) / 2 + 10 * np.eye(len(places))
        self.assertGreater(distance.min(), 0.0)

    def test_dust_loads_every_column_alike(self):
        cell = 0.25
        dust = study.dust_of(LOAD, cell, 1)
        self.assertAlmostEqual(len(dust) * study.DENSITY * (cell / 2)**3, LOAD.mass * LOAD.side**2, delta=study.DENSITY * (cell / 2)**3)
        self.assertEqual(len(np.unique(dust, axis=0)), len(dust))
        _, number = np.unique(np.floor(dust[:, 1:] / cell + 1e-9), axis=0, return_counts=True)
        self.assertEqual(len(number), 256)
        self.assertLessEqual(number.max() - number.min(), 1)

    def test_cases_are_toml_with_whole_cells(self):
        for size, cell in ((0.0, 0.25), (0.5, 4 / 24)):
            case = tomllib.loads(study.tile_case(LOAD, [size], 1.8, cell, 1))
            number = len(study.dust_of(LOAD, cell, 1)) if size == 0.0 else len(study.diameters_of(LOAD, [size]))
            self.assertEqual(len(case["body"][0]["shape"]["union"]), number)
            for axis in range(3):
                a, b = (float(case["domain"][key][axis].split()[0]) for key in ("lower", "upper"))
                self.assertAlmostEqual((b - a) / cell, round((b - a) / cell), places=5)
        text, cell = study.cell_case(LOAD, 1.0, 1.8, 0.1)
        radius = float(tomllib.loads(text)["domain"]["upper"][1].split()[0])
        self.assertAlmostEqual(study.DENSITY * np.pi / 6 / (np.pi * radius**2), LOAD.mass)
        self.assertAlmostEqual(radius / cell, round(radius / cell), places=9)

    def test_materials_that_keep_sizes_are_the_librarys_with_one_entry_more(self):
        with tempfile.TemporaryDirectory() as name:
            file = pathlib.Path(name) / study.keeping(pathlib.Path(name), "aluminium_2017_t4_mie_gruneisen", 11.5e3)
            failure = tomllib.loads(file.read_text(encoding="utf-8"))["failure"]
        self.assertEqual([entry["model"] for entry in failure], ["viscous_void_growth", "fragment_size"])
        self.assertEqual(failure[1]["energy_per_area"], "11500 J/m^2")


class Wall(unittest.TestCase):
    CELL = 0.25

    def left(self, points, velocity, intact=None):
        intact = np.ones(len(points), dtype=bool) if intact is None else intact
        return study.left_of(points, velocity, np.ones(len(points)), intact, self.CELL, LOAD.side)

    def test_is_whole_as_it_began(self):
        points = lattice((0, 0, 0), (2, 4, 4), self.CELL / 2)
        left = self.left(points, np.zeros(len(points)))
        self.assertEqual((left.share, left.least, left.median, left.cover, left.verdict()), (1.0, 2.0, 2.0, 1.0, "whole"))

    def test_is_open_where_a_column_is_missing_or_has_failed(self):
        points = lattice((0, 0, 0), (2, 4, 4), self.CELL / 2)
        hole = np.linalg.norm(points[:, 1:] - 2.0, axis=1) < 0.5
        for left in (self.left(points[~hole], np.zeros((~hole).sum())), self.left(points, np.zeros(len(points)), ~hole)):
            self.assertEqual((left.verdict(), left.least), ("open", 0.0))
            self.assertAlmostEqual(left.cover, 1 - 12 / 256)
        self.assertEqual(self.left(points, np.zeros(len(points)), np.zeros(len(points), dtype=bool)).verdict(), "open")

    def test_has_spalled_if_a_layer_leaves(self):
        wall, layer = lattice((0, 0, 0), (1.5, 4, 4), self.CELL / 2), lattice((2.25, 0, 0), (2.5, 4, 4), self.CELL / 2)
        points, speed = np.vstack([wall, layer]), np.repeat([20.0, 200.0], [len(wall), len(layer)])
        left = self.left(points, speed)
        self.assertEqual((left.verdict(), left.least), ("spalled", 1.5))
        self.assertAlmostEqual(left.behind, 1 / 7)
        self.assertAlmostEqual(left.behind_speed, 200.0)
        self.assertEqual(self.left(points, np.full(len(points), 20.0)).verdict(), "whole")  # parted, but it stays
        self.assertAlmostEqual(self.left(points + [0, 0, 1e-3], speed).share, 6 / 7)

    def test_rest_is_what_stays_behind_the_larger_layer(self):
        wall, layer = lattice((0, 0, 0), (0.5, 4, 4), self.CELL / 2), lattice((2.25, 0, 0), (3.5, 4, 4), self.CELL / 2)
        left = self.left(np.vstack([wall, layer]), np.repeat([20.0, 400.0], [len(wall), len(layer)]))
        self.assertEqual((left.verdict(), left.least, left.speed), ("spalled", 0.5, 20.0))
        self.assertAlmostEqual(left.behind, 5 / 7)

    def test_in_a_section_has_no_columns(self):
        points = lattice((0, 0), (2, 2), self.CELL / 2)
        left = study.left_of(points, np.zeros(len(points)), points[:, 1], np.ones(len(points), dtype=bool), self.CELL)
        self.assertTrue(np.isnan(left.cover))
        self.assertEqual(left.verdict(), "whole")


if __name__ == "__main__":
    unittest.main()
