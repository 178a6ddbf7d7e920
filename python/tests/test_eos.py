# SPDX-License-Identifier: BSD-3-Clause
"""Tests of whipple.eos: numbers of the library, shapes and kinds of arrays, errors. PYTHONPATH names the folder of the
built package (tests/python.cmake)."""
import contextlib
import copy
import importlib
import io
import logging
import os
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import threading
import tomllib
import unittest.mock

import numpy as np

from whipple import eos

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COPPER = eos.material("copper")
SIMPLE = eos.material("copper_ofhc_mie_gruneisen")


class Library(unittest.TestCase):
    def test_lists_every_file_of_the_folder(self):
        keys = {entry.key for entry in eos.materials()}
        self.assertEqual(keys, {path.stem for path in (SOURCE / "eos/materials").glob("*.toml")})
        groups = {entry.group for entry in eos.materials()}
        self.assertIn("explosives", groups)

    def test_folders_and_files_need_no_names_in_utf8(self):
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.dict(os.environ):
            os.environ["WHIPPLE_MATERIALS"] = folder
            path = pathlib.Path(folder, os.fsdecode(b"br\xfcche.toml"))
            path.write_text("name = \"broken\"\n", encoding="utf-8")
            entry = next(entry for entry in eos.materials() if entry.file == str(path))
            self.assertEqual((entry.key, repr(entry)), (path.stem, f"<{path.stem}: {entry.note}>"))
            self.assertIn(path.stem, entry.note + entry.name)

    def test_a_material_tells_its_sources_and_constants(self):
        self.assertEqual((COPPER.name, COPPER.model, COPPER.group), ("copper", "gray", "metals"))
        self.assertIn("Liu, Wang and Zhang", COPPER.source)
        self.assertIn("Johnson and Cook", COPPER.sources["strength"])
        self.assertEqual(set(COPPER.sources), {"file", "eos", "measured", "strength", "failure.0"})
        of_base = eos.material("aluminium_6061_t6_fracture").sources
        self.assertLessEqual({"file", "eos", "strength", "failure.0", "failure.1"}, set(of_base))
        self.assertIn("damage", of_base["file"])
        constants = tomllib.loads(COPPER.constants)
        self.assertEqual(constants["eos"]["hugoniot_slope"], 1.489)
        self.assertEqual(COPPER.measured_melting_point, 1357.77)
        self.assertTrue(pathlib.Path(COPPER.file).is_file())

    def test_constants_can_be_changed(self):
        stiffer = eos.material("copper", {"eos.hugoniot_slope": "1.6"})
        at = dict(particle_velocity=2000.0)
        self.assertGreater(stiffer.hugoniot(**at).pressure, COPPER.hugoniot(**at).pressure)
        self.assertEqual(eos.material(pathlib.Path(COPPER.file)).name, "copper")

    def test_samples_need_a_covariance(self):
        with self.assertRaisesRegex(eos.InputError, "covariance"):
            eos.samples("copper", 3)

    def test_validity(self):
        audit = COPPER.audit()
        self.assertTrue(audit.usable)
        self.assertIn("kg/m^3", audit.range)
        self.assertGreater(audit.strongest_shock, 5e11)
        self.assertLess(*audit.densities)
        self.assertEqual(audit.findings, [])

    def test_errors_carry_the_text_of_the_library(self):
        with self.assertRaisesRegex(eos.InputError, "no material file 'coper', did you mean"):
            eos.material("coper")
        with self.assertRaisesRegex(ValueError, "hugoniot_slope"):
            eos.material("copper", {"eos.hugoniot_slope": "fast"})
        with self.assertRaises(eos.InputError) as caught:
            eos.material("copper", {"eos.hugoniot_slope": "fast", "eos.colour": "1"})
        self.assertEqual([fault["key"] for fault in caught.exception.faults], ["eos.hugoniot_slope", "eos.colour"])
        with self.assertRaisesRegex(eos.InputError, "named by two quantities"):
            COPPER.states(density=9000.0)

    def test_messages_go_to_logging(self):
        with self.assertLogs("whipple", logging.WARNING) as caught:
            eos.material("tnt", {"eos.detonation_velocity": "9 km/s"})
        self.assertIn("9", caught.output[0])


