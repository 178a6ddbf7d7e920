# SPDX-License-Identifier: BSD-3-Clause
"""Scores of predictions about shields, and the page of zero, few and many runs."""
import csv
import json
import pathlib
import shutil
import tempfile
import unittest
import unittest.mock

import numpy as np

from studies import commands
from studies.shields import curve, page, repeats, run_shots, scores, tile


def shot(name, failed, run=None, size=1.2, **more):
    values = {"speed": 6.0, "angle": 0.0, "thickness": 0.25, "alloy": "6061-T6", "runnable": True, "resolved": True} | more
    made = page.Shot(name=name, failed=failed, sizes={"nno_1993": size, "nno_2001": size, "jsc_2011": None}, **values)
    if run is not None:
        made.run = page.Run(model="space", outcome=run, resolved=True, hours=0.5, revision="1.0", reason="because")
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
        text = page.page({"space": [shot("a", True), shot("b", False, resolved=False)]}, {"x": "because"})
        self.assertIn("No shot has been scored", text)
        self.assertIn("Resolved shots without a run: 1", text)
        self.assertIn("- x: because", text)

    def test_few_runs_are_scored_without_the_calibrating_ones(self):
        shots = [shot("a", True, "whole"), shot("b", False, "whole"), shot("c", True, "perforated"), shot("d", True, "undecided")]
        text = page.page({"space": shots}, {"c": "looked at"})
        self.assertIn("1 calibrating, 0 not resolved, 1 undecided; scored: 2", text)
        self.assertIn("| all | 0 | 1 | 0 | 1 | 50.0 %", text)
        self.assertIn("| a | whole | because | 0.5 |", text)
        self.assertNotIn("| c | perforated", text)

    def test_many_runs_are_grouped_and_compared(self):
        shots = [shot(f"s{k}", k % 2 == 0, "perforated" if k % 2 == 0 else "whole", size=0.9 if k % 3 else 3.0,
                      speed=2.0 + 0.05 * k, alloy=("6061-T6", "7075-T6")[k % 2]) for k in range(90)]
        text = page.page({"space": shots}, {})
        self.assertIn("| all | 45 | 0 | 0 | 45 | 100.0 %", text)
        self.assertIn("| near the limit | 30 | 0 | 0 | 30 |", text)
        self.assertIn("wall 7075-T6", text)
        row = next(line for line in text.splitlines() if line.startswith("| all | NNO (1993) | 45 | 45 | 0 | 0 |"))
        self.assertLess(float(row.split("|")[-2]), 1e-12)
        self.assertIn("None.", text)

    def test_outcome_of_an_unknown_shot_is_refused(self):
        with self.assertRaises(SystemExit):
            page.by_model([shot("a", True)], [{"shot": "b"}])

    def test_sections_and_space_are_scored_apart(self):
        row = {"shot": "a", "resolved": "yes", "core hours": "1", "revision": "1.0", "reason": "because"}
        rows = [row | {"model": "section", "outcome": "whole"}, row | {"model": "space", "outcome": "perforated"}]
        models = page.by_model([shot("a", True)], rows)
        self.assertEqual({model: shots[0].defeated() for model, shots in models.items()}, {"section": False, "space": True})
        text = page.page(models, {})
        self.assertEqual(text.count("scored: 1"), 2)
        self.assertIn("| a | whole | because | 1 |", text)
        self.assertIn("| all | 1 | 0 | 0 | 0 | 100.0 %", text.split("## Runs: space")[1])


    def test_models_are_compared_on_the_shots_of_both(self):
        models = {"section": [shot("a", True, "whole"), shot("b", False, "whole"), shot("c", True, "whole")],
                  "tile": [shot("a", True, "perforated"), shot("b", False, "detached spall"), shot("c", True, "undecided")]}
        text = page.page(models, {}, {"another seed": [{"shot": "a", "outcome": "bulge"}, {"shot": "b", "outcome": "perforated"}]})
        self.assertIn("| section, tile | 0 | 1 | 1 | 0 | 1 |", text)
        self.assertIn("Of 2 shots 1 change between defeated and not.", text)
        self.assertIn("| b | detached spall | perforated |", text)
        self.assertIn("chosen when the outcomes of all shots were known", text.lower())
        before, tiles = text.split("## Runs: tile")
        self.assertIn("a model that was amended while it was scored", tiles)
        self.assertNotIn("amended", before)


