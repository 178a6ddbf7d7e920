# SPDX-License-Identifier: BSD-3-Clause
"""Tests of cases, runs and results in Python. $WHIPPLE_PROGRAM names the program."""
import pathlib
import tempfile
import unittest

import numpy as np

import whipple

DATA = pathlib.Path(__file__).resolve().parents[2] / "tests" / "data"
THROWN = DATA / "thrown_block.toml"
GRAVITY = 1e8  # m/s^2


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_case_is_read_changed_and_written(self):
        case = whipple.Case(THROWN, {"time.end": "1 us"})
        self.assertEqual(case["time.end"], "1 us")
        self.assertEqual(case["body.0.velocity"], ["0 m/s", "200 m/s"])
        with self.assertRaises(KeyError):
            case["time.first_step"]
        case["body.0.velocity"] = ["0 m/s", "100 m/s"]
        copy = case.write(self.folder / "copy.toml")
        self.assertEqual((copy["time.end"], copy["body.0.velocity"]), ("1 us", ["0 m/s", "100 m/s"]))
        self.assertIn("# A block thrown upwards", copy.file.read_text())
        with self.assertRaises(FileExistsError):
            case.write(copy.file)
        self.assertEqual(whipple.Case(THROWN)["time.end"], "3 us")

    def test_faults_are_data(self):
        case = whipple.Case(THROWN)
        self.assertEqual(case.faults(), [])
        found = case.check()
        self.assertEqual((found["particles"], found["bodies"][0]["name"]), (64, "block"))
        self.assertAlmostEqual(found["bodies"][0]["mass"], 4e-6 * 8930.0, delta=1e-9)
        case["domain.cell_size"] = "-1 mm"
        case["body.0.velocity.1"] = "2 kg"
        faults = {fault.key: fault for fault in case.faults()}
        self.assertEqual(set(faults), {"domain.cell_size", "body.0.velocity"})
        self.assertIn("> 0", faults["domain.cell_size"].text)
        with self.assertRaises(whipple.CaseError):
            case.run(self.folder / "run")
        self.assertFalse((self.folder / "run").exists())

    def test_results_are_arrays_with_units(self):
        results = whipple.Case(THROWN, {"time.end": "1 us"}).run(self.folder / "run", threads=1)
        history = results.history
        self.assertEqual((history.units["time"], history.units["kinetic_energy"]), ("s", "J"))
        self.assertIn("kinetic energy", history.meanings["kinetic_energy"])
        mass = history["mass"][0]
        speed = 200.0 - GRAVITY * history["time"]
        np.testing.assert_allclose(history["kinetic_energy"], 0.5 * mass * speed**2, rtol=1e-2)
        gauges = results.gauges
        np.testing.assert_allclose(gauges["middle.velocity_y"], 200.0 - GRAVITY * gauges["time"], atol=0.5)
        self.assertEqual(gauges.units["middle.velocity_y"], "m/s")
        np.testing.assert_allclose(results.times, [0.0, 1e-6])
        last = results.body(0)
        self.assertEqual((last["position"].shape, last.units["mass"]), ((64, 3), "kg"))
        np.testing.assert_allclose(last["mass"].sum(), mass, rtol=1e-6)
        self.assertEqual(results.quantities()["time"].value, 1e-6)

    def test_run_is_watched_steered_and_ended(self):
        case = whipple.Case(THROWN, {"time.end": "1 s", "gravity.acceleration.1": "0 m/s^2", "body.0.velocity.1": "0.001 m/s"})
        run = case.start(self.folder / "run", threads=1)
        for row in run.rows(pause=0.02):
            if row["step"] >= 5:
                break
        self.assertTrue(run.is_running)
        with self.assertRaises(TimeoutError):
            run.wait(timeout=0.01)
        self.assertIn("accepted", run.steer("snapshot"))
        with self.assertRaises(whipple.RunError) as refused:
            run.steer("no_such_request")
        self.assertEqual(refused.exception.code, 2)
        watched = whipple.Run(self.folder / "run")
        self.assertTrue(watched.is_running)
        watched.end()
        with self.assertRaises(whipple.RunError) as stopped:
            watched.wait()
        self.assertIn("is stopped", str(stopped.exception))
        self.assertEqual(watched.status["state"], "stopped")
        self.assertGreater(len(run.results.times), 1)
        with self.assertRaises(whipple.RunError):
            run.wait()

    def test_run_out_of_range_tells_its_code(self):
        case = whipple.Case(THROWN, {"output.maximum_speed_factor": 0.5})
        with self.assertRaises(whipple.RunError) as failed:
            case.run(self.folder / "run", threads=1)
        self.assertEqual(failed.exception.code, 3)
        self.assertIn("maximum_speed_factor", str(failed.exception))

    def test_study_is_tables(self):
        study = self.folder / "study.toml"
        study.write_text(f'case = "{THROWN}"\n[[vary]]\nkey = "body.0.velocity.1"\nvalues = ["100 m/s", "200 m/s", "250 m/s"]\n'
                         '[[quantity]]\nname = "gauge.middle.y"\ntake = "largest"\n', encoding="utf-8")
        study = whipple.sweep(study, self.folder / "study")
        self.assertEqual(study.quantities, ["largest gauge.middle.y"])
        points = study.points
        self.assertEqual(list(points["state"]), 3 * ["done"])
        rise = points["largest gauge.middle.y"] - 0.125e-3
        np.testing.assert_allclose(rise, points["body.0.velocity.1"]**2 / (2 * GRAVITY), rtol=3e-2)
        self.assertEqual(points.units["body.0.velocity.1"], "m/s")
        self.assertAlmostEqual(study.sensitivities["largest gauge.middle.y"][0], 1.0)
        with self.assertRaises(AttributeError):
            study.limits

    def test_materials(self):
        self.assertIn("copper", {material["key"] for material in whipple.materials()})


if __name__ == "__main__":
    unittest.main()