class Arrays(unittest.TestCase):
    def test_one_state_is_a_number(self):
        state = COPPER.states(density=9500.0, temperature=1000.0)
        self.assertEqual(state.shape, ())
        self.assertIsInstance(float(state.pressure), float)
        self.assertEqual(state.phase, "solid")
        again = COPPER.evaluate(9500.0, state.energy)
        self.assertAlmostEqual(again.pressure / state.pressure, 1.0, delta=1e-9)

    def test_batch_and_single_states_agree(self):
        density, energy = np.linspace(8000, 11000, 41)[:, None], np.linspace(3e5, 8e6, 31)
        batch, full = COPPER.evaluate(density, energy), COPPER.states(density=density, energy=energy)
        for quantity in ("pressure", "temperature", "sound_speed"):
            np.testing.assert_allclose(getattr(batch, quantity), getattr(full, quantity), rtol=1e-6, err_msg=quantity)
        self.assertEqual(batch.shape, (41, 31))
        self.assertEqual(full.phase.shape, (41, 31))
        # A fresh array, not a view of other strides.
        one = COPPER.evaluate(density[7, 0], energy[3])
        self.assertEqual(one.pressure, batch.pressure[7, 3])

    def test_kinds_of_arrays(self):
        density = np.linspace(9000, 12000, 12)
        expected = SIMPLE.evaluate(density, 1e6).pressure
        for name, given in {"list": list(density), "strides": np.repeat(density, 3)[::3],
                            "reversed": density[::-1][::-1], "read-only": np.broadcast_to(density, (12,)),
                            "big-endian": density.astype(">f8")}.items():
            np.testing.assert_array_equal(SIMPLE.evaluate(given, 1e6).pressure, expected, err_msg=name)
        single = density.astype(np.float32)
        np.testing.assert_array_equal(SIMPLE.evaluate(single, 1000000).pressure,
                                      SIMPLE.evaluate(single.astype(float), 1e6).pressure)
        columns = np.asfortranarray(density.reshape(3, 4))
        np.testing.assert_array_equal(SIMPLE.evaluate(columns, 1e6).pressure, expected.reshape(3, 4))

    def test_empty_arrays(self):
        for shape in ((0,), (3, 0)):
            empty = np.empty(shape)
            self.assertEqual(COPPER.evaluate(empty, 1e6).pressure.shape, shape)
            states = COPPER.states(density=empty, temperature=300.0)
            self.assertEqual((states.pressure.shape, states.phase.shape), (shape, shape))
            self.assertEqual(COPPER.hugoniot(pressure=empty).shock_velocity.shape, shape)
            self.assertEqual(COPPER.isentrope(density=empty).riemann_velocity.shape, shape)

    def test_wrong_shapes_and_types(self):
        with self.assertRaisesRegex(ValueError, "broadcast"):
            COPPER.evaluate(np.ones(3), np.ones(4))
        with self.assertRaisesRegex(TypeError, "density"):
            COPPER.evaluate("dense", 1e6)
        with self.assertRaises(TypeError):
            COPPER.states(9000.0, 300.0)
        with self.assertRaisesRegex(ValueError, "another shape"):
            SIMPLE.evaluate(np.full(5, 9e3), 1e6, out=SIMPLE.evaluate(np.full(4, 9e3), 1e6))

    def test_states_are_views_that_cannot_be_written_and_outlive_their_owner(self):
        pressure = COPPER.states(density=np.linspace(9000, 9900, 5), temperature=300.0).pressure
        self.assertFalse(pressure.flags.writeable)
        self.assertTrue(np.all(np.diff(pressure) > 0))

    def test_choice_by_index(self):
        shocks = COPPER.hugoniot(particle_velocity=np.array([[500.0, 1000.0], [1500.0, 2000.0]]))
        self.assertAlmostEqual(shocks[1, 0].particle_velocity, 1500.0, delta=1e-9)
        self.assertEqual(shocks[:, 1].shape, (2,))
        chosen = shocks[shocks.particle_velocity > 900]
        np.testing.assert_array_equal(chosen.pressure, shocks.pressure[shocks.particle_velocity > 900])
        with self.assertRaises(IndexError):
            shocks[4]

    def test_results_can_be_reused(self):
        density = np.linspace(9000, 12000, 1000)
        out = SIMPLE.evaluate(density, 1e6)
        pressure = out.pressure
        SIMPLE.evaluate(density, 2e6, out=out)
        np.testing.assert_array_equal(pressure, SIMPLE.evaluate(density, 2e6).pressure)


