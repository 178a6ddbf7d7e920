# SPDX-License-Identifier: BSD-3-Clause
"""Scores of predictions about shields, and the page of zero, few and many runs."""
import csv
import pathlib
import tempfile
import unittest

from studies.shields import curve, page, scores


def shot(name, failed, run=None, size=1.2, **more):
    values = {"speed": 6.0, "angle": 0.0, "thickness": 0.25, "alloy": "6061-T6", "runnable": True, "resolved": True} | more
    made = page.Shot(name=name, failed=failed, sizes={"nno_1993": size, "nno_2001": size, "jsc_2011": None}, **values)
    if run is not None:
        made.run = page.Run(outcome=run, resolved=True, hours=0.5, revision="1.0", reason="because")
    return made


class Scores(unittest.TestCase):
    def test_interval_is_that_of_wilson(self):
        low, high = scores.wilson(81, 263)  # Newcombe, Stat. Med. 17 (1998) 857, table I
        self.assertAlmostEqual(low, 0.2553, 4)
        self.assertAlmostEqual(high, 0.3662, 4)
        low, high = scores.wilson(0, 20)
        self.assertEqual(low, 0.0)
        self.assertAlmostEqual(high, 0.1611, 4)
        self.assertEqual(scores.percent(0, 0), "-")

    def test_mcnemar_is_the_binomial_test(self):
        self.assertEqual(scores.mcnemar(0, 0), 1.0)
        self.assertAlmostEqual(scores.mcnemar(1, 9), 2 * 11 / 1024)
        self.assertEqual(scores.mcnemar(9, 1), scores.mcnemar(1, 9))
        self.assertEqual(scores.mcnemar(5, 5), 1.0)

    def test_confusion_leaves_out_what_is_undecided(self):
        shots = [shot("a", True, "perforated"), shot("b", True, "whole"), shot("c", False, "bulge"),
                 shot("d", False, "detached spall"), shot("e", True, "undecided"), shot("f", True)]
        table = scores.confusion(shots, page.Shot.defeated)
        self.assertEqual((table.hit, table.unsafe, table.held, table.alarm), (1, 1, 1, 1))
        self.assertEqual(table.right, 2)
        self.assertEqual(table.majority, 2)
        self.assertEqual(scores.confusion(shots, page.Shot.perforated).alarm, 0)

    def test_pairs_are_of_the_same_shots(self):
        shots = [shot("a", True, "perforated"), shot("b", True, "whole"), shot("c", False, "whole"), shot("d", True)]
        self.assertEqual(scores.paired(shots, page.Shot.defeated, lambda s: s.equation("nno_1993")), (1, 1, 1, 0))
        self.assertEqual(scores.paired(shots, page.Shot.defeated, lambda s: s.equation("jsc_2011")), (0, 0, 0, 0))


class Page(unittest.TestCase):
    def test_without_runs_it_says_that_there_is_no_accuracy(self):
        text = page.page([shot("a", True), shot("b", False, resolved=False)], {"x": "because"})
        self.assertIn("No shot has been scored", text)
        self.assertIn("Resolved shots without a run: 1", text)
        self.assertIn("- x: because", text)

    def test_few_runs_are_scored_without_the_calibrating_ones(self):
        shots = [shot("a", True, "whole"), shot("b", False, "whole"), shot("c", True, "perforated"), shot("d", True, "undecided")]
        text = page.page(shots, {"c": "looked at"})
        self.assertIn("1 calibrating, 0 not resolved, 1 undecided; scored: 2", text)
        self.assertIn("| all | 0 | 1 | 0 | 1 | 50.0 %", text)
        self.assertIn("| a | whole | because |", text)
        self.assertNotIn("| c | perforated", text)

    def test_many_runs_are_grouped_and_compared(self):
        shots = [shot(f"s{k}", k % 2 == 0, "perforated" if k % 2 == 0 else "whole", size=0.9 if k % 3 else 3.0,
                      speed=2.0 + 0.05 * k, alloy=("6061-T6", "7075-T6")[k % 2]) for k in range(90)]
        text = page.page(shots, {})
        self.assertIn("| all | 45 | 0 | 0 | 45 | 100.0 %", text)
        self.assertIn("| near the limit | 30 | 0 | 0 | 30 |", text)
        self.assertIn("wall 7075-T6", text)
        row = next(line for line in text.splitlines() if line.startswith("| all | NNO (1993) | 45 | 45 | 0 | 0 |"))
        self.assertLess(float(row.split("|")[-2]), 1e-12)
        self.assertIn("None.", text)

    def test_outcome_of_an_unknown_shot_is_refused(self):
        with self.assertRaises(SystemExit):
            page.add_runs([shot("a", True)], [{"shot": "b"}])


class Tables(unittest.TestCase):
    def test_shots_have_sources_and_calibrating_ones_are_among_them(self):
        rows = page.read_csv(page.HERE / "shots.csv")
        names = [f"{row['source']}/{row['shot']}" for row in rows]
        self.assertEqual(len(names), 570)
        self.assertEqual(len(set(names)), 570)
        self.assertTrue(all(row["source"] for row in rows))
        calibrating = [row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")]
        self.assertLessEqual(len(calibrating), 10)
        self.assertLessEqual(set(calibrating), set(names))

    def test_limits_become_diameters(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "limits.csv"
            with open(file, "w", newline="", encoding="utf-8") as out:
                csv.writer(out).writerows([["body.0.velocity.2 [m/s]", "lower [mm]", "upper [mm]", "verdict"],
                                           ["6000", "1.5", "2", "found"], ["3000", "nan", "nan", "undecided: ends"]])
            self.assertEqual(curve.limits(file), [(3.0, None, None, "undecided: ends"), (6.0, 3.0, 4.0, "found")])

    def test_speed_of_a_shield_is_replaced(self):
        texts = curve.at_speeds('[projectile]\nvelocity = "6.7 km/s"\n[shield.wall]\n', [2.5])
        self.assertEqual(texts, ['[projectile]\nvelocity = "2.5 km/s"\n[shield.wall]\n'])


if __name__ == "__main__":
    unittest.main()