PROGRAM = """#!/usr/bin/python3
import json, pathlib, sys
words = sys.argv[1:]
folder = pathlib.Path(words[words.index("-o") + 1]) if "-o" in words else None
if words[0] == "run":
    run = folder or pathlib.Path(words[words.index("--restart") + 1])
    if folder: folder.mkdir()
    (run / "restarted").write_text(str(folder is None))
    (run / "status.json").write_text(json.dumps({"revision": "r1", "wall_time": 3600, "message": "out of range"}))
    (run / "a.particles.0").write_text("")
    sys.exit(CODE)
elif "--outcome" in words:
    print(json.dumps({"outcome": "whole", "defeated": False, "time": 1e-5, "reason": "it has stopped"}))
else:
    folder.mkdir()
    (folder / "case.toml").write_text(" ".join(words[4:words.index("-o")]))
"""


class Batch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def program(self, code):
        file = self.folder / f"program_{code}"
        file.write_text(PROGRAM.replace("CODE", str(code)), encoding="utf-8")
        file.chmod(0o755)
        return file

    def test_other_options_have_another_folder(self):
        folders = [run_shots.folder_of(self.program(0), ["--model", model], "S/1", self.folder) for model in ("section", "space", "space")]
        self.assertNotEqual(folders[0], folders[1])
        self.assertEqual(folders[1], folders[2])
        self.assertIn("--model section", (folders[0] / "case.toml").read_text(encoding="utf-8"))

    def test_interrupted_runs_start_afresh_without_a_checkpoint_and_are_resumed_with_one(self):
        folder = run_shots.folder_of(self.program(0), [], "S/1", self.folder)
        run = folder / "run"
        run.mkdir()
        (run / "status.json").write_text("{}", encoding="utf-8")
        self.assertEqual(run_shots.judged(self.program(0), 1, folder)["outcome"], "whole")
        self.assertEqual((run / "restarted").read_text(encoding="utf-8"), "False")
        (run / "checkpoint").mkdir()
        (run / "checkpoint" / "checkpoint.00000007.h5").write_text("", encoding="utf-8")
        run_shots.judged(self.program(0), 1, folder)
        self.assertEqual((run / "restarted").read_text(encoding="utf-8"), "True")

    def test_failed_run_is_a_row_with_its_reason(self):
        folder = run_shots.folder_of(self.program(3), [], "S/1", self.folder)
        verdict = run_shots.judged(self.program(3), 1, folder)
        case = {"model": "space", "cell_size": 1e-4, "resolved": True, "particles": 10}
        row = run_shots.row_of("S/1", case, verdict, run_shots.status_of(folder / "run"), 2, dict.fromkeys(run_shots.SETTINGS, ""))
        self.assertEqual((row["outcome"], row["time [us]"], row["core hours"], row["revision"]), ("undecided", "", "2", "r1"))
        self.assertEqual(row["reason"], "the run failed: out of range")
        run_shots.append(self.folder / "outcomes.csv", row)
        self.assertEqual(page.read_csv(self.folder / "outcomes.csv"), [row])


    def tile_row(self, piece, size=0.4):
        folder = run_shots.folder_of(self.program(0), [], "S/1", self.folder)
        (folder / "case.toml").write_text('body = [{ name = "wall", material = "aluminium_6061_mie_gruneisen.toml" }]', encoding="utf-8")
        for name in ("cloud", "tile_1_1"):
            (folder / name).mkdir()
            (folder / name / "status.json").write_text(json.dumps({"revision": "r1", "wall_time": 1800}), encoding="utf-8")
        load = tile.Load(7.0, 0.1, 5.0, size, np.zeros(1), np.ones(1), 0.3, piece)
        struck = tile.Tile(2.0, 0.1, 1.5, np.zeros((1, 3)), 0.4, 5.0)
        records = [(time, tile.Left(True, 400.0, tile.Off(), 0.1, 0.1)) for time in (1.0, 4.0)]
        entry = {"sphere": {"diameter": 3e-3}, "case": {"model": "section", "cell_size": 2e-4, "resolved": True, "particles": 10}}
        with unittest.mock.patch.object(tile, "computed_load", return_value=load), \
                unittest.mock.patch.object(tile, "tile_of_shot", return_value=struck), \
                unittest.mock.patch.object(tile, "computed_history", return_value=records):
            return run_shots.tile_row(self.program(0), 2, "S/1", entry, folder, 1, 1.0)

    def test_grains_strike_a_tile_and_one_piece_the_section(self):
        row = self.tile_row(0.1)
        self.assertEqual((row["outcome"], row["model"], row["cell size [mm]"], row["particles"], row["core hours"]),
                         ("perforated", "tile", "0.1", "48000", "2"))
        self.assertTrue(row["reason"].startswith("its rear half moves at 400 m/s"))
        for piece, size in ((0.6, 0.4), (0.1, 3.1), (0.1, np.nan)):
            shutil.rmtree(self.folder)
            self.folder.mkdir()
            row = self.tile_row(piece, size)
            self.assertEqual((row["outcome"], row["model"], row["cell size [mm]"], row["core hours"]), ("whole", "tile", "0.2", "3"))
            self.assertIn(f"one piece of {100 * piece:.0f} % of the sphere", row["reason"])


    def test_cases_of_tiles_have_the_name_of_their_run(self):
        for name in ("tile_1_1", "tile_1_1.25"):
            with unittest.mock.patch.object(commands, "compute") as compute:
                (self.folder / name).mkdir()
                (self.folder / name / "status.json").write_text('{"state": "done"}', encoding="utf-8")
                tile.run("whipple", 2, f"# {name}", self.folder / name)
            self.assertEqual(compute.call_args.args[3], [self.folder / f"{name}.toml"])
            self.assertEqual((self.folder / f"{name}.toml").read_text(encoding="utf-8"), f"# {name}")
        self.assertEqual((self.folder / "tile_1_1.toml").read_text(encoding="utf-8"), "# tile_1_1")

    def test_failed_cloud_or_tile_is_a_row_with_its_reason(self):
        load = tile.Load(7.0, 0.1, 5.0, 0.4, np.zeros(1), np.ones(1), 0.3, 0.1)
        keys = {"title": "t", "domain": {"lower": [], "upper": []}, "body": [{"name": name, "material": "aluminium_6061_mie_gruneisen.toml",
                "shape": {}} for name in ("sphere", "wall")]}
        entry = {"sphere": {"diameter": 3e-3, "velocity": 5e3}, "wall": {"thickness": 1.5e-3}, "bumpers": [{"spacing": 0.05}],
                 "case": {"model": "section", "cell_size": 2e-4, "resolved": True, "particles": 10}}
        status = {"state": "failed", "revision": "r1", "wall_time": 1800, "message": "out of range"}

        def compute(whipple, folder, words, inputs, allowed):
            self.assertEqual(allowed, (0, 3))
            folder.mkdir(exist_ok=True)
            (folder / "status.json").write_text(json.dumps(status | {"state": "failed" if folder.name == broken else "done"}), encoding="utf-8")

        for broken, cell, hours in (("cloud", "0.2", "1"), ("tile_3_1.25", "0.1385", "2")):
            with unittest.mock.patch.object(commands, "compute", compute), unittest.mock.patch.object(tile, "load_of_run", return_value=load), \
                    unittest.mock.patch.object(tile, "section_case", return_value=""), \
                    unittest.mock.patch.object(tile, "shot_in", lambda entry, folder: tile.Shot(entry, keys, folder)):
                row = run_shots.tile_row("whipple", 2, "S/1", entry | {"bumpers": [{"spacing": 0.05, "thickness": 1e-3}]}, self.folder, 3, 1.25)
            self.assertEqual((row["outcome"], row["time [us]"], row["reason"]), ("undecided", "", f"the run of {broken} failed: out of range"))
            self.assertEqual((row["cell size [mm]"], row["core hours"], row["seed"], row["coarser"]), (cell, hours, "3", "1.25"))

    def test_rows_of_other_settings_or_columns_are_refused(self):
        file, settings = self.folder / "outcomes.csv", run_shots.tile_settings(1, 1.0)
        self.assertEqual(run_shots.rows_of(file, "tile", settings), [])
        row = dict.fromkeys(run_shots.COLUMNS, "") | {"shot": "S/1", "model": "tile"} | settings
        run_shots.append(file, row)
        self.assertEqual(run_shots.rows_of(file, "tile", settings), [row])
        self.assertEqual(run_shots.rows_of(file, "section", dict.fromkeys(run_shots.SETTINGS, "")), [])
        for other in (run_shots.tile_settings(2, 1.0), run_shots.tile_settings(1, 1.25), settings | {"tile.py": "0"}):
            with self.assertRaisesRegex(SystemExit, "S/1 has .* need another --outcomes"):
                run_shots.rows_of(file, "tile", other)
        file.write_text("shot,outcome\n", encoding="utf-8")
        with self.assertRaisesRegex(SystemExit, "line 1"):
            run_shots.rows_of(file, "tile", settings)

    def test_outcomes_that_are_kept_have_the_columns(self):
        for name in ("outcomes.csv", *page.REPEATS.values()):
            self.assertEqual((page.HERE / name).read_text(encoding="utf-8").splitlines()[0], ",".join(run_shots.COLUMNS))


