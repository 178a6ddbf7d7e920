# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the gallery: sections of shapes by their areas, places of quantities in a chart."""
import gzip
import pathlib
import tempfile
import unittest
from math import pi, radians, tan
from unittest import mock

from studies.validation import arrangement, gallery

DOMAIN = '[domain]\nlower = ["-10 mm", "-10 mm", "-10 mm"]\nupper = ["10 mm", "10 mm", "10 mm"]\n'


def section(*shapes, domain=DOMAIN):
    return section_of(domain + "".join(f'[[body]]\nname = "b{i or ""}"\nshape = {shape}\n' for i, shape in enumerate(shapes)))


def section_of(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "case.toml"
        path.write_text(text, encoding="utf-8")
        return arrangement.section(path)


def area(*shapes, domain=DOMAIN):
    """Area in mm^2 that the bodies fill of the section."""
    found = section(*shapes, domain=domain)
    cell = found.width * found.height * 1e6 / (found.cells[0] * found.cells[1])
    return sum(width * height for _, _, _, width, height in found.rectangles) * cell


class Sections(unittest.TestCase):
    def test_areas(self):
        cylinder = 'cylinder = { center = ["0 mm", "0 mm", "0 mm"], axis = "z", radius = "3 mm", height = "8 mm" }'
        cone = 'cone = { base = ["0 mm", "0 mm", "-5 mm"], axis = "z", base_radius = "4 mm", height = "10 mm" }'
        for shape, expected in (
                ('{ sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "5 mm" } }', 25 * pi),
                (f"{{ {cylinder} }}", 48), (f"{{ {cone} }}", 40),
                ('{ tube = { base = ["0 mm", "0 mm", "0 mm"], axis = "z", height = "6 mm", inner_radius = "2 mm", outer_radius = "5 mm" } }', 36),
                (f'{{ moved = {{ axis = [0, 1, 0], angle = "30 degree", translation = ["1 mm", "0 mm", "2 mm"], shape = {{ {cylinder} }} }} }}', 48),
                ('{ ogive = { base = ["0 mm", "0 mm", "-8 mm"], axis = "z", radius = "4 mm", shank_length = "4 mm", nose_length = "8 mm" } }',
                 32 + 2 * (100 * 0.5 * 0.9272952180 - 0.5 * 6 * 8))):
            with self.subTest(shape=shape[:12]):
                self.assertAlmostEqual(area(shape), expected, delta=0.6)

    def test_label_image(self):
        labels = bytes(1 + i // 2 for i in range(4)) * 16  # 1 1 2 2 along x, voxels of 2 mm
        head = ("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nspace directions: (2,0,0) (0,2,0) (0,0,2)\n"
                "space origin: (-3,-3,-3)\nencoding: ")
        for encoding, data in (("raw", labels), ("gzip", gzip.compress(labels))):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "labels.nrrd"
                path.write_bytes(f"{head}{encoding}\n\n".encode() + data)
                for values, expected in ("[2]", 32), ("[1, 2]", 64):
                    shape = f'{{ image = {{ file = "{path}", unit = "1 mm", values = {values} }} }}'
                    self.assertAlmostEqual(area(shape), expected, delta=0.6)

    def test_keys_that_may_be_left_out(self):
        for shape, expected in (
                ('{ cylinder = { center = ["0 m", "0 m", "0 m"], radius = "3 mm", height = "8 mm" } }', 48),
                ('{ cone = { base = ["0 m", "0 m", "-5 mm"], base_radius = "4 mm", height = "10 mm" } }', 40),
                ('{ ogive = { base = ["0 m", "0 m", "-4 mm"], radius = "4 mm", nose_length = "8 mm" } }', 2 * (100 * 0.5 * 0.9272952180 - 0.5 * 6 * 8)),
                ('{ prism = { base = ["0 m", "0 m", "-4 mm"], sides = 4, inner_radius = "3 mm", height = "8 mm" } }', 48),
                ('{ moved = { shape = { cylinder = { center = ["0 m", "0 m", "0 m"], radius = "3 mm", height = "8 mm" } } } }', 48)):
            with self.subTest(shape=shape[:12]):
                self.assertAlmostEqual(area(shape), expected, delta=0.6)

    def test_what_is_cut_out(self):
        plate = '{ box = { lower = ["-9 mm", "-9 mm", "-1 mm"], upper = ["9 mm", "9 mm", "1 mm"] } }'
        hole = '{ cylinder = { center = ["0 mm", "0 mm", "0 mm"], axis = "z", radius = "2 mm", height = "9 mm" } }'
        self.assertAlmostEqual(area(f"{{ difference = {{ from = {plate}, minus = [{hole}] }} }}"), 28, delta=0.3)
        self.assertAlmostEqual(area(f"{{ union = [{plate}, {hole}] }}"), 36 + 28, delta=0.5)

    def test_slope(self):
        half = '{ difference = { from = { box = { lower = ["0 mm", "0 mm"], upper = ["10 mm", "10 mm"] } }, ' \
            'minus = [{ half_space = { point = ["10 mm", "0 mm", "0 mm"], normal = [-1.0, -1.0, 0.0] } }] } }'
        domain = '[domain]\ndimension = "plane_strain"\nlower = ["0 mm", "0 mm"]\nupper = ["10 mm", "10 mm"]\n'
        self.assertAlmostEqual(area(half, domain=domain), 100 * tan(radians(45)) / 2, delta=0.5)

    def test_the_first_body_is_on_top_and_names_stay_in_order(self):
        box = '{{ box = {{ lower = ["{0} mm", "-9 mm", "-9 mm"], upper = ["{1} mm", "9 mm", "9 mm"] }} }}'
        found = section(box.format(-5, 5), box.format(0, 9))
        self.assertEqual([(body, width) for body, _, _, width, _ in found.rectangles], [(0, 120), (1, 48)])

    def test_prisms_and_turned_polygons(self):
        corners = '["-4 mm", "4 mm", "4 mm", "0 mm", "-4 mm"]', '["-3 mm", "-3 mm", "3 mm", "0 mm", "3 mm"]'
        for shape, expected in (
                # Six sides: the section at y = 0 goes through two faces, of z those along x.
                ('{ prism = { base = ["0 mm", "0 mm", "-4 mm"], axis = "z", sides = 6, inner_radius = "3 mm", height = "8 mm" } }', 48),
                # The plane at y = 0 is that of the hexagon here: area 2 sqrt(3) r^2.
                ('{ prism = { base = ["0 mm", "-1 mm", "0 mm"], axis = "y", sides = 6, inner_radius = "3 mm", height = "2 mm" } }', 18 * 3**0.5),
                # A notch of 8 mm x 3 mm / 2 in 8 mm x 6 mm, in the plane of z and x.
                (f'{{ extrude = {{ base = ["0 mm", "-1 mm", "0 mm"], axis = "y", first = {corners[0]}, second = {corners[1]}, height = "2 mm" }} }}', 36),
                # A cone of 6 mm radius and 6 mm height, turned about z.
                ('{ revolve = { base = ["0 mm", "0 mm", "-3 mm"], axis = "z", along = ["0 mm", "0 mm", "6 mm"], radius = ["0 mm", "6 mm", "0 mm"] } }', 36)):
            with self.subTest(shape=shape[:12]):
                self.assertAlmostEqual(area(shape), expected, delta=0.6)

    def test_shapes_of_shapes(self):
        cube = '{ box = { lower = ["-1 mm", "-1 mm", "-1 mm"], upper = ["1 mm", "1 mm", "1 mm"] } }'
        ball = '{ sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "2 mm" } }'
        slab = '{ box = { lower = ["0 mm", "-9 mm", "-9 mm"], upper = ["9 mm", "9 mm", "9 mm"] } }'
        for shape, expected in (
                (f"{{ intersection = [{ball}, {slab}] }}", 2 * pi),
                (f'{{ scaled = {{ shape = {ball}, factors = [3, 1, 2] }} }}', 24 * pi),
                (f'{{ array = {{ shape = {cube}, count = 4, step = ["3 mm", "0 mm", "0 mm"] }} }}', 16),
                (f'{{ moved = {{ shape = {slab}, angle = "90 degree", axis = [0, 1, 0], center = ["7 mm", "0 mm", "7 mm"] }} }}', 90),
                (f'{{ moved = {{ shape = {cube}, translation = ["0.1 inch", "0 mm", "0 mm"] }} }}', 4)):
            with self.subTest(shape=shape[:12]):
                self.assertAlmostEqual(area(shape), expected, delta=0.6)

    def test_what_is_not_drawn_is_named(self):
        ball = '{ sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "5 mm" } }'
        for shape, kind in (("{ torus = { } }", "torus"), (f"{{ difference = {{ from = {ball}, minus = [{{ torus = 1 }}] }} }}", "torus"),
                            ('{ sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "5 furlong" } }', 'the quantity "5 furlong"'),
                            ('{ array = { count = 1001, step = ["1 um", "0 m", "0 m"] } }', "array of 1001"),
                            ("{ sphere = { middle = 3 } }", "sphere with other keys ('center')")):
            with self.subTest(shape=shape[:20]):
                found = section(shape)
                self.assertEqual((found.left_out, found.rectangles), ([f"b ({kind})"], []))
        text = DOMAIN + f'[[body]]\nname = "rods"\n[[body.bar]]\n[[body]]\nname = "shell"\n[body.discretization]\nmesh = "shell.msh"\n' \
            f'[[body]]\nname = "ball"\nshape = {ball}\n[[load]]\nname = "push"\n'
        found = section_of(text)
        self.assertEqual((found.bodies, found.left_out), (["ball"], ["rods (bars)", "shell (mesh of a file)", "loads"]))
        self.assertEqual({body for body, *_ in found.rectangles}, {0})

    def test_the_page_names_what_is_not_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, units in (("rings", "mm"), ("yards", "yd")):
                (root / "cases" / name).mkdir(parents=True)
                (root / "cases" / name / "README.md").write_text(f"# Case of {name}\n", encoding="utf-8")
                (root / "cases" / name / "case.toml").write_text(
                    DOMAIN.replace("mm", units) + '[[body]]\nname = "ring"\nshape = { torus = { } }\n', encoding="utf-8")
            with mock.patch.object(gallery, "ROOT", root):
                found = gallery.pages({"cases": {}})
        self.assertIn("![bodies at the start](gallery/rings.svg)\n\nNot drawn: ring (torus).\n", found[gallery.PAGE])
        self.assertIn('## Case of yards\n\nNot drawn: the bodies (the quantity "-10 yd").\n', found[gallery.PAGE])
        self.assertEqual([path.name for path in found if path != gallery.PAGE], ["rings.svg"])

    def test_every_case_is_drawn(self):
        for path in sorted((gallery.ROOT / "cases").glob("*/case.toml")):
            with self.subTest(case=path.parent.name):
                self.assertTrue(arrangement.section(path).rectangles)


class Charts(unittest.TestCase):
    def test_places(self):
        quantity = {"kind": "within", "value": 12.0, "expected": 10.0, "tolerance": 4.0, "u_num": 1.0}
        self.assertEqual(gallery.place(quantity), (0.5, 0.25))
        self.assertEqual(gallery.place(quantity | {"kind": "at_most", "tolerance": 0.0}), (0.2, 0.1))
        self.assertIsNone(gallery.place(quantity | {"kind": "at_most", "expected": 0.0}))


if __name__ == "__main__":
    unittest.main()
