# SPDX-License-Identifier: BSD-3-Clause
"""The table of a run with several Courant numbers."""
import types
import unittest

from studies.time_step_independence import time_step_independence as study


class Table(unittest.TestCase):
    def test_spread_is_relative_to_the_mean_and_errors_of_balances_are_left_out(self):
        run = types.SimpleNamespace(name="only", title="", cell_size={"coarse": "2 mm"}, expectations=[
            types.SimpleNamespace(name=name, unit="mm", key=key) for name, key in (("depth", 0), ("energy error", 1))])
        case = types.SimpleNamespace(name="made_up", title="Made up")
        measures = [types.SimpleNamespace(value=lambda e, v=v: v[e.key]) for v in ((0.9e-3, 1e-5), (1.1e-3, 1e-9))]
        text = study.table_of(case, run, "coarse", [0.2, 0.8], measures)
        self.assertIn("| depth | 0.9 mm | 1.1 mm | 20.00 % |", text)
        self.assertIn("(`made_up:only`, cells of 2 mm)", text)
        self.assertNotIn("energy error", text)

    def test_the_default_cases_are_there(self):
        self.assertEqual(len(study.select(study.DEFAULT_CASES)), len(study.DEFAULT_CASES))
