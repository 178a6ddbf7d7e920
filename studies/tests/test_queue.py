# SPDX-License-Identifier: BSD-3-Clause
"""A queue of computations: order by value, what is current is left out, what does not fit is left for another call."""
import json
import pathlib
import tempfile
import types
import unittest
from unittest import mock

from studies.validation import comparison, execution, provenance, queue


def run_of(name, *, headline=True, sensitivity=False, decided_by=""):
    return types.SimpleNamespace(name=name, headline=headline, sensitivity=sensitivity, decided_by=decided_by,
                                 cell_size={"normal": "1 mm"}, expectations=[])


def entry_of(run, source, seconds=10.0):
    record = {"source": source, "cell_size": "1 mm", "wall_time": seconds, "threads": 1}
    return {"name": run.name, "inputs": "inputs", "records": {"normal": record}}


class Queue(unittest.TestCase):
    def setUp(self):
        self.case = types.SimpleNamespace(name="case")
        variant = types.SimpleNamespace(name="normal", resolution="normal")
        for target, of, value in ((queue, "variants_of", lambda run, band: [variant]),
                                  (comparison, "extra_grids", lambda run: []),
                                  (execution, "state_of", lambda *_: (None, provenance.MISSING)),
                                  (execution, "folder_of", lambda *_: None),
                                  (provenance, "inputs_of", lambda run: "inputs")):
            patch = mock.patch.object(target, of, value)
            patch.start()
            self.addCleanup(patch.stop)

    def planned(self, *entries):
        runs = [run for run, _ in entries]
        results = {"cases": {"case": {"runs": [entry for _, entry in entries if entry]}}}
        return queue.plan(results, [(self.case, run) for run in runs], "now")

    def test_order_is_by_rank_then_by_cost_and_what_is_current_is_left_out(self):
        runs = {"sensitivity": run_of("sensitivity", sensitivity=True), "decided": run_of("decided", decided_by="cheap"),
                "dear": run_of("dear"), "cheap": run_of("cheap"), "plain": run_of("plain", headline=False),
                "current": run_of("current")}
        never = run_of("never")
        jobs = self.planned((never, None), *((run, entry_of(run, "now" if name == "current" else "former",
                                             500.0 if name == "dear" else 10.0)) for name, run in runs.items()))
        self.assertEqual([job.run.name for job in jobs], ["cheap", "dear", "plain", "decided", "sensitivity", "never"])

    def test_another_input_or_cell_size_is_not_current(self):
        run = run_of("run")
        for change in ({"inputs": "others"}, {"records": {"normal": entry_of(run, "now")["records"]["normal"] | {"cell_size": "2 mm"}}}):
            self.assertEqual(len(self.planned((run, entry_of(run, "now") | change))), 1)
        self.assertEqual(self.planned((run, None))[0].cost, queue.UNKNOWN_COST)

    def test_writes_what_is_done_and_leaves_what_does_not_fit(self):
        quick, slow, broken = (run_of(name) for name in ("quick", "slow", "broken"))
        jobs = self.planned((quick, entry_of(quick, "former", 1.0)), (slow, entry_of(slow, "former", 1e6)),
                            (broken, entry_of(broken, "former", 1.0)))
        written = []
        with mock.patch.object(execution, "execute", lambda whipple, case, run, *_: run is not broken), \
                mock.patch.object(execution, "analyse", lambda *_: True), mock.patch("builtins.print"):
            failed, left = queue.work_off(jobs, "whipple", 1.0, 2, written.append)
        self.assertEqual(([job.run.name for job in failed], [job.run.name for job in left]), (["broken"], ["slow"]))
        self.assertEqual(written, [[(self.case, quick)]])

    def test_what_is_being_measured_is_written_later(self):
        runs = [run_of(name) for name in ("a", "b", "c")]
        jobs = self.planned(*((run, entry_of(run, "former", 1.0)) for run in runs))
        calls = []

        def write(chosen):
            calls.append(len(chosen))
            if len(calls) == 1:
                raise queue.BadExpectation("quantities.csv is missing")

        with mock.patch.object(execution, "execute", lambda *_: True), \
                mock.patch.object(execution, "analyse", lambda *_: True), mock.patch("builtins.print"):
            self.assertEqual(queue.work_off(jobs, "whipple", 1.0, 1, write, write_every=-1.0), ([], []))
        self.assertEqual(calls, [1, 2, 1])


class Begun(unittest.TestCase):
    """A run that was stopped goes on from its checkpoint if it is the same run of the same program."""

    def test_goes_on_where_it_was_stopped(self):
        begun = {"command": ["whipple", "run"], "executable": "one", "case": "digest"}
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertIsNone(execution.wall_time_of_begun(folder, begun))
            (folder / execution.BEGUN).write_text(json.dumps(begun | {"wall_time": 10.0}))
            (folder / "status.json").write_text('{"state": "stopped", "wall_time": 2.5}')
            self.assertIsNone(execution.wall_time_of_begun(folder, begun), "without a checkpoint it begins again")
            (folder / "checkpoint").mkdir()
            (folder / "checkpoint" / "checkpoint.00000007.h5").touch()
            self.assertEqual(execution.wall_time_of_begun(folder, begun), 12.5)
            self.assertIsNone(execution.wall_time_of_begun(folder, begun | {"executable": "other"}))
            self.assertIsNone(execution.wall_time_of_begun(folder, begun | {"case": "another"}))
            (folder / "status.json").write_text('{"state": "done", "wall_time": 2.5}')
            self.assertIsNone(execution.wall_time_of_begun(folder, begun), "a restart would add a step to a run that has ended")


if __name__ == "__main__":
    unittest.main()
