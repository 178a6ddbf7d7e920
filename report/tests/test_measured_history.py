# SPDX-License-Identifier: BSD-3-Clause
"""Tests of measured histories beside gauges: the figure, what a table must be."""
import pathlib
import tempfile
import types
import unittest

import numpy as np

from report import measured_history
from report.expectations import BadExpectation


def ramp(times, begin, height):
    """A rise of 0.2 us to a plateau."""
    return height * np.clip((times - begin) / 0.2e-6, 0.0, 1.0)


class MeasuredHistoryTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.measured_times = np.linspace(1e-6, 2e-6, 101)
        self.measured = ramp(self.measured_times, 1.1e-6, 300.0)
        self.times = np.linspace(0.0, 4e-6, 801)

    def table(self, text):
        path = self.folder / "measured.csv"
        path.write_text(text)
        return path

    def test_figure_of_a_gauge(self):
        (self.folder / "gauges.csv").write_text("time [s],rear.velocity_z [m/s]\n" + "".join(
            f"{t},{v}\n" for t, v in zip(self.times, ramp(self.times, 0.3e-6, 300.0))))
        table = self.table("# a record\ntime [us],velocity [km/s]\n" + "".join(
            f"{1e6 * t},{1e-3 * v}\n" for t, v in zip(self.measured_times, self.measured)))
        wanted = types.SimpleNamespace(measure="history_error.rear.velocity_z", table=table)
        figure = measured_history.figure(self.folder / "gauges.csv", [wanted], lambda _: 0.8e-6)
        run = figure.axes[0].lines[1]
        self.assertAlmostEqual(np.interp(1.2, run.get_xdata(), run.get_ydata()), 0.15, places=3)
        self.assertIsNone(measured_history.figure(self.folder / "gauges.csv", [], lambda _: 0.0))

    def test_tables_that_are_none_are_named(self):
        for text in ("", "time [us],velocity\n0,1\n1,2\n2,3\n", "time [us],velocity [m/s]\n0,1\n1,a\n2,3\n",
                     "time [us],velocity [m/s]\n0,1\n2,2\n1,3\n", "time [us],velocity [m/s]\n0,1\n1,2\n",
                     "time [us],velocity [m/s]\n0,1\n1,2,3\n2,3\n"):
            with self.assertRaisesRegex(BadExpectation, "measured.csv"):
                measured_history.read(self.table(text))


if __name__ == "__main__":
    unittest.main()
