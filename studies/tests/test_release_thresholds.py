# SPDX-License-Identifier: BSD-3-Clause
"""Debye crystal, Hugoniot and thresholds against limits, the material library and the stored result."""
import contextlib
import io
import math
import pathlib
import tomllib
import unittest

import numpy as np

from studies.release_thresholds import release_thresholds as study

ROOT = pathlib.Path(__file__).resolve().parents[2]
SI = {"": 1.0, "g/mol": 1e-3, "cm^3/g": 1e-3, "km/s": 1e3, "J/(mol K^2)": 1.0}


def library(name):
    """Constants of the equation of state of a material, SI."""
    found = {}
    for key, value in tomllib.loads((ROOT / "eos" / "materials" / f"{name}.toml").read_text())["eos"].items():
        figure, _, unit = str(value).partition(" ")
        if unit in SI:
            with contextlib.suppress(ValueError):
                found[key] = float(figure) * SI[unit]
    return found


class DebyeCrystal(unittest.TestCase):
    def test_entropy_hot_and_cold(self):
        """3R (4/3 + ln(T/theta)) far above the Debye temperature; a third of the T^3 heat capacity far below."""
        hot = study.entropy_of(5000.0, 200.0, 0.0)
        self.assertAlmostEqual(hot, 3 * study.R * (4 / 3 + math.log(25.0)), delta=2e-3)
        cold = study.entropy_of(20.0, 1000.0, 0.0)
        self.assertAlmostEqual(cold, 4 / 5 * math.pi**4 * study.R * 0.02**3, delta=1e-3 * cold)

    def test_temperature_inverts_entropy(self):
        for temperature in (150.0, 1200.0, 9000.0):
            entropy = study.entropy_of(temperature, 343.0, 0.7e-3)
            self.assertAlmostEqual(study.temperature_of(entropy, 343.0, 0.7e-3), temperature, delta=1e-6 * temperature)


class Constants(unittest.TestCase):
    def test_are_those_of_the_library(self):
        for name in ("aluminium", "lead", "cadmium"):
            metal, constants = study.METALS[name], library(name)
            for ours, theirs in ((metal.molar_mass, constants["molar_mass"]),
                                 (1 / metal.density, constants["reference_specific_volume"]),
                                 (metal.intercept, constants["hugoniot_intercept"]),
                                 (metal.slopes[0], constants["hugoniot_slope"]),
                                 (metal.slopes[1], constants.get("hugoniot_quadratic", 0.0)),
                                 (metal.slopes[2], constants.get("hugoniot_cubic", 0.0)),
                                 (metal.gamma[0], constants["gruneisen"]),
                                 (metal.gamma[1], constants["gruneisen_slope"]),
                                 (metal.electronic, constants["electronic_heat_coefficient"])):
                self.assertAlmostEqual(ours, theirs, delta=1e-3 * abs(theirs), msg=name)


class Hugoniot(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.metal = study.METALS["aluminium"]
        cls.curve = study.hugoniot(cls.metal, cls.metal.gamma, 20)

    def test_begins_at_rest_and_is_of_third_order_in_the_strain(self):
        pressure, entropy, temperature = self.curve
        self.assertEqual((pressure[0], entropy[0], temperature[0]), (0.0, 0.0, study.AMBIENT))
        self.assertTrue((np.diff(entropy)[1:] > 0).all())
        weak, twice = np.interp((2.0, 4.0), pressure, entropy)
        self.assertTrue(6.0 < twice / weak < 8.0, f"{twice / weak}")

    def test_agrees_with_the_equation_of_state_of_the_library_while_solid(self):
        """`whipple eos hugoniot aluminium --to '60 GPa'`: 165.8 J/(kg K) and 479 K at 18 GPa, from 300 K."""
        pressure, entropy, temperature = self.curve
        self.assertAlmostEqual(np.interp(18.0, pressure, entropy) / self.metal.molar_mass, 165.8, delta=0.04 * 165.8)
        self.assertAlmostEqual(np.interp(18.0, pressure, temperature), 479.0, delta=6.0)


class Result(unittest.TestCase):
    def test_of_cadmium_is_the_stored_one(self):
        """The row in dispute: its published pair of thresholds does not agree with its heat of fusion."""
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            study.report("cadmium", study.METALS["cadmium"], study.METALS["cadmium"].gamma)
        stored = (ROOT / "studies" / "release_thresholds" / "result.txt").read_text()
        self.assertIn(output.getvalue(), stored)
