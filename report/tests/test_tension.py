# SPDX-License-Identifier: BSD-3-Clause
"""Measures of a bar that is pulled apart, of tables made for it: the section shrinks at a known rate, and the force ends."""
import math
import pathlib
import tempfile
import unittest

from report import tension

RATE, BREAK, END = 1000.0, 200e-6, 260e-6  # 1/s; s
RADII = (0.0, 1e-3, 2e-3)
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
                                                      "stress_xy [Pa]", "plastic_strain [1]", "failed_fraction [1]")]
        rows = []
        for t in times:
            strain = RATE * t
            row = [t, 10e-3 * math.exp(strain)]
            for i, radius in enumerate(RADII):
                # Under a lateral tension of 1 and an axial one of 3: mean 5/3, equivalent 2.
                failed = 1.0 if i == 0 and t >= BREAK - 0.5e-6 else 0.0
                row += [radius * math.exp(-0.5 * strain), 3e8, 1e8, 1e8, 0.0, strain, failed]
            rows.append(",".join(map(str, row)))
        (self.folder / "gauges.csv").write_text(",".join(head) + "\n" + "\n".join(rows) + "\n")

    def measure(self, kind, of="section", place=2e-3):
        return tension.measure(kind, self.folder, of, place)

    def test_force_and_section(self):
        self.assertAlmostEqual(self.measure("peak_stress") / (FORCE / (math.pi * 4e-6)), 1.0, places=9)
        # The break is known to the width of the mean.
        self.assertAlmostEqual(self.measure("neck_strain"), RATE * BREAK, delta=RATE * tension.AVERAGE)
        self.assertAlmostEqual(self.measure("elongation", "section.mark"), math.expm1(RATE * BREAK), delta=2 * RATE * tension.AVERAGE)

    def test_first_failure(self):
        self.assertAlmostEqual(self.measure("failure_strain"), RATE * BREAK, places=9)
        self.assertAlmostEqual(self.measure("failure_triaxiality"), 5 / 6, places=9)

    def test_whole_bar_has_no_strain_at_fracture(self):
        text = (self.folder / "history.csv").read_text().splitlines()
        (self.folder / "history.csv").write_text("\n".join(text[:150]) + "\n")
        self.assertTrue(math.isnan(self.measure("neck_strain")))
        (self.folder / "gauges.csv").unlink()
        for kind in ("failure_strain", "failure_triaxiality"):
            self.assertTrue(math.isnan(self.measure(kind)))

    def test_punch(self):
        # The same force and path, of a punch of 3 mm through 2 mm: cut at the break, after exp(0.2) - 1 of 10 mm.
        strength = tension.measure("shear_strength", self.folder, "mark", 3e-3, 2e-3)
        self.assertAlmostEqual(strength / (FORCE / (2 * math.pi * 3e-3 * 2e-3)), 1.0, places=9)
        self.assertAlmostEqual(tension.measure("shear_stroke", self.folder, "mark", None, 2e-3),
                               5 * math.expm1(RATE * BREAK), delta=10 * RATE * tension.AVERAGE)
        text = (self.folder / "history.csv").read_text().splitlines()
        (self.folder / "history.csv").write_text("\n".join(text[:150]) + "\n")
        self.assertTrue(math.isnan(tension.measure("shear_stroke", self.folder, "mark", None, 2e-3)))


if __name__ == "__main__":
    unittest.main()
