# SPDX-License-Identifier: BSD-3-Clause
"""Colours, scales, small copies and widths of the figures; expectations beside a run; differences of inputs."""
import fcntl
import io
import math
import pathlib
import re
import tempfile
import types
import unittest

import numpy as np
import PIL.Image
from matplotlib.colors import to_hex

from report import comparison, curves, expected, gauges, pictures, style
from report.expectations import Case
from report.history import History
from report.run import Run
from report.views import Picture

VIEWER = pathlib.Path(__file__).resolve().parents[2] / "web" / "viewer" / "colours.js"


class Colours(unittest.TestCase):
    @unittest.skipUnless(VIEWER.is_file(), "without the sources of the viewer")
    def test_they_are_those_of_the_viewer(self):
        text = VIEWER.read_text(encoding="utf-8")
        words = re.search(r"WORD_COLOURS = \[([^\]]*)\]", text)[1]
        self.assertEqual(tuple(re.findall(r"#[0-9a-f]{6}", words)), style.WORDS)
        for name, colours in (("viridis", style.colour_map(0, 1, "m/s")), ("inferno", style.colour_map(0, 1, "K")),
                              ("diverging", style.colour_map(-1, 1, "Pa"))):
            stops = re.findall(r"#[0-9a-f]{6}", re.search(rf"{name}: \[([^\]]*)\]", text)[1])
            for i, stop in enumerate(stops):
                found = to_hex(colours(i / (len(stops) - 1)))
                off = max(abs(int(found[k:k + 2], 16) - int(stop[k:k + 2], 16)) for k in (1, 3, 5))
                self.assertLessEqual(off, 2, f"{name} at {i}: {found}, in the viewer {stop}")

    def test_words_begin_anew_after_the_last(self):
        rows = style.word_colours(np.array([0, len(style.WORDS)]))
        self.assertTrue((rows[0] == rows[1]).all())


class Scales(unittest.TestCase):
    def test_signed_fields_are_about_zero(self):
        norm = pictures.scale_of((-1.0, 4.0))
        self.assertEqual((norm.vmin, norm.vmax), (-4.0, 4.0))
        norm = pictures.scale_of((-1.0, 100.0))
        self.assertEqual((norm.vmin, norm.vmax), (0.0, 100.0))
        norm = pictures.scale_of((300.0, 900.0))
        self.assertEqual((norm.vmin, norm.vmax), (300.0, 900.0))
        self.assertGreater(pictures.scale_of((0.0, 0.0)).vmax, 0.0)

    def test_arrows_where_values_lie_beyond(self):
        norm = pictures.scale_of((1.0, 2.0))
        self.assertEqual([pictures.beyond([np.array(v)], norm) for v in ([1.5], [0.5], [2.5], [0.0, 3.0])],
                         ["neither", "min", "max", "both"])

    def test_shading_takes_light_but_no_colour(self):
        picture = Picture(np.array([[0, -1]]), np.array([[0.5, 0.0]]), {})
        colours = np.array([[0.2, 0.4, 0.8]])
        full, mild = (pictures.paint(picture, colours, s)[0, 0].astype(float) for s in (1.0, pictures.SHADING_OF_SCALES))
        self.assertTrue((mild > full).all())
        self.assertAlmostEqual(mild[0] / mild[2], 0.25, places=1)


class Figures(unittest.TestCase):
    def test_letters_are_as_large_in_narrow_figures(self):
        style.apply()
        wide, _ = curves.new_figure(3)
        narrow, _ = curves.new_figure(1)
        self.assertEqual(style.share_of_page(wide), 1.0)
        self.assertAlmostEqual(style.share_of_page(narrow), style.NARROW / style.WIDTH)

    def test_the_page_gets_a_small_copy(self):
        rng = np.random.default_rng(1)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.png"
            smooth = np.cumsum(rng.normal(size=(600, 3000, 3)), axis=1)
            PIL.Image.fromarray((255 * (smooth - smooth.min()) / np.ptp(smooth)).astype(np.uint8)).save(path)
            data = pictures.small_copy(path)
            image = PIL.Image.open(io.BytesIO(data))
            self.assertEqual(image.size, (pictures.RESOLUTION_OF_PAGE, 288))
            self.assertLess(len(data), path.stat().st_size / 3)


EXPECTED = """
title = "made up"
cell_size = { coarse = "1 mm" }
[[run]]
name = "plain"
[[run]]
name = "flat"
set = ["domain.dimension=axisymmetric", "body.0.shape.sphere.radius='2 mm'"]
[[run]]
name = "section"
set = ["domain.dimension=axisymmetric", "domain.axis=z", "body.0.velocity=[0, 0, '2 km/s']", "body.0.material=iron"]
[[quantity]]
name = "depth"
measure = "crater_depth.wall"
value = "14 mm"
tolerance = "10 %"
class = "experiment"
source = "made up"
"""


