# SPDX-License-Identifier: BSD-3-Clause
"""The section of explosives, of a run made for it: a tube that expands about z and flies along x, and what breaks of it."""
import json
import pathlib
import tempfile
import types
import unittest

import h5py
import numpy as np
from matplotlib import pyplot as plt

from report import explosives
from report.geometry import Geometry
from report.history import History
from report.page import Page

LINE = {"shape": "line", "position": ["0.01 m", "0 m", "0 m"], "end": ["0.01 m", "0 m", "0.002 m"]}


class Section(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(plt.close, "all")
        self.folder = pathlib.Path(temporary.name)
        bodies = [{"name": "charge", "material": "materials/tnt.toml"}, {"name": "tube", "material": "materials/iron.toml"}]
        (self.folder / "materials").mkdir()
        (self.folder / "materials/tnt.toml").write_text('[eos]\nmodel = "jwl"\ndetonation_energy = "7 GJ/m^3"\n')
        (self.folder / "materials/iron.toml").write_text('[eos]\nmodel = "mie_gruneisen"\n')
        (self.folder / "run.toml").write_text('[domain]\ncell_size = "0.001 m"\n' + "".join(
            f'[[body]]\nname = "{body["name"]}"\n' for body in bodies))
        (self.folder / "gauges.csv").write_text("time [s]," + ",".join(f"{name}.{what}" for name in ("near", "never") for what in
            ("x [m]", "y [m]", "z [m]", "velocity_x [m/s]", "velocity_y [m/s]", "velocity_z [m/s]", "pressure [Pa]", "temperature [K]"))
            + "".join(f"\n{time}," + f"0.02,0,0,0,0,0,{pressure},300," + "0.03,0,0,0,0,0,nan,nan"
                      for time, pressure in ((0, 0), (1e-6, 4e9), (2e-6, 2e10), (3e-6, 1e9))))
        # 99 particles around (10, 0) mm, every tenth of them failed.
        angle = 2 * np.pi * np.arange(99) / 99
        files = []
        for step, radius in enumerate((0.010, 0.012, 0.016)):
            files.append({"name": f"{step}.hdf", "time": step * 1e-6})
            with h5py.File(self.folder / f"{step}.hdf", "w") as file:
                data = file.create_group("VTKHDF")
                data["Points"] = np.stack([0.01 + radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
                data["PointData/body"] = np.ones(99, dtype=int)
                data["PointData/mass"] = np.full(99, 1e-6)
                data["PointData/failed"] = np.arange(99) % 10 == 0
                data["PointData/velocity"] = np.stack([10.0 * np.arange(99), 0 * angle, 0 * angle], axis=1)
        (self.folder / "made.particles.hdf.series").write_text(json.dumps({"files": files}))
        geometry = Geometry(0, 1.0, 1, 2, np.zeros(3), 0.0, "charge")
        self.run = types.SimpleNamespace(folder=self.folder, input={"body": bodies, "detonation": [LINE]},
                                         entries=[(self.folder / f["name"], f["time"]) for f in files],
                                         analysis=types.SimpleNamespace(
                                             geometry=geometry, body_names=["charge", "tube"], quantity=lambda name: 0.01,
                                             bodies=[("tube", "whole", {"failed_fraction": 0.1})],
                                             tables={"fragments": {"body": np.ones(5), "mass": 1e-6 * np.arange(8, 13),
                                                                   "copies": np.full(5, 2.0)}}))

    def test_explosives_are_told_by_their_material(self):
        self.assertEqual(explosives.driven_bodies(self.run), ["tube"])

    def test_arrival_is_half_way_to_the_peak(self):
        (name, place, time, most), = explosives.arrivals(History(self.folder / "gauges.csv"))
        self.assertEqual((name, place[0], time, most), ("near", 0.02, 2e-6, 2e10))

    def test_mass_by_velocity(self):
        curve, = explosives.mass_figure(self.run, ["tube"]).axes[0].lines
        speed, mass = curve.get_data()
        self.assertAlmostEqual(mass[np.flatnonzero(np.isclose(speed, 0.49))[0]], 100 * 50 / 99)

    def test_expansion_is_about_the_line_of_detonators(self):
        left, right = explosives.expansion_figure(self.run, ["tube"]).axes
        np.testing.assert_allclose(left.lines[0].get_ydata(), [10, 12, 16])
        np.testing.assert_allclose(right.lines[0].get_ydata(), [2, 4])
        self.run.input["detonation"] = [{"shape": "point", "position": ["0 m", "0 m", "0 m"]}]
        self.assertEqual(explosives.axis_of_charge(self.run)[0], 0)  # that of the pictures

    def test_fragments_are_those_of_the_analysis(self):
        steps, fit = explosives.piece_figure(self.run, ["tube"]).axes[0].lines
        self.assertIn("tube: 10 fragments", steps.get_label())
        self.assertIn("10 % of the mass has failed, 1 % is in no fragment", steps.get_label())
        self.assertEqual(fit.get_ydata()[0], 10)
        self.run.analysis.geometry.dimension = "axisymmetric"
        self.assertIsNone(explosives.piece_figure(self.run, ["tube"]))

    def test_the_section_is_that_of_runs_with_detonators(self):
        page, added = Page("t", "s"), []
        explosives.add_to(page, self.run, lambda name, caption, figure: added.append(name))
        self.assertEqual(added, ["mass_by_velocity.png", "expansion.png", "pieces.png"])
        self.assertIn("<td>20</td>", page.text())
        self.run.input["detonation"] = []
        other = Page("t", "s")
        explosives.add_to(other, self.run, None)
        self.assertNotIn("Explosive", other.text())


if __name__ == "__main__":
    unittest.main()
