# SPDX-License-Identifier: BSD-3-Clause
"""Loads, tiles, and the outcome of tiles in the study of shields."""
import dataclasses
import json
import pathlib
import tempfile
import tomllib
import unittest

import h5py
import numpy as np

from studies.shields import tile, tile_checks

DELAYS = np.linspace(-0.1, 0.3, 401)
LOAD = tile.Load(7.5, 0.1, 5.0, 0.4, DELAYS, np.ones(401), 0.8, 0.05)


def lattice(lower, upper, spacing):
    """Points of a cubic lattice within a box, half a spacing from its faces."""
    axes = [np.arange(a + spacing / 2, b, spacing) for a, b in zip(lower, upper)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


class Cloud(unittest.TestCase):
    def test_core_of_a_uniform_disc_has_its_load(self):
        x, r = np.meshgrid(np.linspace(-1.0, 0.0, 201), np.arange(0.025, 10.0, 0.05))
        mass = 0.2 * r.ravel() * 2 * np.pi * 0.05 / 201
        velocity = np.column_stack([np.full(mass.size, 5.0), np.zeros(mass.size)])
        size = np.where(r.ravel() < 4.0, 0.3, 0.5)
        position = np.column_stack([x.ravel(), r.ravel()])
        found = tile.load_of(position, velocity, mass, size, 50.0, 1.0, (1.0, 0.0))
        self.assertAlmostEqual(found.radius, 5.0, delta=0.05)  # a quarter of the area
        self.assertAlmostEqual(found.mass, 0.2, delta=0.004)
        self.assertAlmostEqual(found.speed, 5.0)
        self.assertEqual(found.size, 0.3)
        self.assertAlmostEqual(found.delay(0.75) - found.delay(0.25), 0.1, delta=0.002)
        self.assertEqual(found.delay(0.0), found.delay(tile.EARLY))

    def test_curved_front_is_no_delay_within_a_ring(self):
        r = np.arange(0.0025, 10.0, 0.005)
        position = np.column_stack([-0.05 * r**2, r])
        velocity = np.column_stack([np.full(r.size, 5.0), np.zeros(r.size)])
        found = tile.load_of(position, velocity, r, np.full(r.size, 0.3), 50.0, 1.0, (1.0, 0.0))
        whole = 0.05 * found.radius**2 / 5.0
        self.assertLess(found.delay(0.9) - found.delay(0.1), 0.25 * whole)

    def test_slow_debris_does_not_count(self):
        position, velocity = np.array([[0.0, 1.0], [0.0, 0.5]]), np.array([[5.0, 0.0], [0.9, 0.0]])
        found = tile.load_of(position, velocity, np.array([1.0, 100.0]), np.array([0.3, 0.2]), 10.0, 1.0, (1.0, 0.0))
        self.assertAlmostEqual(found.mass, 1 / np.pi)
        self.assertEqual(found.size, 0.3)

    def test_section_has_no_wall_and_materials_that_keep_sizes(self):
        case = {"title": "t", "domain": {"lower": ["0 mm"] * 3, "upper": ["9 mm"] * 3},
                "body": [{"name": "sphere", "material": "aluminium_2017_t4_fracture_mie_gruneisen.toml", "velocity": ["0 m/s", "0 m/s", "6700 m/s"],
                          "shape": {"sphere": {"center": ["0 mm", "0 mm", "-1 mm"], "radius": "1 mm"}}},
                         {"name": "bumper", "material": "aluminium_6061_fracture_mie_gruneisen.toml",
                          "shape": {"cylinder": {"center": ["0 mm", "0 mm", "1 mm"], "axis": "z", "radius": "9 mm", "height": "2 mm"}}},
                         {"name": "wall", "material": "aluminium_6061_fracture_mie_gruneisen.toml", "shape": {}}]}
        entry = {"bumpers": [{"spacing": 0.0503, "thickness": 0.002}], "sphere": {"velocity": 6700.0}, "case": {"cell_size": 2e-4}}
        with tempfile.TemporaryDirectory() as name:
            text = tomllib.loads(tile.section_case(case, entry, pathlib.Path(name)))
            self.assertEqual([body["name"] for body in text["body"]], ["sphere", "bumper"])
            self.assertEqual(text["domain"]["cell_size"], "0.1 mm")
            self.assertAlmostEqual(float(text["time"]["end"].split()[0]), 0.85 * 50.3 / 6.7, places=3)
            for body, own in zip(text["body"], case["body"]):
                self.assertEqual(body["shape"], own["shape"])
                keys = tomllib.loads((pathlib.Path(name) / body["material"]).read_text(encoding="utf-8"))
                self.assertEqual(keys["failure"][-1]["model"], "fragment_size")


    def test_sizes_are_kept_beside_the_failure_of_a_base(self):
        with tempfile.TemporaryDirectory() as name:
            file = pathlib.Path(name) / tile.keeping_sizes(pathlib.Path(name), "aluminium_2024_t3_sheet_mie_gruneisen.toml")
            failure = tomllib.loads(file.read_text(encoding="utf-8"))["failure"]
        self.assertEqual(failure[:-1], tile.library("aluminium_2024_t3_sheet_mie_gruneisen.toml")["failure"])
        self.assertEqual([own["model"] for own in failure], ["viscous_void_growth", "johnson_cook_damage", "fragment_size"])


class Grains(unittest.TestCase):
    def test_have_the_mass_of_the_load_and_arrive_with_its_delays(self):
        made = tile.tile_of(LOAD, 1.5, 2.79, 1)
        number = len(made.centres)
        self.assertAlmostEqual(number * 2.79 * np.pi / 6 * made.diameter**3, LOAD.mass * made.side**2, places=12)
        self.assertEqual(number, round(0.1 * 1.8**2 / (2.79 * np.pi / 6 * 0.4**3)))
        wanted = [5.0 * (LOAD.delay((k + 0.5) / number) - LOAD.delay(0.5 / number)) for k in range(number)]
        np.testing.assert_allclose(-made.centres[:, 0] - made.diameter / 2 - tile.GAP_BEFORE, wanted, atol=1e-12)
        self.assertAlmostEqual(made.side / made.cell, round(made.side / made.cell))
        self.assertLessEqual(made.cell, 1.1 * 0.4 / tile.ACROSS)

    def test_dense_loads_fit_in_a_longer_time_without_overlap(self):
        dense = tile.Load(1.5, 1.6, 5.0, 0.4, DELAYS, np.ones(401), 0.8, 0.05)
        made = tile.tile_of(dense, 2.5, 2.79, 1)
        self.assertGreater(len(made.centres), 40)
        gaps = np.linalg.norm(made.centres[:, None] - made.centres[None], axis=-1) + 10 * np.eye(len(made.centres))
        self.assertGreater(gaps.min(), made.diameter)
        self.assertGreater(made.duration, 0.3)

    def test_seeds_move_grains_and_repeat(self):
        first, again, other = (tile.tile_of(LOAD, 1.5, 2.79, seed).centres for seed in (1, 1, 2))
        np.testing.assert_array_equal(first, again)
        self.assertGreater(np.abs(first - other).max(), 0.01)

    def test_cells_follow_grain_and_wall(self):
        self.assertAlmostEqual(tile.tile_of(LOAD, 0.6, 2.79, 1).cell, 0.05, delta=0.003)
        self.assertAlmostEqual(tile.tile_of(LOAD, 5.0, 2.79, 1, 2.0).cell, 2 * 0.4 / tile.ACROSS, delta=0.03)

    def test_case_is_toml_with_whole_cells(self):
        made = tile.tile_of(LOAD, 1.5, 2.79, 1)
        case = tomllib.loads(tile.tile_case(made, 3.175, "a.toml", "b.toml"))
        self.assertEqual(len(case["body"][0]["shape"]["union"]), len(made.centres))
        for axis in range(3):
            lower, upper = (float(case["domain"][key][axis].split()[0]) for key in ("lower", "upper"))
            self.assertAlmostEqual((upper - lower) / made.cell, round((upper - lower) / made.cell), places=5)


class Wall(unittest.TestCase):
    TILE = tile.Tile(2.0, 0.125, 1.5, np.array([[-0.3, 1.0, 1.0]]), 0.4, 5.0)

    def left(self, points, speed, intact=None):
        intact = np.ones(len(points), dtype=bool) if intact is None else intact
        return tile.left_of(self.TILE, points, speed, np.ones(len(points)), intact, np.full(len(points), 0.1), points[:, 0] > 0.75)

    def outcome(self, left, held=lambda speed: 0.0, before=None):
        return tile.verdict_of([(1.0, before or left), (4.0, left)], 1.5, held)

    def test_at_rest_is_whole(self):
        points = lattice((0, 0, 0), (1.5, 2, 2), 0.0625)
        left = self.left(points, np.zeros(len(points)))
        self.assertTrue(left.closed)
        self.assertEqual((left.loose.share, left.speed), (0.0, 0.0))
        self.assertEqual(self.outcome(left)["outcome"], "whole")

    def test_with_a_hole_is_perforated_and_stays_so(self):
        points = lattice((0, 0, 0), (1.5, 2, 2), 0.0625)
        hole = np.linalg.norm(points[:, 1:] - 1.0, axis=1) < 0.5
        left = self.left(points, np.zeros(len(points)), ~hole)
        self.assertFalse(left.closed)
        whole = self.left(points, np.zeros(len(points)))
        self.assertEqual(self.outcome(whole, before=left)["outcome"], "perforated")

    def test_loose_piece_behind_it_is_detached_spall(self):
        wall, piece = lattice((0, 0, 0), (1.5, 2, 2), 0.0625), lattice((2.0, 0.5, 0.5), (2.25, 1.5, 1.5), 0.0625)
        for speed, outcome in ((200.0, "detached spall"), (5.0, "whole")):
            left = self.left(np.vstack([wall, piece]), np.repeat([0.0, speed], [len(wall), len(piece)]))
            self.assertAlmostEqual(left.loose.share, len(piece) / (len(wall) + len(piece)))
            self.assertAlmostEqual(left.loose.distance, 0.5 + 0.125 + 0.03125, delta=1e-6)
            self.assertEqual(self.outcome(left)["outcome"], outcome)

    def test_layer_that_closes_the_tile_is_not_loose_and_held_by_its_rim(self):
        front, layer = lattice((0, 0, 0), (0.75, 2, 2), 0.0625), lattice((1.25, 0, 0), (2.0, 2, 2), 0.0625)
        left = self.left(np.vstack([front, layer]), np.repeat([0.0, 200.0], [len(front), len(layer)]))
        self.assertEqual((left.loose.share, left.speed), (0.0, 200.0))
        for stops, outcome in ((1.6, "perforated"), (1.4, "bulge"), (0.1, "whole")):
            self.assertEqual(self.outcome(left, lambda speed, stops=stops: stops)["outcome"], outcome)

    def test_whose_rear_half_is_gone_is_undecided(self):
        points = lattice((0, 0, 0), (1.5, 2, 2), 0.0625)
        left = tile.left_of(self.TILE, points, np.zeros(len(points)), np.ones(len(points)), np.ones(len(points), dtype=bool),
                            np.full(len(points), 0.1), np.zeros(len(points), dtype=bool))
        self.assertTrue(left.closed and np.isnan(left.speed))
        found = self.outcome(left, before=dataclasses.replace(left, speed=100.0))
        self.assertEqual((found["outcome"], found["defeated"], found["time"]), ("undecided", None, None))
        self.assertIn("left the domain by 4 us", found["reason"])

    def test_rim_is_asked_before_loose_pieces_nearer_than_a_thickness(self):
        left = tile.Left(True, 200.0, tile.Off(0.1, 100.0, 0.5), 0.1, 0.1)
        for stops, outcome in ((1.6, "perforated"), (1.4, "detached spall")):
            self.assertEqual(self.outcome(left, lambda speed, stops=stops: stops)["outcome"], outcome)
        self.assertEqual(self.outcome(dataclasses.replace(left, loose=tile.Off(0.1, 100.0, 1.5)), lambda speed: 9.0)["outcome"], "detached spall")

    def test_that_still_fails_is_undecided(self):
        points = lattice((0, 0, 0), (1.5, 2, 2), 0.0625)
        failed = points[:, 0] < 0.1
        before, now = (self.left(points, np.zeros(len(points)), intact) for intact in (np.ones(len(points), dtype=bool), ~failed))
        self.assertEqual(self.outcome(now, before=before)["outcome"], "undecided")

    def test_rim_stops_a_disc_that_yields_in_shear(self):
        density, radius, speed, shear = 2700.0, 7.5e-3, 200.0, 187e6
        deceleration = 2 * shear / (density * radius)  # 2 pi R h tau over rho pi R^2 h
        self.assertAlmostEqual(tile.held_within(2.7, 7.5, speed, shear), 1e3 * speed**2 / (2 * deceleration))

    def test_pieces_are_cubes_that_touch(self):
        random = np.random.default_rng(1)
        cubes = random.integers(-9, 10, (600, 3))
        found = tile.joined(cubes)
        near = np.abs(cubes[:, None] - cubes[None]).max(axis=-1) <= 1
        label = np.arange(len(cubes))
        for _ in range(200):
            label = np.where(near, label[None], len(cubes)).min(axis=1)
        self.assertEqual(len(np.unique(found)), len(np.unique(label)))
        for name in np.unique(label):
            self.assertEqual(len(np.unique(found[label == name])), 1)


def made_up_run(folder, snapshots):
    """Writes a run whose snapshots (time in s, fields by body, in SI) were not computed."""
    names = list(next(iter(snapshots.values())))
    (folder / "run.toml").write_text("".join(f'[[body]]\nname = "{name}"\n' for name in names), encoding="utf-8")
    files = []
    for number, (time, bodies) in enumerate(snapshots.items()):
        files.append({"name": f"a.particles.{number:06}.hdf", "time": time})
        with h5py.File(folder / files[-1]["name"], "w") as file:
            data = {key: np.concatenate([bodies[name][key] for name in names]) for key in bodies[names[0]]}
            file["VTKHDF/Points"] = data.pop("position")
            file["VTKHDF/PointData/body"] = np.repeat(np.arange(len(names)), [len(bodies[name]["mass"]) for name in names])
            for key, values in data.items():
                file[f"VTKHDF/PointData/{key}"] = values
    (folder / "a.particles.hdf.series").write_text(json.dumps({"files": files}), encoding="utf-8")


def particles(position, speed, mass, **fields):
    """Fields of particles in SI, with the same value for all where it is a number. position: mm; speed: along the first axis, m/s."""
    count = len(position)
    velocity = np.zeros((count, 3))
    velocity[:, 0] = speed
    return {"position": 1e-3 * np.asarray(position, dtype=float), "velocity": velocity, "mass": np.full(count, mass),
            **{key: np.broadcast_to(value, count) for key, value in fields.items()}}


class Runs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_load_is_that_of_all_bodies_before_the_wall_and_its_piece_of_the_sphere(self):
        r = np.arange(0.05, 10.0, 0.1)
        places = np.column_stack([np.zeros(r.size), r, np.zeros(r.size)])
        failed = (r > 2.0).astype(float)  # 20 of 100 points are intact, those with r < 1 touch, the others are too far apart
        places[(r > 1.0) & (r < 2.0), 0] = -1.0 * np.arange(1, 11)
        sphere = particles(places, 5000.0, 2e-6, failed=failed, phase=0, fragment_size=3e-4)
        sheet = particles(places + (-1, 0, 0), [5000.0] * 50 + [900.0] * 50, 1e-6, failed=1.0, phase=0, fragment_size=5e-4)
        made_up_run(self.folder, {0.0: {"sphere": sphere, "bumper": sheet}})
        load = tile.load_of_run(self.folder, 50.0, ["sphere", "bumper"], 0.4, 1.0)
        self.assertAlmostEqual(load.failed, 0.8)
        self.assertAlmostEqual(load.piece, 0.1)
        self.assertEqual(load.size, 0.3)
        self.assertAlmostEqual(load.speed, 5.0)
        self.assertAlmostEqual(load.radius, 2.05)  # 62.5 of 250 mg that are fast enough: 3 mg every 0.1 mm
        self.assertAlmostEqual(load.mass, 63.0 / (np.pi * 2.05**2))

    def test_history_follows_the_half_that_began_behind(self):
        struck = tile.Tile(2.0, 0.125, 1.5, np.array([[-0.3, 1.0, 1.0]]), 0.4, 5.0)
        places = lattice((0, 0, 0), (1.5, 2, 2), 0.0625)
        rear = places[:, 0] > 0.75
        fields = {"id": np.arange(len(places)), "failed": 0.0, "phase": 0, "plastic_strain": 0.1}
        later = particles(places + np.outer(~rear, (1.0, 0, 0)), np.where(rear, 30.0, 90.0), 1e-9, **fields)
        made_up_run(self.folder, {0.0: {"wall": particles(places, 0.0, 1e-9, **fields)}, 4e-6: {"wall": later}, 4.001e-6: {"wall": later}})
        (time, left), = tile.history(self.folder, struck)
        self.assertAlmostEqual(time, 4.0)
        self.assertAlmostEqual(left.speed, 30.0)
        self.assertTrue(left.closed)


    def test_checks_compare_the_rear_half_with_its_load_and_count_what_has_left(self):
        places = lattice((0, 0, 0), (1.5, 2, 2), 0.0625)
        rear = places[:, 0] > 0.75
        kept = ~rear | (places[:, 1] < 1.0)
        fields = {"failed": 0.0, "phase": 0, "plastic_strain": 0.1}
        first = particles(places, 0.0, 1e-9, id=np.arange(len(places)), **fields)
        last = particles(places[kept], np.where(rear[kept], 300.0, 0.0), 1e-9, id=np.flatnonzero(kept), **fields)
        made_up_run(self.folder, {0.0: {"wall": first}, 2e-6: {"wall": last}, 4e-6: {"wall": last}})
        grain = '{ sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "0.0002 m" } }'
        (self.folder / "run.toml").write_text(f"""[domain]
upper = ["3 mm", "2 mm", "0.002 m"]
cell_size = "0.125 mm"
[[body]]
name = "wall"
shape = {{ union = [{grain}, {grain}] }}
""", encoding="utf-8")
        wall = {"name": "wall", "material": "aluminium_6061_mie_gruneisen.toml"}
        shot = tile.Shot({"source": "S", "name": "1", "wall": {"thickness": 1.5e-3}}, {"body": [wall]}, self.folder)
        found = tile_checks.check_of(shot, LOAD, self.folder)
        density, shear = tile.value_of(wall["material"], "eos", "reference_density"), tile.shear_yield(wall["material"])
        self.assertEqual((found.shot, found.grains, found.cell), ("S/1", 2, 0.125))
        self.assertAlmostEqual(found.lost, 0.5)
        self.assertAlmostEqual(found.speed, 300.0)
        self.assertAlmostEqual(found.spread, 1e3 * 0.5 / (density * 1.5))
        self.assertAlmostEqual(found.stopped, tile.held_within(density, 7.5, 300.0, shear) / 1.5)
        self.assertAlmostEqual(found.spread_stopped / found.stopped, (found.spread / 300.0)**2)


class Materials(unittest.TestCase):
    def test_without_the_key_or_in_another_unit_are_refused_by_name(self):
        with self.assertRaisesRegex(SystemExit, r"aluminium_6061_mie_gruneisen.toml: strength.no_key: a number and one of MPa, GPa"):
            tile.value_of("aluminium_6061_mie_gruneisen.toml", "strength", "no_key")

    def test_have_the_keys_of_those_they_are_based_on(self):
        self.assertAlmostEqual(tile.shear_yield("aluminium_6061_fracture_mie_gruneisen.toml"),
                               tile.value_of("aluminium_6061_mie_gruneisen.toml", "strength", "yield_stress") / np.sqrt(3))
        self.assertAlmostEqual(tile.value_of("aluminium_2017_t4_fracture_mie_gruneisen.toml", "eos", "reference_density"), 2.79)


if __name__ == "__main__":
    unittest.main()