CASE = """
[domain]
cell_size = "1 mm"
[[body]]
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", "1 km/s"]
shape = { sphere = { center = ["0 mm", "0 mm", "4 mm"], radius = "1 mm" } }
"""


class Radiographs(unittest.TestCase):
    """The scale is that of the cloud: walls, which attenuate much more, were there at the start."""

    def test_the_cloud_has_the_scale(self):
        first, last = (np.ones((40, 60)) for _ in range(2))
        for picture in (first, last):
            picture[:, 20:23] = 0.2  # a wall
        last[10:30, 30:50] = 0.97
        last[19:21, 38:40] = 0.94
        shots = [types.SimpleNamespace(transmission=picture) for picture in (first, last)]
        self.assertAlmostEqual(pictures.darkest_of_cloud(shots), 0.94, delta=0.031)
        # Nothing new: the scale of all that attenuates.
        self.assertAlmostEqual(pictures.darkest_of_cloud([shots[0], shots[0]]), 0.2)
        clear = types.SimpleNamespace(transmission=np.ones((4, 4)))
        self.assertEqual(pictures.darkest_of_cloud([clear]), 0.5)


class Gauges(unittest.TestCase):
    def test_round_off_has_no_height(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "gauges.csv"
            columns = ["time [s]", "rest.pressure [Pa]", *(f"rest.velocity_{axis} [m/s]" for axis in "xyz"),
                       "rest.temperature [K]"]
            rows = [[k * 1e-6, (-1) ** k * 1e-7, 1e-14 * k, 0, 0, 293.0 + 1e-12 * k] for k in range(5)]
            file.write_text(",".join(columns) + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
            figure = gauges.figure(History(file))
            for ax, least in zip(figure.axes, (1e-4, 1e-5, 0.1)):
                low, high = ax.get_ylim()
                self.assertGreaterEqual(high - low, 0.99 * least)

    def test_steady_values_are_within_their_panels(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "gauges.csv"
            columns = ["time [s]", "air.pressure [Pa]", *(f"air.velocity_{axis} [m/s]" for axis in "xyz"), "air.temperature [K]"]
            rows = [[k * 1e-6, 1e5 + 1e-6 * k, 1e3, 0, 0, 293.0] for k in range(5)]
            file.write_text(",".join(columns) + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
            for ax, value, least in zip(gauges.figure(History(file)).axes, (1e-4, 1.0, 293.0), (1e-4, 1e-5, 0.1)):
                low, high = ax.get_ylim()
                self.assertTrue(low < value < high, f"{value} outside {low} to {high}")
                self.assertGreaterEqual(high - low, 0.99 * least)


class Locks(unittest.TestCase):
    def test_a_run_that_is_being_written_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            run = types.SimpleNamespace(folder=folder)
            self.assertFalse(Run.goes_on.fget(run))
            with open(folder / ".lock", "w", encoding="ascii") as lock:
                self.assertFalse(Run.goes_on.fget(run))
                fcntl.flock(lock, fcntl.LOCK_EX)
                self.assertTrue(Run.goes_on.fget(run))
            self.assertFalse(Run.goes_on.fget(run))


class Expectations(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "expected.toml"
        path.write_text(EXPECTED)
        path.with_name("case.toml").write_text(CASE)
        self.case = Case(path)

    def run_with(self, **keys):
        return types.SimpleNamespace(input=keys)

    def test_the_run_of_the_case_is_the_one_with_most_of_its_assignments(self):
        flat = self.run_with(domain={"dimension": "axisymmetric"}, body=[{"shape": {"sphere": {"radius": "0.002 m"}}}])
        self.assertEqual(expected.run_of(self.case, flat).name, "flat")
        other = self.run_with(domain={"dimension": "axisymmetric"}, body=[{"shape": {"sphere": {"radius": "0.003 m"}}}])
        plain = expected.run_of(self.case, other)
        self.assertEqual(plain.name, "plain")
        self.assertEqual(expected.departures(self.case, plain, other)[:2], ["domain.dimension", "body.0.shape.sphere.radius"])

    def test_sections_are_turned_and_materials_copied_in_the_input_of_a_run(self):
        body = {"material": "materials/iron.toml", "velocity": ["2000 m/s", "0 m/s", "0 m/s"],
                "shape": {"sphere": {"center": ["0.004 m", "0 m", "0 m"], "radius": "0.001 m"}}}
        section = self.run_with(domain={"dimension": "axisymmetric", "axis": "x"}, body=[body])
        found = expected.run_of(self.case, section)
        self.assertEqual(found.name, "section")
        self.assertEqual(expected.departures(self.case, found, section), [])
        slower = self.run_with(domain={"dimension": "axisymmetric", "axis": "x"}, body=[body | {"velocity": ["0 m/s", "0 m/s", "2000 m/s"]}])
        self.assertEqual(expected.run_of(self.case, slower).name, "plain")

    def test_what_a_case_leaves_out_is_no_departure(self):
        written = {"moved": {"angle": "3.141592653589793 rad", "center": ["0 m", "0 m", "0 m"], "shape": {"cone": {"height": "0.1 m"}}}}
        wanted = {"moved": {"angle": "180 degree", "shape": {"cone": {"height": "100 mm"}}}}
        self.assertTrue(expected.same(written, wanted))
        wanted["moved"]["shape"]["cone"]["height"] = "101 mm"
        self.assertFalse(expected.same(written, wanted))
        self.assertTrue(expected.same(["0.3 m", "0.0005 m", "0 m"], ["300 mm", "0.5 mm"]))
        self.assertFalse(expected.same(["0.3 m", "0.0005 m", "0.1 m"], ["300 mm", "0.5 mm"]))
        self.assertFalse(expected.same(["0.3 m", "0 m", "0 m"], ["300 mm"]))

    def test_a_body_of_another_material_is_a_departure(self):
        """No run of the case sets the material of this body."""
        path = self.case.path.with_name("case.toml")
        path.write_text(CASE + '[[body]]\nmaterial = "aluminium.toml"\n')
        case = Case(self.case.path)
        impactor = {"material": "materials/copper.toml", "velocity": ["0 m/s", "0 m/s", "1000 m/s"],
                    "shape": {"sphere": {"center": ["0 m", "0 m", "0.004 m"], "radius": "0.001 m"}}}
        for name, departed in (("aluminium", []), ("aluminium_zhakhovsky", ["body.1.material"])):
            run = self.run_with(domain={"dimension": "3d"}, body=[impactor, {"material": f"materials/{name}.toml"}])
            self.assertEqual(expected.departures(case, expected.run_of(case, run), run), departed)

    def test_verdicts(self):
        e = self.case.common[0]
        self.assertEqual([expected.verdict(e, v, band) for v, band in
                          ((0.0145, None), (0.016, None), (0.016, 0.001), (0.016, 0.02), (0.016, 0.0005), (math.nan, 1.0))],
                         ["as expected", "departs", "within the band", "within the band", "departs", "not measured"])
        self.assertEqual(expected.expectation_text(e), "14 mm ± 1.4 mm")
        self.assertIsNone(expected.figure_of([(e, math.nan, None)]))
        self.assertIsNotNone(expected.figure_of([(e, 0.0145, 0.001)]))

    def test_runs_whose_case_has_no_expectations_have_no_section(self):
        self.assertIsNone(expected.case_of(self.run_with(provenance={"case_file": "/nowhere/case.toml"})))
        self.assertIsNone(expected.case_of(self.run_with()))


class Phases(unittest.TestCase):
    def test_a_single_phase_is_a_word_and_no_figure(self):
        def run(melting):
            history = {f"mass_{phase}": np.array(values) for phase, values in
                       (("solid", [1.0, 0.9]), ("melting", [0.0, melting]), ("liquid", [0.0, 0.0]), ("vapour", [0.0, 0.0]))}
            return types.SimpleNamespace(history=history)

        self.assertEqual(curves.only_phase(run(0.0)), "solid")
        self.assertIsNone(curves.phase_figure(run(0.0)))
        self.assertIsNone(curves.only_phase(run(0.1)))


class Differences(unittest.TestCase):
    def test_keys_by_body_and_what_only_one_has(self):
        one = {"title": "a", "domain": {"cell_size": "0.001 m"}, "body": [{"name": "ball", "velocity": ["0 m/s", "1 m/s"]}]}
        other = {"title": "b", "domain": {"cell_size": "0.002 m"}, "body": [{"name": "ball", "velocity": ["0 m/s", "1 m/s"]}],
                 "output": {"gauges_every": 1}}
        self.assertEqual(comparison.differences([one, other]),
                         [["domain.cell_size", "1 mm", "2 mm"], ["output.gauges_every", "–", "1"]])
        self.assertEqual(comparison.differences([one, one]), [])

    def test_spread(self):
        self.assertEqual([comparison.spread(v) for v in ([1.0, 1.1], [0.0, 0.0], [1.0, math.nan])], ["9.5 %", "0 %", "–"])
