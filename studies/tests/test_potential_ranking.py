# SPDX-License-Identifier: BSD-3-Clause
"""The rule of the ranking on synthetic potentials, and that its plans and measurements are there."""
import math
import tomllib
import unittest

from studies.potential_ranking import measured, melting, potential_ranking, rule


def candidate(name, points=0.01, fit=0.01, isotherm=0.02, density=0.01, melting=None, **others):
    return rule.Candidate(name, {"points": points, "fit": fit, "isotherm": isotherm, "density": density, "melting": melting}, **others)


class Rule(unittest.TestCase):
    def order(self, *candidates):
        return [one.name for one, _ in rule.rank(candidates)[0]]

    def test_a_potential_at_all_its_bounds_has_the_score_one(self):
        self.assertAlmostEqual(rule.score(dict(rule.BOUNDS), True), 1.0)

    def test_points_and_fit_of_the_shocks_count_once_together(self):
        alone = {"points": 0.04, "fit": 0.0, "isotherm": None, "density": 0.0, "melting": None}
        self.assertAlmostEqual(rule.score(alone, False), math.sqrt(0.5 * 4.0 / 2.0))

    def test_order_by_score(self):
        self.assertEqual(self.order(candidate("c", points=0.04), candidate("a", points=0.001), candidate("b", isotherm=0.10)), ["a", "c", "b"])

    def test_a_good_curve_does_not_outweigh_a_bad_fit(self):
        self.assertEqual(self.order(candidate("points only", points=0.0, fit=0.09), candidate("both", points=0.02, fit=0.02)),
                         ["both", "points only"])

    def test_equal_scores_by_validity_and_then_by_speed(self):
        self.assertEqual(self.order(candidate("slow", validity=80.0, speed=1e4), candidate("short", validity=40.0, speed=1e7),
                                    candidate("fast", points=0.0101, validity=80.0, speed=1e6)), ["fast", "slow", "short"])

    def test_melting_counts_only_if_all_were_asked(self):
        good, bad = candidate("good", melting=0.0), candidate("bad", points=0.001, fit=0.001, melting=0.5)
        self.assertEqual(self.order(good, bad), ["good", "bad"])
        self.assertEqual(self.order(good, bad, candidate("not asked", points=0.03))[0], "bad")

    def test_the_disqualified_do_not_decide_whether_melting_counts(self):
        self.assertEqual(self.order(candidate("good", melting=0.0), candidate("bad", points=0.001, fit=0.001, melting=0.5),
                                    candidate("out", density=0.05)), ["good", "bad"])

    def test_what_disqualifies(self):
        out = dict((one.name, reason) for one, reason in rule.rank([
            candidate("crystal", structure_right=False), candidate("volume", density=-0.031), candidate("shocks", points=0.11),
            candidate("fit", fit=None, fault_of_fit="no points"), candidate("kept", density=-0.029, points=0.09)])[1])
        self.assertEqual(set(out), {"crystal", "volume", "shocks", "fit"})
        self.assertEqual(out["volume"], "V0 more than 3 % off")


class Curves(unittest.TestCase):
    def test_points_are_joined_and_the_first_line_goes_on(self):
        curve = rule.Curve([2.0, 1.0, 4.0], [20.0, 10.0, 60.0])
        self.assertAlmostEqual(curve(0.5), 5.0)
        self.assertAlmostEqual(curve(3.0), 40.0)
        self.assertAlmostEqual(curve(4.0), 60.0)
        self.assertIsNone(curve(4.1))

    def test_a_missing_place_counts_five_bounds(self):
        curve = rule.Curve([0.0, 1.0], [1.0, 1.0])
        self.assertAlmostEqual(rule.root_mean_square(curve, lambda x: 1.0, [0.5, 1.5], 0.02), math.sqrt(0.1**2 / 2.0))

    def test_validity_ends_at_the_first_place_out_of_bounds(self):
        places = [1.0, 2.0, 3.0, 4.0]
        self.assertEqual(rule.valid_to(lambda x: 1.0 + (0.03 if x == 3.0 else 0.0), lambda x: 1.0, places, 0.02, False), (2.0, False))
        self.assertEqual(rule.valid_to(lambda x: 1.05, lambda x: 1.0, places, 0.02, False), (None, False))
        self.assertEqual(rule.valid_to(lambda x: 1.0, lambda x: 1.0, places, 0.02, True), (4.0, True))
        for lost in (False, True):
            self.assertEqual(rule.valid_to(lambda x: 1.0 if x < 3.5 else None, lambda x: 1.0, places, 0.02, lost), (3.0, not lost))

    def test_the_window_ends_at_pressure_compression_or_the_last_measurement(self):
        def steel(up):
            return 4.0 + 1.5 * up

        begin, end = rule.window_of_velocities(9.0, steel, 10.0)
        self.assertAlmostEqual(rule.shock_pressure(9.0, steel(begin), begin), 10.0)
        self.assertAlmostEqual(rule.shock_pressure(9.0, steel(end), end), 100.0)
        _, end = rule.window_of_velocities(2.0, steel, 10.0)
        self.assertAlmostEqual(end / steel(end), 0.30)
        self.assertAlmostEqual(rule.window_of_velocities(9.0, steel, 1.0)[1], 1.0)

    def test_an_isotherm_of_birch_is_interpolated_exactly(self):
        store = potential_ranking.Store.__new__(potential_ranking.Store)
        store.volume = 0.1
        store.isotherm = [(0.1 * ratio, (140.0 + 200.0 * rule.strain(ratio)) * rule.birch_factor(ratio)) for ratio in (1.0, 0.96, 0.8, 0.7)]
        self.assertAlmostEqual(store.isotherm_curve()(0.75), (140.0 + 200.0 * rule.strain(0.75)) * rule.birch_factor(0.75))
        self.assertIsNone(store.isotherm_curve()(0.65))

    def test_a_curve_ends_by_itself_where_its_crystal_is_lost(self):
        store = potential_ranking.Store.__new__(potential_ranking.Store)
        store.volumes = {"hugoniot": [0.09, 0.08], "isotherm": [0.09, 0.07]}
        store.lost = {"hugoniot": [0.07], "isotherm": [0.08]}
        self.assertTrue(store.ends_by_itself("hugoniot"))
        self.assertFalse(store.ends_by_itself("isotherm"))

    def test_volume_of_an_isotherm_of_birch(self):
        volumes = [11.7, 11.0, 10.0, 9.0, 8.0]
        pressures = [(140.0 + 200.0 * rule.strain(v / 11.8)) * rule.birch_factor(v / 11.8) for v in volumes]
        self.assertAlmostEqual(measured.birch_volume(volumes, pressures), 11.8, places=6)


