# SPDX-License-Identifier: BSD-3-Clause
"""Measures of a bar that is pulled apart, of tables made for it: the section shrinks at a known rate, and the force ends."""
import math
import pathlib
import tempfile
import unittest

from report import tension
from report.expectations import BadExpectation

RATE, BREAK, END = 1000.0, 200e-6, 260e-6  # 1/s; s
RADII = (0.0, 1e-3, 2e-3)
SHEAR = (1e8, 2e8, 3e8)  # Pa, xy, yz and zx
FORCE, HELD = 5e3, 0.2  # N before the break and the part of it after


class Bar(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        times = [1e-6 * i for i in range(int(END / 1e-6) + 1)]
        impulse = [-FORCE * (min(t, BREAK) + HELD * max(t - BREAK, 0.0)) for t in times]
        (self.folder / "history.csv").write_text(
            "time [s],wall_impulse_x [N s]\n" + "".join(f"{t},{j}\n" for t, j in zip(times, impulse)))
        head = ["time [s]", "mark.x [m]"]
        for i in range(len(RADII)):
            head += [f"section_{i + 1}.{c}" for c in ("y [m]", "stress_xx [Pa]", "stress_yy [Pa]", "stress_zz [Pa]",
                                                      "stress_xy [Pa]", "stress_yz [Pa]", "stress_zx [Pa]", "plastic_strain [1]",
                                                      "failed_fraction [1]")]
        rows = []
        for t in times:
            strain = RATE * t
            row = [t, 10e-3 * math.exp(strain)]
            for i, radius in enumerate(RADII):
                # Under a lateral tension of 1 and an axial one of 3, and shear: mean 5/3, equivalent (4 + 3 (1 + 4 + 9))^0.5.
                failed = 1.0 if i == 0 and t >= BREAK - 0.5e-6 else 0.0
                row += [radius * math.exp(-0.5 * strain), 3e8, 1e8, 1e8, *SHEAR, strain, failed]
            rows.append(",".join(map(str, row)))
        (self.folder / "gauges.csv").write_text(",".join(head) + "\n" + "\n".join(rows) + "\n")

    def measure(self, kind, of="section", place=2e-3):
        return tension.measure(f"{kind}.{of}", self.folder, place)

    def test_force_and_section(self):
        self.assertAlmostEqual(self.measure("peak_stress") / (FORCE / (math.pi * 4e-6)), 1.0, places=9)
        # The break is known to the width of the mean.
        self.assertAlmostEqual(self.measure("neck_strain"), RATE * BREAK, delta=RATE * tension.AVERAGE)
        self.assertAlmostEqual(self.measure("elongation", "section.mark"), math.expm1(RATE * BREAK), delta=2 * RATE * tension.AVERAGE)

    def test_first_failure(self):
        self.assertAlmostEqual(self.measure("failure_strain"), RATE * BREAK, places=9)
        self.assertAlmostEqual(self.measure("failure_triaxiality"), 5 / 3 / math.sqrt(46), places=9)

    def test_names_of_what_is_not_there_are_refused(self):
        for kind, of, words in (("elongation", "section", "elongation.TRACERS.GAUGE"), ("elongation", "section.end", "has no end"),
                                ("neck_strain", "section.mark", "neck_strain.TRACERS"), ("neck_strain", "waist", "has no waist_1")):
            with self.assertRaisesRegex(BadExpectation, words):
                self.measure(kind, of)
        gauges = self.folder / "gauges.csv"
        gauges.write_text(gauges.read_text().replace("section_1.", "section_a."))
        self.assertTrue(math.isfinite(self.measure("neck_strain")))
        gauges.write_text(gauges.read_text().replace("section_", "section_a"))
        with self.assertRaisesRegex(BadExpectation, "gauges.csv has no section_1"):
            self.measure("neck_strain")

    def test_whole_bar_has_no_strain_at_fracture(self):
        text = (self.folder / "history.csv").read_text().splitlines()
        (self.folder / "history.csv").write_text("\n".join(text[:150]) + "\n")
        self.assertTrue(math.isnan(self.measure("neck_strain")))
        (self.folder / "gauges.csv").unlink()
        for kind in ("failure_strain", "failure_triaxiality"):
            self.assertTrue(math.isnan(self.measure(kind)))

    def test_punch(self):
        # The same force and path, of a punch of 3 mm through 2 mm: cut at the break, after exp(0.2) - 1 of 10 mm.
        strength = tension.measure("shear_strength.mark", self.folder, 3e-3, 2e-3)
        self.assertAlmostEqual(strength / (FORCE / (2 * math.pi * 3e-3 * 2e-3)), 1.0, places=9)
        self.assertAlmostEqual(tension.measure("shear_stroke.mark", self.folder, None, 2e-3),
                               5 * math.expm1(RATE * BREAK), delta=10 * RATE * tension.AVERAGE)
        text = (self.folder / "history.csv").read_text().splitlines()
        (self.folder / "history.csv").write_text("\n".join(text[:150]) + "\n")
        self.assertTrue(math.isnan(tension.measure("shear_stroke.mark", self.folder, None, 2e-3)))


if __name__ == "__main__":
    unittest.main()