class Repeats(unittest.TestCase):
    def test_shots_are_chosen_by_their_names_alone(self):
        rows = [{"shot": f"S/{i:03}", "model": "section", "outcome": "bulge", "resolved": "yes"} for i in reversed(range(100))]
        rows[3]["outcome"] = "undecided"
        rows[4]["model"] = "tile"
        names = [row["shot"] for row in repeats.chosen(rows, {"S/000"}, 40)]
        self.assertEqual(len(set(names)), 40)
        self.assertEqual(names, sorted(names))
        self.assertEqual(names[0], "S/001")
        self.assertFalse({"S/000", "S/096", "S/095"} & set(names))  # calibrating, undecided, of another model
        other = [row | {"outcome": "perforated" if row["outcome"] == "bulge" else row["outcome"]} for row in rows]
        self.assertEqual([row["shot"] for row in repeats.chosen(other, {"S/000"}, 40)], names)

    def test_the_domain_moves_along_the_flight(self):
        text = '[domain]\nlower = ["0 mm", "0 mm", "-30.9575 mm"]\nupper = ["60.9 mm", "60.9 mm", "137.5325 mm"]\ncell_size = "0.5 mm"\n'
        self.assertEqual(repeats.moved(text), text.replace("-30.9575", "-31.0825").replace("137.5325", "137.4075"))
        with self.assertRaises(ValueError):
            repeats.moved(text.replace("upper", "top"))

    def test_changes_are_between_defeated_and_not(self):
        row = {"shot": "A", "variant": "lattice", "first": "perforated", "outcome": "detached spall", "same bytes": "", "revision": "1"}
        rows = [row, row | {"shot": "B", "outcome": "bulge"}, row | {"shot": "C", "outcome": "undecided"},
                row | {"shot": "D", "variant": "two threads", "outcome": "perforated", "same bytes": "yes"}]
        text = "\n".join(page.section_repeats(rows))
        self.assertIn("| lattice | 3 | 1 | 50.0 %", text)
        self.assertIn("| two threads | 1 | 0 | 0.0 %", text)
        self.assertIn("1 of 1 |", text)
        self.assertIn("| B | lattice | perforated | bulge |", text)
        self.assertEqual(page.section_repeats([]), [])


class Tables(unittest.TestCase):
    def test_shots_have_sources_and_calibrating_ones_are_among_them(self):
        rows = page.read_csv(page.HERE / "shots.csv")
        names = [f"{row['source']}/{row['shot']}" for row in rows]
        self.assertEqual(len(names), 570)
        self.assertEqual(len(set(names)), 570)
        self.assertTrue(all(row["source"] for row in rows))
        calibrating = [row["shot"] for row in page.read_csv(page.HERE / "calibrating.csv")]
        self.assertIn("Ryan_2011/HD9920066", calibrating)
        self.assertEqual(len(set(calibrating)), 12)
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
        for text in ("[projectile]\nvelocity = '6.7 km/s'\n", 'name = "3 km/s"\n[projectile]\nvelocity = "3 km/s"\n'):
            with self.assertRaises(SystemExit):
                curve.at_speeds(text, [2.5])


if __name__ == "__main__":
    unittest.main()