class OutOfRange(unittest.TestCase):
    density = np.array([9000.0, 1e6, 9500.0, np.nan])

    def test_evaluation_names_the_first_point(self):
        with self.assertRaisesRegex(eos.StateError, r"2 of 4 points .* the first is 1: 1e\+06 kg/m\^3"):
            COPPER.evaluate(self.density, 1e6)
        with self.assertRaises(ArithmeticError):
            SIMPLE.evaluate(np.nan, 1e6)

    def test_colder_than_the_coldest_state(self):
        # As in a simulation, a batch is held there; a single state has no answer.
        coldest = COPPER.cold_curve(11000.0)
        held = COPPER.evaluate(11000.0, 0.5 * coldest.energy)
        self.assertAlmostEqual(held.temperature, coldest.temperature, delta=1e-3)
        with self.assertRaisesRegex(eos.StateError, "the coldest one"):
            COPPER.states(density=11000.0, energy=0.5 * coldest.energy)

    def test_skipped_points_are_nan_and_others_unchanged(self):
        for material in (COPPER, SIMPLE):
            some = material.evaluate(self.density, 1e6, skip_invalid=True)
            np.testing.assert_array_equal(np.isnan(some.pressure), [False, True, False, True])
            good = material.evaluate(self.density[::2], 1e6)
            for quantity in ("pressure", "temperature", "sound_speed", "melted_fraction", "vaporised_fraction"):
                np.testing.assert_array_equal(getattr(some, quantity)[::2], getattr(good, quantity))
            states = material.states(density=self.density, temperature=400.0, skip_invalid=True)
            np.testing.assert_array_equal(np.isnan(states.pressure), [False, True, False, True])

    def test_loci_name_the_point_or_skip_it(self):
        pressures = np.array([1e10, 1e15, np.nan])
        with self.assertRaisesRegex(eos.StateError, "point 1 of 3: .*maximum density"):
            COPPER.hugoniot(pressure=pressures)
        with self.assertRaisesRegex(eos.StateError, "nan"):
            COPPER.states(density=[9000.0, np.nan], temperature=300.0)
        shocks = COPPER.hugoniot(pressure=pressures, skip_invalid=True)
        np.testing.assert_array_equal(np.isnan(shocks.shock_velocity), [False, True, True])
        with self.assertRaisesRegex(eos.StateError, "finite and above zero"):
            COPPER.isentrope(density=[np.nan, 9e3])
        with self.assertRaisesRegex(eos.InputError, "another equation of state"):
            SIMPLE.release(COPPER.reference)
        self.assertTrue(np.all(np.isnan(COPPER.release(shocks, skip_invalid=True).density[1:])))


