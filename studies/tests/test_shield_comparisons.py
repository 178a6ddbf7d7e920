# SPDX-License-Identifier: BSD-3-Clause
"""Three dimensions beside sections, dust beside grains, what misses have in common, the curve of a shield."""
import pathlib
import tempfile
import tomllib
import unittest

import numpy as np

from studies.shields import clouds, comparisons, curve, foam_panels, page, pictures, scores, three_dimensions, tile, tile_control

DELAYS = np.linspace(-0.1, 0.3, 401)
LOAD = tile.Load(7.5, 0.1, 5.0, 0.4, DELAYS, np.ones(401), 0.8, 0.05)


def shot(name, failed, run, **more):
    values = {"speed": 6.0, "angle": 0.0, "thickness": 0.25, "alloy": "6061-T6", "runnable": True, "resolved": True, "wall": 0.5, "spacing": 16.0,
              "sphere": "2017-T4"} | more
    return page.Shot(name=name, failed=failed, sizes={"nno_1993": 1.0, "nno_2001": None, "jsc_2011": None}, **values,
                     run=page.Run(model="section", outcome=run, resolved=True, hours=0.5, revision="1.0", reason="because"))


class Choice(unittest.TestCase):
    def test_no_outcome_chooses(self):
        names = [f"a/{k}" for k in range(40)]
        cases = {name: {"resolved": k != 3, "particles": 1e5 if k != 4 else 3e5} for k, name in enumerate(names)}

        def rows(word):
            return [{"shot": name, "model": "section", "outcome": word, "resolved": "yes"} for name in names]

        found = three_dimensions.chosen(rows("bulge"), cases, {"a/5"}, 36)
        self.assertEqual(found, three_dimensions.chosen(rows("perforated")[::-1], cases, {"a/5"}, 36))
        self.assertEqual(len(found), 36)
        self.assertFalse({"a/3", "a/4", "a/5"} & set(three_dimensions.chosen(rows("bulge"), cases, {"a/5"}, 40)))
        self.assertEqual(three_dimensions.chosen(rows("undecided"), cases, set()), [])

    def test_list_is_that_of_the_rule(self):
        rows = page.read_csv(three_dimensions.CHOSEN)
        self.assertEqual(len(rows), three_dimensions.COUNT)
        self.assertEqual([row["shot"] for row in rows], sorted((row["shot"] for row in rows), key=three_dimensions.order))
        self.assertTrue(all(int(row["particles"]) <= three_dimensions.MOST for row in rows))

    def test_tiles_for_dust_are_those_of_tiles(self):
        rows = page.read_csv(page.HERE / "outcomes.csv")
        self.assertNotIn("CR-915/E-44", tile_control.chosen(rows, 100))  # its verdict is of a section
        self.assertEqual(tile_control.chosen(rows, 3), tile_control.chosen(rows[::-1], 100)[:3])


class Panels(unittest.TestCase):
    def test_the_majority_of_seeds_decides(self):
        self.assertIs(comparisons.majority(["perforated", "bulge", "detached spall"]), True)
        self.assertIs(comparisons.majority(["perforated", "bulge", "whole"]), False)
        self.assertIsNone(comparisons.majority(["perforated", "bulge", "undecided"]))
        self.assertIsNone(comparisons.majority(["undecided"]))

    def test_right_ones_are_counted_by_what_stands_for_the_foam(self):
        def row(shot, measured, foam, seed, outcome):
            return {"shot": shot, "measured": measured, "foam": foam, "cell size [mm]": "0.16", "seed": seed, "outcome": outcome, "left": "0.5", "seconds": "9"}

        rows = [row("a", "P", "struts", str(seed), outcome) for seed, outcome in ((1, "perforated"), (2, "bulge"), (3, "perforated"))]
        rows += [row("b", "NP", "struts", "1", "perforated"), row("a", "P", "layer", "", "bulge")]
        lines = comparisons.panel_section(rows)
        self.assertIn("| struts | 0.16 | 2 | 2 | 1 |", lines)
        self.assertIn("| layer | 0.16 | 1 | 0 | 0 |", lines)
        self.assertEqual(comparisons.panel_section([]), [])

    def test_every_shot_and_seed_has_its_own_case(self):
        commands_of = [foam_panels.command_of("whipple", "t", "a/1", *variant) for variant in foam_panels.VARIANTS]
        self.assertEqual(len({tuple(map(str, words)) for words in commands_of}), len(foam_panels.VARIANTS))
        with tempfile.TemporaryDirectory() as folder:
            bare = foam_panels.table_of("none", pathlib.Path(folder)).read_text(encoding="utf-8")
        self.assertNotIn("foam", bare)
        self.assertEqual(bare.count("\n"), 5)


