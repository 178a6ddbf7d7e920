# SPDX-License-Identifier: BSD-3-Clause
"""Histories, the frame of the impact, and the folder of a run."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

import h5py
import matplotlib.pyplot as plt
import numpy as np

from report import curves, sensitivity
from report.geometry import Geometry
from report.errors import NotARun
from report.history import History
from report.page import Page
from report.run import Run
from report.sections import Report


def geometry(**more):
    return Geometry(axis=2, sign=-1.0, up=0, sight=1, centre=np.zeros(3), impact_speed=5000.0, projectile="ball",
                    **more)


class Histories(unittest.TestCase):
    def history(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text(text)
            return History(path)

    def test_columns_by_name_without_a_row_in_the_making(self):
        history = self.history("step,time [s]\n0,0\n1,1e-6\n2")
        self.assertEqual(history.last("time"), 1e-6)
        self.assertEqual(history.units["time"], "s")
        self.assertIsNone(history.last("mass"))

    def test_what_is_no_number_is_refused(self):
        with self.assertRaisesRegex(NotARun, "history.csv"):
            self.history("step\nzero\n")

    def test_of_many_bodies_the_phases_of_the_largest_are_drawn(self):
        bodies = [f"b{n}" for n in range(6)]
        heads = [f"mass_{phase}.{body} [kg]" for body in bodies for phase in ("solid", "melting", "liquid", "vapour")]
        masses = [f"{n + 1},{n + 1},0,0" for n in range(6)]
        history = self.history("time [s]," + ",".join(heads) + "\n" + "\n".join(f"{t}," + ",".join(masses) for t in (0, 1)) + "\n")
        figure = curves.phase_figure(types.SimpleNamespace(history=history, multiplicity=1))
        self.assertEqual([ax.get_title(loc="left").split(":")[0] for ax in figure.axes], bodies[2:])
        plt.close(figure)

    def test_bodies_of_the_phases_are_those_of_the_columns(self):
        phases = [f"mass_{phase}.{body} [kg]" for body in ("ball", "wall 2")
                  for phase in ("solid", "melting", "liquid", "vapour")]
        history = self.history("time [s]," + ",".join(phases) + "\n0,1,0,0,0,2,0,0,0\n1,1,0,0,0,1,1,0,0\n")
        figure = curves.phase_figure(types.SimpleNamespace(history=history, multiplicity=4))
        self.assertEqual([ax.get_title(loc="left") for ax in figure.axes], ["ball: 4000 g", "wall 2: 8000 g"])


class Columns(unittest.TestCase):
    COLUMNS = ('[{"name": "limited_domains", "unit": "1", "meaning": "times: domain limited", "limiter": "domain limited"},'
               ' {"name": "transfer_heat", "unit": "J", "meaning": "lost", "taken_by": "transfers", "taken_to": "internal energy"}]')

    def run_with(self, folder, columns):
        folder = pathlib.Path(folder)
        (folder / "run.toml").write_text('title = "a run"\n')
        (folder / "history.csv").write_text("time [s],limited_domains [1],transfer_heat [J]\n0,0,0\n1,3,2.5\n")
        if columns is not None:
            (folder / "columns.json").write_text(columns)
        return Run(folder, None)

    def test_name_limiters_and_losses_on_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            report = Report(self.run_with(folder, self.COLUMNS), 50)
            report._summary()
            report._dissipation()
            page = report.page.text()
        for text in ("domain limited", "transfers", "internal energy", "2.5"):
            self.assertIn(text, page)

    def test_of_a_run_without_descriptions_name_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.run_with(folder, None).columns, [])

    def test_that_describe_nothing_are_refused(self):
        for damaged in ("[", '{"name": 1}', '[{"unit": "J"}]', '[{"name": 3}]'):
            with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(NotARun, "columns.json"):
                self.run_with(folder, damaged)


class Snapshots(unittest.TestCase):
    @unittest.skipUnless("WHIPPLE_FAILING_CALLS" in os.environ, "the library of failing calls is not built")
    def test_that_cannot_be_closed_are_an_error_of_the_file(self):
        reads = ("import sys\nfrom report.files import open_hdf5\ntry:\n    with open_hdf5(sys.argv[1]) as file:\n"
                 "        print(file['place'][:])\nexcept OSError as error:\n    sys.exit(str(error))\n")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "snapshot.hdf"
            with h5py.File(path, "w") as file:
                file["place"] = [1.0, 2.0]
            fault = dict(os.environ, LD_PRELOAD=os.environ["WHIPPLE_FAILING_CALLS"], FAULT_CALL="close", FAULT_PATH=folder,
                         FAULT_NUMBER="1", FAULT_ERRNO="5")
            result = subprocess.run([sys.executable, "-c", reads, path], env=fault, capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("Input/output error", result.stderr)


class Frames(unittest.TestCase):
    def test_an_oblique_impact_has_no_direction_of_flight(self):
        self.assertEqual(geometry().labels, ("along the flight, -z (mm)", "across, x (mm)"))
        self.assertEqual(geometry(impact_angle=math.radians(30)).labels, ("-z (mm)", "x (mm)"))


class Sensitivity(unittest.TestCase):
    def page(self, analysis):
        page = Page("t", "s")
        sensitivity.add_to(page, analysis, pathlib.Path("/none"))
        return page.text()

    def test_cells_across_the_projectile_are_those_of_the_analysis(self):
        def measured(size):
            return types.SimpleNamespace(cell_size=0.5e-3, quantity=lambda name: size)

        self.assertIn("This run: 8 cells across the projectile.", self.page(measured(4e-3)))
        self.assertNotIn("This run", self.page(measured(math.nan)))
        self.assertNotIn("This run", self.page(None))


class Runs(unittest.TestCase):
    def test_other_folders_are_refused(self):
        with self.assertRaisesRegex(NotARun, "no such folder"):
            Run("/none")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            with self.assertRaisesRegex(NotARun, "contains no run.toml"):
                Run(folder)
            (path / "run.toml").write_text('title = "made up"\n')
            with self.assertRaisesRegex(NotARun, "neither snapshots nor a history.csv"):
                Run(folder)
            (path / "history.csv").write_text("time [s]\n0\n")
            run = Run(folder)
            self.assertEqual((run.title, run.multiplicity, run.entries), ("made up", 1, []))
            (path / "x.particles.hdf.series").write_text('{"files": [{"name": "x.hdf", "time": 0}]}')
            with self.assertRaisesRegex(NotARun, "analysis.h5.*whipple analyse"):
                Run(folder)