class Loci(unittest.TestCase):
    def test_jump_conditions_on_the_hugoniot(self):
        up = np.linspace(100, 4000, 14)
        s, start = COPPER.hugoniot(particle_velocity=up), COPPER.reference
        np.testing.assert_allclose(s.pressure, start.density * s.shock_velocity * up + start.pressure, rtol=1e-9)
        np.testing.assert_allclose(s.density * (s.shock_velocity - up), start.density * s.shock_velocity, rtol=1e-9)
        np.testing.assert_allclose(SIMPLE.hugoniot(particle_velocity=up).shock_velocity, 3940 + 1.489 * up, rtol=1e-6)

    def test_porous_and_reflected_hugoniots(self):
        solid = COPPER.hugoniot(pressure=4e10)
        porous = COPPER.hugoniot(pressure=4e10, initial_density=6000.0)
        self.assertGreater(porous.temperature, 2 * solid.temperature)
        reflected = COPPER.hugoniot(pressure=4e10, reflected_pressure=2e10)
        self.assertLess(reflected.temperature, solid.temperature)
        with self.assertRaisesRegex(eos.InputError, "above the reference density"):
            COPPER.hugoniot(pressure=4e10, initial_density=9500.0)

    def test_isentrope_keeps_the_entropy_in_any_order_of_densities(self):
        start = COPPER.hugoniot(pressure=5e10)
        density = np.array([9000.0, 12000.0, 10500.0, 8800.0, 11000.0])
        line = COPPER.isentrope(density=density, start=start)
        np.testing.assert_allclose(line.entropy, start.entropy, rtol=1e-6)
        np.testing.assert_allclose(line.density, density, rtol=1e-14)
        np.testing.assert_array_equal(line.riemann_velocity > 0, density > start.density)
        at = COPPER.isentrope(pressure=line.pressure, start=start)
        np.testing.assert_allclose(at.density, density, rtol=1e-7)
        with self.assertRaisesRegex(eos.InputError, "expected one state"):
            COPPER.isentrope(density=9000.0, start=line)

    def test_isotherm_and_cold_curve(self):
        # Dewaele et al. 2004: 100 GPa within 0.5 GPa at 0.7206 of the volume (tests/eos.cmake).
        state = COPPER.isotherm(1e11)
        self.assertAlmostEqual(COPPER.reference.density / state.density, 0.72056, delta=1e-5)
        cold = COPPER.cold_curve(np.array([9000.0, 12000.0]))
        self.assertTrue(np.all(cold.pressure < COPPER.isotherm(cold.pressure + 5e9).pressure))
        np.testing.assert_allclose(COPPER.isotherm([1e9, 1e10], 900.0).temperature, 900.0, rtol=1e-9)

    def test_melting_and_vaporisation(self):
        solidus, liquidus = COPPER.melting([0.0, 1e11])
        self.assertTrue(np.all(liquidus.temperature >= solidus.temperature))
        self.assertTrue(np.all(solidus.density > liquidus.density))
        temperature, pressure, density = COPPER.critical_point
        self.assertAlmostEqual(temperature, 8511, delta=1)
        liquid, vapour = COPPER.vaporisation(temperature=[4000.0, 6000.0])
        np.testing.assert_allclose(liquid.pressure, vapour.pressure, rtol=1e-6)
        with self.assertRaisesRegex(eos.InputError, "no liquid and vapour"):
            SIMPLE.vaporisation(temperature=3000.0)
        with self.assertRaises(eos.StateError):
            COPPER.vaporisation(temperature=9000.0)

    def test_thresholds_and_release(self):
        thresholds = COPPER.thresholds(1e5)
        self.assertAlmostEqual(thresholds["shock_melting_onset"].pressure / 1e9, 221.9, delta=0.1)
        self.assertAlmostEqual(thresholds["shock_melting_completion"].pressure / 1e9, 285.9, delta=0.1)
        released = COPPER.release(COPPER.hugoniot(pressure=[1e10, 396e9]), 1e5)
        np.testing.assert_array_equal(released.in_equilibrium, [0, 1])
        self.assertAlmostEqual(released.vaporised_fraction[1], 0.1000, delta=1e-3)
        self.assertTrue(all(value is None for value in SIMPLE.thresholds().values()))

    def test_impact(self):
        aluminium = eos.material("aluminium")
        match = eos.impact(COPPER, aluminium, [2000.0, 5550.0])
        np.testing.assert_allclose(match.projectile.pressure, match.target.pressure, rtol=1e-6)
        own = eos.impact(COPPER, COPPER, 3000.0)
        self.assertAlmostEqual(own.velocity, 1500.0, delta=1e-3)

    def test_mixture(self):
        tungsten = eos.material("tungsten")
        parts = [(COPPER, 0.3), (tungsten, 0.7)]
        mixed = eos.mixture(parts, pressure=[0.0, 2e10], temperature=500.0)
        np.testing.assert_allclose(sum(mixed.volume_fractions), 1.0, rtol=1e-12)
        volume = 0.3 / mixed.components[0].density + 0.7 / mixed.components[1].density
        np.testing.assert_allclose(1 / mixed.state.density, volume)
        again = eos.mixture(parts, density=mixed.state.density, energy=mixed.state.energy)
        np.testing.assert_allclose(again.state.temperature, 500.0, rtol=1e-6)
        with self.assertRaisesRegex(eos.InputError, "mass fractions"):
            eos.mixture([(COPPER, 0.3), (tungsten, 0.6)], pressure=0.0, temperature=300.0)

    def test_table(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "copper.eos.h5"
            table = COPPER.table(1e-3, densities=(8000.0, 12000.0), temperatures=(200.0, 1200.0), file=file)
            self.assertTrue(file.is_file())
        self.assertEqual(table.model, "table")
        state = dict(density=np.linspace(8600, 11000, 7), temperature=800.0)
        np.testing.assert_allclose(table.states(**state).pressure, COPPER.states(**state).pressure, rtol=3e-3, atol=3e7)

    def test_comparison_with_measurements(self):
        [comparison] = COPPER.compare(SOURCE / "eos/data/cu_hugoniot_marsh1980.csv")
        self.assertEqual(comparison.kind, eos.ExperimentKind.shock_velocity)
        self.assertLess(comparison.rms, 2.0)
        self.assertEqual(len(comparison.model), len(comparison.measured))
        with self.assertRaises(eos.InputError):
            COPPER.compare("nowhere.csv")

    def test_a_fit_to_own_data(self):
        up = np.linspace(300, 2500, 12)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "mine.csv"
            rows = "".join(f"{a / 1e3},{(4000 + 1.5 * a) / 1e3}\n" for a in up)
            file.write_text("# a Hugoniot of my own\nup [km/s],us [km/s]\n" + rows, encoding="utf-8")
            [data] = eos.measurements(file)
        np.testing.assert_allclose(data.abscissa, up, rtol=1e-12)
        slope, intercept = np.polyfit(data.abscissa, data.measured, 1)
        fitted = eos.material("copper_ofhc_mie_gruneisen", {"eos.hugoniot_intercept": f"{intercept} m/s",
                                                            "eos.hugoniot_slope": f"{slope}"})
        np.testing.assert_allclose(fitted.hugoniot(particle_velocity=up).shock_velocity, 4000 + 1.5 * up, rtol=1e-6)


class Explosives(unittest.TestCase):
    def test_detonation_and_what_it_drives(self):
        explosive = eos.material("composition_b")
        detonation = explosive.detonation()
        self.assertAlmostEqual(detonation.wave.shock_velocity, 7980, delta=1)
        self.assertAlmostEqual(detonation.wave.pressure / 1e9, 29.5, delta=0.01)
        products = detonation.expansion([detonation.volume, 1.0, 7.0, 100.0])
        np.testing.assert_allclose(products.energy[1:] / explosive.states().energy, [0.868, 0.194, 0.078], atol=6e-4)
        contact = detonation.contact(SIMPLE)
        self.assertAlmostEqual(contact.pressure / 1e9, 47.79, delta=0.02)
        wall = detonation.cylinder([6e-3, 19e-3])
        np.testing.assert_allclose(wall["radial_speed"], [1399, 1626], atol=1)
        speeds = eos.gurney_speed(eos.GurneyShape.sphere, detonation.gurney_velocity(), [0.5, 1.0])
        np.testing.assert_allclose(speeds, 2826 / np.sqrt([1.1, 1.6]), rtol=1e-3)
        with self.assertRaisesRegex(eos.InputError, "no explosive"):
            COPPER.detonation()


class Manual(unittest.TestCase):
    def test_the_five_minutes_run(self):
        text = (SOURCE / "docs/manual/python.md").read_text(encoding="utf-8")
        names = {}
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(re.search(r"## Five minutes\n.*?```python\n(.*?)```", text, re.DOTALL).group(1), names)
        self.assertIn("solid", printed.getvalue())
        self.assertEqual(names["grid"].shape, (1000, 1000))


class Module(unittest.TestCase):
    def test_import_twice(self):
        self.assertIs(importlib.import_module("whipple.eos"), eos)
        code = ("import sys, whipple.eos as first\ndel sys.modules['whipple.eos']\nimport whipple.eos as second\n"
                "assert first.material('copper').name == second.material('copper').name == 'copper'\n"
                "assert second.InputError is first.InputError\n")
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_beside_h5py(self):
        # h5py brings another libhdf5 into the process.
        code = ("import h5py, tempfile, pathlib\nfrom whipple import eos\nfolder = tempfile.mkdtemp()\n"
                "file = pathlib.Path(folder) / 'a.eos.h5'\n"
                "eos.material('copper_debye').table(1e-2, densities=(8e3, 1e4), temperatures=(250., 900.), file=file)\n"
                "assert len(h5py.File(file)) > 0\n")
        for order in (code, "from whipple import eos\n" + code):
            subprocess.run([sys.executable, "-c", order], check=True)

    def test_threads_compute_side_by_side(self):
        density = np.linspace(8500, 13000, 20000)
        expected = COPPER.evaluate(density, 3e6).pressure
        results = [None] * 4
        def work(i):
            results[i] = COPPER.evaluate(density, 3e6).pressure
        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, expected)

    def test_ctrl_c_ends_a_long_loop(self):
        code = ("import _thread, threading, numpy as np\nfrom whipple import eos\ncu = eos.material('copper')\n"
                "threading.Timer(0.3, _thread.interrupt_main).start()\n"
                "try:\n    cu.hugoniot(pressure=np.linspace(1e9, 3e11, 500000))\n"
                "except KeyboardInterrupt:\n    print('ended')\n")
        run = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, timeout=60)
        self.assertEqual(run.stdout.strip(), "ended")


