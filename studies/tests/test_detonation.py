# SPDX-License-Identifier: BSD-3-Clause
"""Measures of detonations and jets, and the theory of jets, on files and numbers made for them."""
import json
import math
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from studies.shaped_charge import penetration, shaped_charge
from report import detonation, pieces
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

    def test_profile_error_is_weighted_by_mass_within_the_table(self):
        table = self.folder / "exact.csv"
        table.write_text("# made up\nx [m],pressure [Pa],velocity [m/s]\n0,10,0\n1,20,100\n")
        places = np.array([[0.0, 0, 0], [0.5, 0, 0], [2.0, 0, 0]])
        write_run(self.folder, places, {"mass": [1.0, 2.0, 9.0], "pressure": [11.0, 15.0, 99.0],
                                        "velocity": np.array([[0.0, 1, 0], [60.0, 0, 0], [0.0, 0, 0]])})
        self.assertAlmostEqual(detonation.profile_error(self.folder, "metal", "pressure", table), 1.0 / 40.0)
        self.assertAlmostEqual(detonation.profile_error(self.folder, "metal", "velocity", table), 20.0 / 100.0)
        self.assertTrue(math.isnan(detonation.profile_error(self.folder, "metal", "density", table)))
        self.assertTrue(math.isnan(detonation.profile_error(self.folder, "copper", "pressure", table)))

    def test_jet_speed_is_exceeded_by_the_fraction(self):
        velocity = np.zeros((100, 3))
        velocity[:, 0] = np.arange(100)
        write_run(self.folder, np.zeros((100, 3)), {"mass": np.ones(100), "velocity": velocity})
        self.assertEqual(detonation.jet_speed(self.folder, "metal", 0.01), 99.0)
        self.assertEqual(detonation.jet_speed(self.folder, "metal", 0.1), 90.0)

    def test_jet_gap_is_what_is_empty_between_tip_and_tail(self):
        places, velocity = np.zeros((100, 3)), np.zeros((100, 3))
        places[:, 0] = 1e-3 * (np.arange(100) + 0.5)  # one in each cell
        velocity[:, 0] = 10.0 * np.arange(100)
        write_run(self.folder, places, {"mass": np.ones(100), "velocity": velocity})
        self.assertEqual(detonation.jet_gap(self.folder, "metal", 0.01), 0.0)
        places[[10, 40, 41, 60], 0] += 1e-3  # the first is no jet: slower than a quarter of the tip
        write_run(self.folder, places, {"mass": np.ones(100), "velocity": velocity})
        self.assertAlmostEqual(detonation.jet_gap(self.folder, "metal", 0.01), 2.0 / 75.0)  # 41 came to 42, and 40 to 41

    def test_jet_fraction_counts_what_turns_between_two_snapshots(self):
        # Of ten particles that fall with 100 m/s three are slug and one is jet at 1 us; at 2 us six and two.
        (self.folder / "run.toml").write_text('[[body]]\nname = "strip"\nvelocity = ["10 m/s", "-100 m/s", "0 m/s"]\n')
        files = []
        for time, slug, jet in ((1e-6, 3, 1), (2e-6, 6, 2)):
            velocity = np.array([[5.0, 0, 0]] * slug + [[90.0, -1, 0]] * jet + [[10.0, -100, 0]] * (10 - slug - jet))
            files.append({"name": f"{jet}.hdf", "time": time})
            with h5py.File(self.folder / f"{jet}.hdf", "w") as file:
                data = file.create_group("VTKHDF")
                data["Points"] = np.zeros((10, 3))
                data["PointData/body"] = np.zeros(10, dtype=int)
                data["PointData/mass"] = np.ones(10)
                data["PointData/velocity"] = velocity
        (self.folder / "made.particles.hdf.series").write_text(json.dumps({"files": files}))
        self.assertAlmostEqual(detonation.jet_fraction(self.folder, "strip", 1e-6, 50.0), 1.0 / 4.0)
        self.assertTrue(math.isnan(detonation.jet_fraction(self.folder, "strip", 2e-6, 50.0)))  # nothing turns after the last
        self.assertTrue(math.isnan(detonation.jet_fraction(self.folder, "strip", 0.5e-6, 50.0)))  # no snapshot so early

    def test_arrival_speed_is_the_slope_over_tracers(self):
        names = [f"front_{i}" for i in range(4)]
        rows = ["time [s]," + ",".join(f"{n}.x [m],{n}.pressure [Pa]" for n in names)]
        for step in range(60):
            time = 1e-7 * step
            # A front of 5000 m/s whose pressure rises linearly over 2 mm.
            cells = [(0.01 + 0.005 * i, min(max(5000.0 * time - 0.01 - 0.005 * i, 0.0) / 0.002, 1.0) * 1e9) for i in range(4)]
            rows.append(f"{time}," + ",".join(f"{x},{p}" for x, p in cells))
        path = self.folder / "gauges.csv"
        path.write_text("\n".join(rows) + "\n")
        self.assertAlmostEqual(detonation.arrival_speed(path, "front"), 5000.0, delta=1.0)
        self.assertTrue(math.isnan(detonation.arrival_speed(path, "wall")))

    def write_front(self, arrival, places):
        """gauges.csv of tracers that a front of 10 GPa passes at given times (us), with 1 ns between its rows."""
        names = [f"front_{i:02d}" for i in range(len(places))]
        rows = ["time [s]," + ",".join(f"{n}.x [m],{n}.pressure [Pa]" for n in names)]
        for step in range(4000):
            time = 1e-9 * step
            cells = [(x, min(max((time - 1e-6 * t) / 2e-9, 0.0), 1.0) * 1e10) for x, t in zip(places, arrival)]
            rows.append(f"{time}," + ",".join(f"{x},{p}" for x, p in cells))
        path = self.folder / "gauges.csv"
        path.write_text("\n".join(rows) + "\n")
        return path

    def test_run_distance_is_where_a_shock_becomes_a_detonation(self):
        places = [0.01 + 0.0005 * i for i in range(40)]
        # 4000 m/s over the first 8 mm behind the place 0.01 m, 8000 m/s from there on.
        arrival = [min((x - 0.01) / 4e-3, 2.0) + max(x - 0.018, 0.0) / 8e-3 for x in places]
        self.assertAlmostEqual(detonation.run_distance(self.write_front(arrival, places), "front", 0.01), 0.008, delta=0.0005)
        steady = [(x - 0.01) / 4e-3 for x in places[:30]]
        self.assertTrue(math.isnan(detonation.run_distance(self.write_front(steady, places[:30]), "front", 0.01)))

    def test_peak_and_arrival_of_a_gauge(self):
        path = self.folder / "gauges.csv"
        path.write_text("time [s],far.pressure [Pa]\n0,\n1,100\n2,110\n3,200\n4,300\n5,150\n")
        self.assertEqual(detonation.peak_of_gauge(path, "far.pressure"), (300.0, 3.0))
        self.assertTrue(math.isnan(detonation.peak_of_gauge(path, "near.pressure")[0]))

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