class Dust(unittest.TestCase):
    def test_it_has_the_mass_the_delays_and_the_place_of_the_load(self):
        struck = tile.tile_of(LOAD, 2.0, 2.8, 1)
        edge = 0.5 * struck.cell
        for like_grains in (True, False):
            corners = tile_control.dust_of(LOAD, struck, 2.8, like_grains)
            self.assertAlmostEqual(len(corners) * edge**3 * 2.8 / struck.side**2, LOAD.mass, delta=2.8 * edge**3)
            self.assertEqual(len({tuple(np.round(corner / edge).astype(int)) for corner in corners}), len(corners))
            self.assertLess(corners[:, 0].max(), 0)
            self.assertGreaterEqual(corners[:, 1:].min(), 0)
            self.assertLess(corners[:, 1:].max(), struck.side - 0.9 * edge)
            late = -np.median(corners[:, 0]) / LOAD.speed
            self.assertAlmostEqual(late, LOAD.delay(0.5) - LOAD.delay(0.0), delta=3 * edge / LOAD.speed)
        middle = [np.mean(np.all(np.abs(tile_control.dust_of(LOAD, struck, 2.8, own)[:, 1:] + edge / 2 - struck.side / 2) < struck.side / 4, axis=1))
                  for own in (True, False)]
        self.assertAlmostEqual(middle[1], 0.25, delta=0.03)
        self.assertGreater(middle[0], 0.32)  # grains crowd in the middle

    def test_case_has_boxes_for_spheres(self):
        struck = tile.tile_of(LOAD, 2.0, 2.8, 1)
        text = tile.tile_case(struck, 3.2, "grain.toml", "wall.toml")
        made = tomllib.loads(tile_control.dust_case(text, np.array([[-0.1, 0.0, 0.2]]), 0.05))
        self.assertEqual(made["body"][0]["shape"], {"union": [{"box": {"lower": ["-0.1 mm", "0 mm", "0.2 mm"], "upper": ["-0.05 mm", "0.05 mm", "0.25 mm"]}}]})
        self.assertEqual(made["body"][1], tomllib.loads(text)["body"][1])
        self.assertEqual(made["domain"], tomllib.loads(text)["domain"])
        deep = tomllib.loads(tile_control.dust_case(text, np.array([[-9.02, 0.0, 0.2]]), 0.05))["domain"]["lower"]
        self.assertEqual(deep, ["-9.5 mm", "0 mm", "0 mm"])  # room of four cells
        with self.assertRaises(ValueError):
            tile_control.dust_case("title = 'no grains'\n", np.zeros((1, 3)), 0.05)