class Copies(unittest.TestCase):
    """Pickles and copies are the same numbers; arrays of results cannot be written."""

    def setUp(self):
        self.material = eos.material("copper", {"eos.gruneisen": "1.9"})

    def test_materials(self):
        for copy_of in (lambda x: pickle.loads(pickle.dumps(x)), copy.copy, copy.deepcopy):
            again = copy_of(self.material)
            self.assertEqual(again.constants, self.material.constants)
            self.assertEqual(again.evaluate(9000.0, 2e5).pressure, self.material.evaluate(9000.0, 2e5).pressure)
        again = pickle.loads(pickle.dumps(self.material.table(1e-3)))
        self.assertEqual(again.model, "table")

    def test_a_changed_file_is_not_the_material_that_was_pickled(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "mine.toml"
            text = pathlib.Path(self.material.file).read_text(encoding="utf-8")
            file.write_text(text, encoding="utf-8")
            packed = pickle.dumps(eos.material(file))
            file.write_text(text.replace("gruneisen = 1.97", "gruneisen = 1.96"), encoding="utf-8")
            with self.assertRaisesRegex(eos.InputError, "has changed since"):
                pickle.loads(packed)

    def test_paths_that_are_not_utf_8(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / os.fsdecode(b"caf\xe9.toml")
            file.write_text(pathlib.Path(COPPER.file).read_text(encoding="utf-8"), encoding="utf-8")
            material = eos.material(file)
            self.assertEqual(pathlib.Path(material.file), file)
            self.assertIn("[eos]", material.constants)
            self.assertEqual(pickle.loads(pickle.dumps(material)).constants, material.constants)
            with self.assertRaises(eos.InputError) as caught:
                eos.material(file.with_stem(file.stem + "2"))
            self.assertIn(file.stem + "2", str(caught.exception))

    def test_evaluations(self):
        result = self.material.evaluate([[9000.0, 9500.0, 3000.0]], [[2e5], [4e6]])
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual(again.shape, (2, 3))
        for name in ("pressure", "temperature", "sound_speed", "melted_fraction", "vaporised_fraction"):
            np.testing.assert_array_equal(getattr(again, name), getattr(result, name))
        shape, columns = result.__getstate__()
        for pack in ((shape, columns + columns[:1]), (shape, columns[:4]), ((3,), columns), (shape,),
                     (shape, [column[:1] for column in columns])):
            with self.assertRaisesRegex(eos.InputError, "another version"):
                eos.Evaluation.__new__(eos.Evaluation).__setstate__(pack)

    def test_states(self):
        states = self.material.states(pressure=np.linspace(1e9, 4e11, 6).reshape(2, 3), temperature=2000.0)
        shocks = self.material.hugoniot(particle_velocity=[500.0, 3000.0])
        for states in (states, shocks, states[1, 2]):
            again = pickle.loads(pickle.dumps(states))
            self.assertIs(type(again), type(states))
            for name in ("density", "energy", "temperature", "entropy", "phase", "melted_fraction"):
                np.testing.assert_array_equal(getattr(again, name), getattr(states, name))
        again = pickle.loads(pickle.dumps(shocks))
        np.testing.assert_array_equal(again.shock_velocity, shocks.shock_velocity)
        self.assertEqual(len(again), 2)
        with self.assertRaisesRegex(eos.InputError, "from a pickle"):
            self.material.release(again, 1e5)
        self.material.release(copy.deepcopy(shocks), 1e5)
        self.assertIn("temperature [K]", str(shocks))
        with self.assertRaises(TypeError):
            len(shocks[0])

    def test_arrays_cannot_be_written(self):
        result = self.material.evaluate([9000.0, 9500.0], 2e5)
        shocks = self.material.hugoniot(particle_velocity=[500.0, 3000.0])
        for array in (result.pressure, shocks.density, shocks.shock_velocity):
            with self.assertRaisesRegex(ValueError, "read-only"):
                array[0] = 1.0
        again = pickle.loads(pickle.dumps(result))
        np.testing.assert_array_equal(again.sound_speed, result.sound_speed)
        self.assertEqual(len(again), 2)
        # An earlier result can be overwritten by the module itself.
        self.material.evaluate([9500.0, 9000.0], 2e5, out=result)
        np.testing.assert_array_equal(result.pressure, again.pressure[::-1])

    def test_masks_and_complex_numbers_are_refused(self):
        for bad in (np.ma.array([9000.0, 9100.0], mask=[False, True]), np.array([9000 + 1j]), [9000 + 0j]):
            with self.assertRaisesRegex(eos.InputError, "name no state"):
                self.material.evaluate(bad, 2e5)
        clear = np.ma.array([9000.0, 9100.0], mask=[False, False])
        self.assertEqual(len(self.material.evaluate(clear, 2e5)), 2)

    def test_entries_of_the_library_name_materials(self):
        for entry in eos.materials()[:5]:
            self.assertEqual(eos.material(entry).name, entry.name)
            self.assertEqual(eos.material(entry.name).name, entry.name)


class Package(unittest.TestCase):
    """Without the compiled module the package says how to get it."""

    def test_remedy(self):
        package = pathlib.Path(eos.__file__).with_name("__init__.py")
        with tempfile.TemporaryDirectory() as folder:
            target = pathlib.Path(folder) / "whipple"
            target.mkdir()
            (target / "__init__.py").write_text(package.read_text(encoding="utf-8"), encoding="utf-8")
            environment = {**os.environ, "PYTHONPATH": folder}
            def told(code):
                return subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True,
                                      check=False).stderr
            for code in ("from whipple import eos", "import whipple.eos", "import whipple; whipple.eos"):
                self.assertIn("cmake --build --preset release --target whipple_python_eos", told(code))
            self.assertEqual(told("import whipple; assert not hasattr(whipple, 'eos')"), "")
            self.assertIn("No module named 'whipple.eso'", told("import whipple.eso"))
            (target / "eos.cpython-399-x86_64-linux-gnu.so").write_text("")
            self.assertIn("another Python", told("import whipple.eos"))


if __name__ == "__main__":
    unittest.main()
