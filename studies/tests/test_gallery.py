# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the gallery: sections of shapes by their areas, places of quantities in a chart."""
import pathlib
import tempfile
import unittest
from math import pi, radians, tan

from studies.validation import arrangement, gallery

DOMAIN = '[domain]\nlower = ["-10 mm", "-10 mm", "-10 mm"]\nupper = ["10 mm", "10 mm", "10 mm"]\n'


def section(*shapes, domain=DOMAIN):
    text = domain + "".join(f'[[body]]\nname = "b"\nshape = {shape}\n' for shape in shapes)
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

    def test_unknown_shape(self):
        with self.assertRaises(arrangement.Unknown):
            section("{ torus = { } }")


class Charts(unittest.TestCase):
    def test_places(self):
        quantity = {"kind": "within", "value": 12.0, "expected": 10.0, "tolerance": 4.0, "u_num": 1.0}
        self.assertEqual(gallery.place(quantity), (0.5, 0.25))
        self.assertEqual(gallery.place(quantity | {"kind": "at_most", "tolerance": 0.0}), (0.2, 0.1))
        self.assertIsNone(gallery.place(quantity | {"kind": "at_most", "expected": 0.0}))


if __name__ == "__main__":
    unittest.main()
