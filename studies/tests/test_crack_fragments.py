# SPDX-License-Identifier: BSD-3-Clause
"""What the study of cracks computes itself: Mott's statistics, and rows that are runs of their own."""
import dataclasses
import math
import pathlib
import tempfile
import tomllib
import unittest
from unittest import mock

import numpy as np

from studies import commands
from studies.crack_fragments import crack_fragments, fields_in_cases, mott


class Mott(unittest.TestCase):
    def test_number_is_that_of_the_unloading_and_grows_with_a_delay(self):
        numbers = [mott.fragments(seed, elements=2000) for seed in range(1, 6)]
        self.assertTrue(35 < np.mean(numbers) < 55)
        self.assertGreater(mott.fragments(1, delay=0.4e-6, elements=2000), numbers[0])

    def test_slower_rings_break_into_fewer(self):
        slow = dataclasses.replace(mott.Ring(), stretch_rate=0.25 * mott.Ring.stretch_rate)
        self.assertLess(mott.fragments(1, slow, elements=2000), 0.6 * mott.fragments(1, elements=2000))

    def test_constants_are_those_of_the_case(self):
        folder = commands.ROOT / "cases/shell_fragmentation"
        case = tomllib.loads((folder / "ring.toml").read_text())
        ring, = case["body"]
        steel = tomllib.loads((folder / ring["material"]).read_text())
        strength, (failure,), eos = steel["strength"], steel["failure"], steel["eos"]
        units = {"g/cm^3": 1e3, "J/(kg K)": 1.0, "MPa": 1e6, "K": 1.0, "1/s": 1.0, "m^3": 1.0, "mm": 1e-3}
        si = (lambda text: float(text.split()[0]) * units[text.split(maxsplit=1)[1]])
        inner, outer = si(ring["shape"]["tube"]["inner_radius"]), si(ring["shape"]["tube"]["outer_radius"])
        expected = mott.Ring(
            radius=0.5 * (inner + outer), thickness=outer - inner, stretch_rate=si(ring["expansion_rate"][0]),
            failure_strain=failure["failure_strain"], modulus=ring["failure_scatter"]["weibull_modulus"],
            reference_volume=si(ring["failure_scatter"]["reference_volume"]), density=si(eos["reference_density"]),
            heat_capacity=si(eos["heat_capacity"]), yield_stress=si(strength["yield_stress"]),
            hardening=si(strength["hardening_coefficient"]), exponent=strength["hardening_exponent"],
            rate_coefficient=strength["rate_coefficient"], softening=strength["thermal_exponent"],
            temperature=si(strength["reference_temperature"]), melting=si(strength["melting_temperature"]))
        for name, value in dataclasses.asdict(mott.Ring()).items():
            self.assertAlmostEqual(getattr(expected, name) / value, 1.0, places=12, msg=name)
        self.assertEqual((si(strength["reference_rate"]), case["domain"]["dimension"]), (1.0, "plane_strain"))
        self.assertAlmostEqual(crack_fragments.WALL["ring"], outer - inner)
        self.assertAlmostEqual(crack_fragments.PERIMETER["ring"], 2 * math.pi * mott.Ring.radius)

    def test_flow_stress_softens_by_its_heat(self):
        self.assertTrue(1.0e9 < mott.flow_stress(0.5) < 1.293e9)


class Rows(unittest.TestCase):
    def test_every_row_has_a_run_of_its_own(self):
        names = [row.name for row in crack_fragments.ROWS]
        self.assertEqual(len(names), len(set(names)))
        for row in crack_fragments.ROWS:
            self.assertTrue(row.case.is_file())

    def test_every_row_of_other_cases_differs_by_the_fields_alone(self):
        names = [row.name for row in fields_in_cases.ROWS]
        self.assertEqual(len(names), len(set(names)))
        for row in fields_in_cases.ROWS:
            self.assertTrue(row.file.is_file())
            none, fields = (row.words(kind) for kind in fields_in_cases.FIELDS)
            self.assertEqual(len(none), len(fields))
            self.assertEqual(sum(a != b for a, b in zip(none, fields)), len(row.bodies))


class Runs(unittest.TestCase):
    """A program that counts its calls."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.top = pathlib.Path(temporary.name)
        self.folder, self.case = self.top / "run", self.top / "case.toml"
        self.case.write_text("a")
        commands.program.cache_clear()
        self.write("whipple 0.1.0 (revision 1)")

    def write(self, version):
        self.whipple = self.top / "whipple"
        self.whipple.write_text(f"#!/bin/sh\nif [ $1 = version ]; then echo '{version}'; exit; fi\n"
                                f"mkdir -p {self.folder}; echo $1 >> {self.top}/calls\n")
        self.whipple.chmod(0o755)
        commands.program.cache_clear()

    def calls(self, *words):
        commands.compute(self.whipple, self.folder, [["run", self.case, "-o", self.folder, *words], ["analyse", self.folder]], [self.case])
        return len((self.top / "calls").read_text().split())

    def test_are_repeated_where_anything_has_changed(self):
        self.assertEqual((self.calls(), self.calls()), (2, 2))
        self.assertEqual((self.calls("--set", "x=1"), self.calls("--set", "x=1")), (4, 4))
        self.case.write_text("b")
        self.assertEqual(self.calls("--set", "x=1"), 6)
        self.write("whipple 0.1.0 (revision 2)")
        self.assertEqual(self.calls("--set", "x=1"), 8)
        for count in (10, 10):
            self.write("whipple 0.1.0 (revision 2+changes)")
            self.assertEqual(self.calls("--set", "x=1"), count)
        self.whipple.write_text(self.whipple.read_text() + "# other\n")
        commands.program.cache_clear()
        self.assertEqual(self.calls("--set", "x=1"), 12)

    def test_are_repeated_where_a_material_of_the_library_has_changed(self):
        library = self.top / "library"
        (self.folder / "materials").mkdir(parents=True)
        library.mkdir()
        (self.folder / "materials/alloy.toml").write_text("merged")
        (library / "alloy.toml").write_text('base = "metal"')
        (library / "metal.toml").write_text("density = 1")
        with mock.patch.object(commands, "LIBRARY", library):
            self.assertEqual((self.calls(), self.calls()), (2, 2))
            (library / "metal.toml").write_text("density = 2")
            self.assertEqual((self.calls(), self.calls()), (4, 4))
            (library / "alloy.toml").write_text("density = 2")
            self.assertEqual((self.calls(), self.calls()), (6, 6))


if __name__ == "__main__":
    unittest.main()