class Parts(unittest.TestCase):
    def test_exact_test_of_fisher(self):
        self.assertAlmostEqual(scores.fisher(3, 1, 1, 3), 34 / 70)  # the lady tasting tea, two-sided
        self.assertAlmostEqual(scores.fisher(1, 9, 11, 3), 0.0027594561852200836)
        self.assertEqual(scores.fisher(2, 2, 2, 2), 1.0)

    def test_separation_is_a_probability(self):
        self.assertEqual(scores.separation([1, 2, 3, 4], [False, False, True, True]), 1.0)
        self.assertEqual(scores.separation([1, 2, 2, 4], [False, True, False, True]), 0.875)

    def test_common_is_counted_at_the_medians(self):
        shots = [shot(f"a{k}", True, "perforated" if k < 4 else "bulge", spacing=10.0 + k) for k in range(8)]
        text = "\n".join(comparisons.common_section(shots))
        self.assertIn("| found or unsafe | spacing over sphere above 13.5 | 0, 4 | 4, 0 | 0.029 |", text)
        self.assertNotIn("held or called failed", text)
        self.assertIn("| spacing over sphere | 1.00 | nan |", text)

    def test_space_beside_sections(self):
        def row(name, model, outcome, **more):
            return {"shot": name, "model": model, "outcome": outcome, "left": "0.5", "left on the axis": "0.6", "hole [mm]": "", "particles": "10",
                    "steps": "5", "seconds": "3.6"} | more

        rows = [row("A", "space", "perforated", left="", seconds="36", **{"hole [mm]": "6"}), row("A", "section", "detached spall", **{"hole [mm]": "4"}),
                row("B", "space", "bulge", seconds="72"), row("B", "section", "perforated", left="0.25"), row("C", "space", "bulge")]
        text = "\n".join(comparisons.space_section(rows, {"A": "bulge", "B": "undecided"}, {"A": True, "B": False, "C": True}))
        self.assertIn("| section, same cells | 2 | 50.0 % (9.5 to 90.5) | 0 | 2 | 1 | 1 |", text)
        self.assertIn("| section of the rule | 1 | 0.0 % (0.0 to 79.3) | 0 | 1 | 0 | 1 |", text)
        self.assertIn("left 2.00 (2.00 to 2.00, 1 shots), of walls that keep a tenth in both; hole 1.50 (1.50 to 1.50, 1 shots)", text)
        self.assertIn("15 times as much per shot", text)
        self.assertIn("in those of the rule: 1 of 1 verdicts differ", text)
        self.assertEqual(comparisons.space_section([], {}, {}), [])

    def test_dust_beside_grains(self):
        rows = [{"shot": "A", "load": load, "number": "3", "cell size [mm]": "0.1", "outcome": "bulge", "speed [m/s]": speed, "over spread": "1.5",
                 "rim over thickness": "0.9"} for load, speed in (("grains", "200"), ("dust", "150"))]
        self.assertIn("dust: 0.75 (0.75 to 0.75, 1 shots)", "\n".join(comparisons.control_section(rows)))
        self.assertEqual(comparisons.control_section([]), [])

    def test_clouds_have_bands(self):
        def row(cell, shift, front, diameter="9.53", **more):
            names = ("rear", "radial", "length over width", "sphere intact", "debris melted", "sphere melted", "size at 50 %", "size at 84 %", "size at 97.5 %")
            return {"diameter [mm]": diameter, "bumper [mm]": "0.8", "velocity [km/s]": "6.7", "cell size [mm]": cell, "shift": shift, "front": front} | dict.fromkeys(
                names, "0.1") | more

        rows = [row("0.4", "0", "0.95"), row("0.2", "0.5", "0.99"), row("0.2", "0", "0.97"), row("0.2", "0", "0.9", "3.175", **{"debris melted": "0.25"})]
        text = "\n".join(comparisons.cloud_section(rows))
        self.assertIn("| 0.084 | 0.2, 0.4 | 0.97 ± 0.02 |", text)
        self.assertIn("| 6.7 | 0.25 | 0.1 | 0.1 |", text)
        self.assertEqual(comparisons.cloud_section([]), [])

    def test_misses_are_failed_walls_that_hold(self):
        rows = [{"shot": name, "model": model, "outcome": outcome} for name, model, outcome in
                (("a", "section", "bulge"), ("b", "section", "perforated"), ("c", "section", "whole"), ("d", "section", "bulge"), ("a", "tile", "bulge"))]
        shots = {name: {"result": "NP" if name == "c" else "P"} for name in "abcd"}
        self.assertEqual(pictures.misses(rows, shots, {"d"}), rows[:1])
        self.assertEqual(pictures.misses(rows, shots, {"d"}, "tile"), rows[-1:])

    def test_a_half_is_drawn_behind_its_mirror_plane(self):
        particles = {"position": np.array([[1e-3, 0.1e-3, 5e-3], [2e-3, 0.6e-3, 5e-3], [3e-3, 0.4e-3, 7e-3]])}
        across, depth, drawn = pictures.seen(particles, "space", 0.5, 6.0)
        self.assertEqual([across.tolist(), depth.round(9).tolist(), drawn.tolist()], [[1.0, 3.0], [1.0, -1.0], [True, False, True]])
        across, depth, drawn = pictures.seen(particles, "section", 0.5, 6.0)
        self.assertEqual([across.round(9).tolist(), depth.round(9).tolist()], [[0.1, 0.6, 0.4], [5.0, 4.0, 3.0]])


class Curve(unittest.TestCase):
    def test_share_is_reached_between_two_speeds(self):
        self.assertAlmostEqual(curve.reached([(5.0, 0.0), (6.0, 0.2), (7.0, 0.6)], 0.1), 5.5)
        self.assertIsNone(curve.reached([(5.0, 0.0), (6.0, 0.05)], 0.1))

    def test_interval_contains_those_of_all_studies(self):
        one, other = [(3.0, 3.0, 4.0, "found"), (6.0, 3.0, 4.0, "found")], [(3.0, 2.5, 3.5, "found"), (6.0, None, None, "undecided")]
        self.assertEqual(curve.hull([one]), one)
        self.assertEqual(curve.hull([one, other]), [(3.0, 2.5, 4.0, "found"), (6.0, None, None, "found; undecided")])

    def test_shots_on_the_shield_of_ryan(self):
        found = curve.shots_on(page.HERE / "ryan" / "shield.toml")
        self.assertIn((6.0, 4.064, False, None), found)  # calibrating: no section of its own
        self.assertTrue(any(speed == 6.6 and failed and outcome == "bulge" for speed, _, failed, outcome in found))
        self.assertEqual(curve.length("2 cm"), 20.0)

    def test_clouds_have_a_grid_that_is_moved(self):
        with tempfile.TemporaryDirectory() as folder:
            cases = [tomllib.loads(clouds.case_of(9.53, 0.8, 6.7, 0.4, shift, pathlib.Path(folder)))["domain"] for shift in (0.0, 0.5)]
        lower = [float(case["lower"][0].split()[0]) for case in cases]
        self.assertAlmostEqual(lower[0] - lower[1], 0.2)
        self.assertEqual(len(clouds.plans("piekutowski")), 30)


if __name__ == "__main__":
    unittest.main()