class Inputs(unittest.TestCase):
    def test_plans_are_of_the_metal(self):
        for metal in measured.METALS.values():
            for plan in metal.potentials:
                text = tomllib.loads((potential_ranking.ROOT / f"cases/md/{plan}.toml").read_text(encoding="utf-8"))
                self.assertEqual(text["element"], metal.symbol, plan)

    def test_references_have_a_window_and_follow_their_measurements(self):
        for name, metal in measured.METALS.items():
            reference = measured.Reference(metal)
            self.assertAlmostEqual(reference.pressures[0], 10.0, places=6)
            self.assertGreater(reference.pressures[1], 40.0, name)
        copper = measured.Reference(measured.METALS["copper"])
        self.assertAlmostEqual(copper.velocity(1.0), 3.94 + 1.489, delta=0.05)  # Steinberg 1996
        self.assertAlmostEqual(copper.density, 8.93, delta=0.02)

    def test_ten_metals(self):
        self.assertEqual(len(measured.METALS), 10)

    def test_a_row_says_what_was_not_asked(self):
        one = potential_ranking.Judged("a", candidate("a", isotherm=None).deviations, label="A", shocks_to=(90.0, True), stable_to="58.33 GPa")
        self.assertEqual(potential_ranking.row_of(one, "1", "0.50"),
                         ["1", "A", "1.0", "1.0", "", "+1.0", "not asked", "> 90", "", "58", "", "0.50"])
        self.assertEqual(potential_ranking.end_text((0.0, False)), "< 10")

    def test_a_section_has_the_qualified_first_and_the_reasons_of_the_others(self):
        rows = [potential_ranking.Judged(name, candidate(name, **values).deviations, label=name)
                for name, values in (("far", {"density": 0.05}), ("second", {"points": 0.05}), ("first", {}))]
        text = potential_ranking.section("copper", measured.Reference(measured.METALS["copper"]), rows, [("none", "no points")])
        lines = [line for line in text.splitlines() if line.startswith("| ")][2:]
        self.assertEqual([line.split(" | ")[1] for line in lines], ["first", "second", "far", "none"])
        self.assertIn("out: V0 more than 3 % off", lines[2])
        self.assertEqual({line.count("|") for line in lines}, {13})

    def test_melting_is_asked_of_the_first_of_eight_metals(self):
        rows = list(melting.plans())
        self.assertEqual([name for name, *_ in rows],
                         ["aluminium", "nickel", "tantalum", "tungsten", "molybdenum", "silver", "gold", "platinum"])
        self.assertAlmostEqual(dict((name, measured_at) for name, _, _, measured_at in rows)["aluminium"], 933.5, delta=0.5)

    def test_a_row_of_melting(self):
        self.assertEqual(melting.row("tungsten", "A", [(4776.0, 72.0), (0.2433e6, 0.0021e6)], 3687.0, "3.0"),
                         ["tungsten", "A", "4776 +- 72", "3687", "+29.5 %", "0.243 +- 0.002", "3.0"])
        self.assertEqual(melting.row("lead", "B", None, 600.6, "-"), ["lead", "B", "-", "601", "-", "-", "-"])

    def test_a_metal_without_a_qualified_potential_is_named(self):
        self.assertIn("| lead | none qualified |", potential_ranking.summary([("lead", [])]))


if __name__ == "__main__":
    unittest.main()
