#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""expected.toml of every case can be read, and comparisons say what they should.

usage: results_expectations.py REPOSITORY
"""
import contextlib
import math
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT / "scripts"))

import results_table  # noqa: E402
from results_data import BadExpectation, Case, Expectation  # noqa: E402


def require(condition, message):
    if not condition:
        raise SystemExit(f"FAILED: {message}")


def every_case_is_understood():
    files = sorted((ROOT / "cases").glob("*/expected.toml"))
    require(len(files) >= 15, f"{len(files)} cases")
    for path in files:
        case = Case(path)
        require(case.file.is_file() and (path.parent / "README.md").is_file(), f"{case.name}: case.toml and README.md")
        require(len({run.name for run in case.runs}) == len(case.runs), f"{case.name}: two runs of one name")
        for run in case.runs:
            require(run.expectations, f"{case.name}:{run.name} expects nothing")
            for resolution in case.resolutions:
                require(run.assignments(resolution), resolution)


def expectation(**keys):
    return Expectation({"name": "n", "measure": "m", "source": "s", **keys}, "test")


def comparisons():
    within = expectation(value="14 mm", tolerance="1 mm")
    require(within.holds(0.0149) and not within.holds(0.0151) and not within.holds(math.nan), "within a length")
    percent = expectation(value="26.54 mm", tolerance="1 %")
    require(percent.holds(0.02680) and not percent.holds(0.02681), "within percent")
    require(expectation(value=0.95, kind="at_least").holds(0.95), "at least")
    require(not expectation(value=1e-10, kind="at_most").holds(2e-10), "at most")
    require(expectation(kind="record", unit="g").holds(1.0) is None, "recorded values are not compared")
    require(results_table.expected(within) == "14 mm ± 1 mm", results_table.expected(within))


def mistakes_are_named():
    for keys, reason in (({"value": "14 furlong", "tolerance": "1 mm"}, "14 furlong"), ({"value": "14 mm"}, "tolerance"),
                         ({"value": 1, "tolerance": 1, "kind": "near"}, "near"), ({"valeu": 1}, "valeu"),
                         ({"kind": "record", "unit": "stone"}, "stone")):
        try:
            expectation(**keys)
        except BadExpectation as error:
            require(reason in str(error), f"{reason!r} is not in {error}")
        else:
            require(False, f"{keys} passed")


def a_run_is_compared(work):
    """Written measures: a final value, one between two snapshots, one of the history, one of a body."""
    (work / "case").mkdir()
    (work / "case" / "expected.toml").write_text("""
title = "Made up"
cell_size = { coarse = "1 mm" }
[[run]]
name = "only"
""" + "".join(f"""
[[run.quantity]]
name = "{measure} {time}"
measure = "{measure}"
{f'time = "{time}"' if time else ''}
value = {value}
tolerance = "1 %"
source = "made up"
known = "a reason"
""" for measure, time, value in (("depth", "", 3.0), ("depth", "15 us", 2.5), ("energy_error", "", 4e-3),
                                 ("mass.wall.debris", "", 7.0), ("nothing", "", 1.0))))
    folder = work / "run"
    (folder / "report").mkdir(parents=True)
    (folder / "report" / "quantities.csv").write_text("quantity,value\ndepth,3\n")
    (folder / "report" / "series.csv").write_text("time [s],depth [m]\n0,1\n1e-05,2\n2e-05,3\n")
    (folder / "report" / "bodies.csv").write_text("body part,mass [kg]\nwall debris,7\n")
    (folder / "history.csv").write_text("step,energy_error\n0,1e-3\n1,-4e-3\n")
    (folder / "finished.txt").write_text("whipple run")
    case = Case(work / "case" / "expected.toml")
    compared = results_table.compare(case, case.runs[0], "coarse", folder)
    verdicts = [holds for _, _, holds in compared.rows]
    require(verdicts == [True, True, True, True, False], str(compared.rows))
    text = results_table.as_markdown([compared])
    require(text.count(" pass |") == 4, f"4 of 5 pass, but not in the table:\n{text}")
    for words in ("not found **FAIL**", "a reason", "cells of 1 mm"):
        require(words in text, f"{words!r} is not in the table:\n{text}")
    require(text.count("a reason") == 1, "the cause is given for failures only")


with contextlib.ExitStack() as stack:
    every_case_is_understood()
    comparisons()
    mistakes_are_named()
    a_run_is_compared(pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory())))
print("expectations: all checks passed")
