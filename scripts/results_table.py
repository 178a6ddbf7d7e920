# SPDX-License-Identifier: BSD-3-Clause
"""Measured beside expected, as text and as Markdown for docs/results.md."""
import math
from dataclasses import dataclass

from report_data import History
from results_data import UNITS, Measures


@dataclass
class Comparison:
    """One run at one resolution: its expectations with the measured values."""
    case: object
    run: object
    resolution: str
    command: str
    rows: list  # (expectation, measured value in SI, whether it holds or None)


def compare(case, run, resolution, folder):
    measures = Measures(folder)
    history = History(folder / "history.csv")
    for name in ("energy_error", "momentum_error"):
        if name in history:
            measures.single[name] = float(abs(history[name]).max())
    if "maximum_speed" in history:
        measures.single["maximum_speed"] = float(history["maximum_speed"].max())
    rows = []
    for expectation in run.expectations:
        value = measures.value(expectation)
        rows.append((expectation, value, expectation.holds(value)))
    return Comparison(case, run, resolution, (folder / "finished.txt").read_text(), rows)


def shown(value, unit):
    """Four digits in the unit of the expectation."""
    if not math.isfinite(value):
        return "not found"
    text = f"{value / UNITS[unit]:.4g}"
    return f"{text} {unit}" if unit else text


def expected(expectation):
    value = shown(expectation.value, expectation.unit) if expectation.kind != "record" else ""
    if expectation.kind == "within":
        return f"{value} ± {shown(expectation.tolerance, expectation.unit)}"
    return {"at_most": f"≤ {value}", "at_least": f"≥ {value}", "record": "–"}[expectation.kind]


VERDICT = {True: "pass", False: "**FAIL**", None: "recorded"}


def as_text(compared):
    lines = []
    for c in compared:
        lines.append(f"{c.case.name}:{c.run.name} ({c.resolution}, cells of {c.run.cell_size[c.resolution]})")
        for expectation, value, holds in c.rows:
            lines.append(f"  {VERDICT[holds].strip('*'):9} {expectation.name}: {shown(value, expectation.unit)}"
                         f" (expected {expected(expectation)})")
    return "\n".join(lines)


def rounded(text):
    """Cell sizes such as 1.0714285714 mm with four digits."""
    number, _, unit = text.partition(" ")
    return f"{float(number):.4g} {unit}"


def as_markdown(compared):
    """A table per case: one row per quantity, one column per run and resolution that was run."""
    lines = []
    for case in dict.fromkeys(c.case for c in compared):
        lines += [f"### {case.title}", "",
                  f"[cases/{case.name}](../cases/{case.name}): `scripts/results.py {case.name} --run`", ""]
        for run in dict.fromkeys(c.run for c in compared if c.case is case):
            mine = [c for c in compared if c.run is run]
            if run.title:
                lines += [f"**{run.title}**", ""]
            lines.append("| quantity | " + " | ".join(f"cells of {rounded(run.cell_size[c.resolution])}" for c in mine)
                         + " | expected | source |")
            lines.append("| --- |" + " --- |" * (len(mine) + 2))
            for i, expectation in enumerate(run.expectations):
                cells = [f"{shown(c.rows[i][1], expectation.unit)}" + ("" if c.rows[i][2] is None else
                                                                       f" {VERDICT[c.rows[i][2]]}") for c in mine]
                lines.append(f"| {expectation.name} | " + " | ".join(cells) +
                             f" | {expected(expectation)} | {expectation.source} |")
            known = [f"{e.name}: {e.known}" for i, e in enumerate(run.expectations)
                     if e.known and any(c.rows[i][2] is False for c in mine)]
            lines += ["", *(f"- {text}" for text in known), *([""] if known else [])]
    return "\n".join(lines)
