# SPDX-License-Identifier: BSD-3-Clause
"""What the case of a run must show (its expected.toml) beside what the run shows, with the bands of the grid studies."""
import json
import math
import pathlib

import numpy as np
from matplotlib.figure import Figure

from report import measured_history, program, style, units
from report.curves import new_figure
from report.expectations import UNITS, BadExpectation, Case, Expectation, RunOfCase, quantity
from report.measured import Measures, request
from report.page import Page
from report.run import Run

ROOT = pathlib.Path(__file__).resolve().parents[1]
STUDIES = ROOT / "docs" / "generated" / "results"
AXES = "xyz"


def case_of(run: Run) -> Case | None:
    """Finds the expected.toml beside the case of a run: where it was started, or in the repository. None without one."""
    named = run.input.get("provenance", {}).get("case_file", "")
    if not named:
        return None
    for folder in (pathlib.Path(named).parent, (ROOT / named).parent):
        if all((folder / name).is_file() for name in ("expected.toml", "case.toml")):
            return Case(folder / "expected.toml")
    return None


def si(value: object) -> float:
    """Returns a value with its unit in SI; run.toml has angles in rad. Raises BadExpectation for what is no number."""
    return quantity(value.removesuffix(" rad") if isinstance(value, str) else value, "")[0]


def same(written: object, wanted: object) -> bool:
    """Whether a value of run.toml is the one of an assignment, whatever its unit; run.toml also has what is left out there: keys
    of their defaults, and z of two dimensions."""
    if isinstance(written, dict) and isinstance(wanted, dict):
        return all(key in written and same(written[key], value) for key, value in wanted.items())
    if isinstance(written, list) and isinstance(wanted, list):
        rest = written[len(wanted):]
        left_out = not rest or (len(wanted) == 2 and all(same(entry, 0.0) for entry in rest))
        return len(written) >= len(wanted) and left_out and all(map(same, written, wanted))
    try:
        return math.isclose(si(written), si(wanted), rel_tol=1e-9)
    except BadExpectation:
        return str(written) == str(wanted)


def turned(value: object, first: int) -> object:
    """Returns a value of a case as run.toml of a section has it: axis number `first` is x there, the next one y."""
    if isinstance(value, dict):
        return {key: turned(entry, first) for key, entry in value.items()}
    if isinstance(value, str) and value in AXES:
        return AXES[(AXES.index(value) - first) % 3]
    if isinstance(value, list) and len(value) == 3 and not any(isinstance(entry, (dict, list)) for entry in value):
        return [value[(first + k) % 3] for k in range(3)]
    return value


def value_at(table: object, way: list[str]) -> object:
    """Returns the value of a key that is split at its dots; a component stands for its vector. None if there is none."""
    for i, part in enumerate(way):
        if isinstance(table, list) and i + 1 == len(way) and not any(isinstance(entry, dict) for entry in table):
            return table
        try:
            table = table[int(part)] if isinstance(table, list) else table[part]
        except (KeyError, IndexError, ValueError, TypeError):
            return None
    return table


def holds_in(run: Run, key: str, table: dict) -> bool:
    """Whether the input of a run has the value that a key has in a resolved case, whose axes a section turns."""
    domain = table["domain"]
    first = AXES.index(domain.get("axis", "x")) if domain["dimension"] != "3d" else 0
    way = key.split(".")
    if way[0] == "domain" and way[1] in ("axis", "lower", "upper"):
        return True  # run.toml has been turned, its axis is x; its domain may have grown to whole cells
    wanted = turned(value_at(table, way), first)
    if way[:2] == ["domain", "boundary"] and len(way) == 3:
        axis, _, side = way[2].partition("_")
        way = [*way[:2], f"{turned(axis, first)}_{side}"]
    written = value_at(run.input, way)
    if way[-1] == "material":  # a run keeps copies of its materials
        written, wanted = (pathlib.PurePath(str(name)).stem for name in (written, wanted))
    return same(written, wanted)


def keys_of(assignments: list[str]) -> list[str]:
    """Returns the keys of KEY=VALUE."""
    return [assignment.partition("=")[0] for assignment in assignments]


def table_of(each: RunOfCase) -> dict:
    """Returns the input of a run of a case; cells apart, it is the same on all grids."""
    table = each.resolved(next(iter(each.cell_size)))
    table["domain"].setdefault("dimension", "3d")
    return table


def run_of(case: Case, run: Run) -> RunOfCase | None:
    """Finds the run of a case whose assignments a run has, the one with the most; None if there is none."""
    fitting = [each for each in case.runs if all(holds_in(run, key, table_of(each)) for key in keys_of(each.set))]
    return max(fitting, key=lambda each: len(each.set), default=None)


def departures(case: Case, each: RunOfCase, run: Run) -> list[str]:
    """Returns the keys that have other values in a run than in the one it is compared with: those that runs of the case set,
    and the materials of all bodies."""
    table = table_of(each)
    keys = dict.fromkeys(key for other in case.runs for key in keys_of(other.set))
    keys.update(dict.fromkeys(f"body.{number}.material" for number in range(len(table.get("body", [])))))
    return [key for key in keys if value_at(table, key.split(".")) is not None and not holds_in(run, key, table)]


def studies_of(case: Case, run: RunOfCase, store: pathlib.Path = STUDIES) -> dict[str, dict]:
    """Returns what the grid studies found, by the names of quantities; empty without docs/generated/results/<case>.json."""
    path = store / f"{case.name}.json"
    if not path.is_file():
        return {}
    runs = json.loads(path.read_text(encoding="utf-8"))["runs"]
    return {q["name"]: q for each in runs if each["name"] == run.name for q in each["quantities"]}


def shown(value: float | None, unit: str, digits: int = 4) -> str:
    """Writes a number in the unit of its expectation."""
    text = units.number(None if value is None else value / UNITS[unit], digits)
    return text if text == units.MISSING else f"{text} {unit}".strip()


def expectation_text(e: Expectation) -> str:
    """Writes what is expected: "14 mm ± 1 mm", "≤ 0 mg"."""
    value = shown(e.value, e.unit)
    return {"within": f"{value} ± {shown(e.tolerance, e.unit)}", "at_most": f"≤ {value}", "at_least": f"≥ {value}",
            "record": units.MISSING}[e.kind]


def verdict(e: Expectation, value: float, band: float | None) -> str:
    """Says whether a value is as expected, if need be within the band of the grid study."""
    if e.kind == "record":
        return ""
    if not math.isfinite(value):
        return "not measured"
    if e.holds(value):
        return "as expected"
    nearest = min(max(e.value, value - band), value + band) if band else value
    if e.holds(nearest):
        return "within the band"
    return "departs"


def source_of(e: Expectation) -> str:
    """Writes what the expected value comes from, its kind first."""
    source = e.source if e.source.startswith(f"{e.origin}: ") else f"{e.origin}: {e.source}"
    return source + (f". Known: {e.known}" if e.known else "")


def figure_of(rows: list[tuple[Expectation, float, float | None]]) -> Figure | None:
    """Draws values over their expectations with tolerances and bands; None if none of them has a size."""
    rows = [(e, value, band) for e, value, band in rows
            if e.kind != "record" and e.origin != "identity" and e.value and math.isfinite(value)]
    if not rows:
        return None
    figure, (ax,) = new_figure(1, 0.7 + 0.26 * len(rows))
    figure.set_figwidth(style.WIDTH)
    for place, (e, value, band) in enumerate(reversed(rows)):
        width = e.tolerance / abs(e.value)
        if e.kind == "within":
            ax.barh(place, 2 * width, left=1 - width, height=0.55, color=style.LINES[6], alpha=0.4, linewidth=0)
        else:
            ax.plot(1, place, ">" if e.kind == "at_least" else "<", color=style.LINES[6], markersize=6)
        ax.errorbar(value / e.value, place, xerr=(band or 0.0) / abs(e.value), fmt="o", color=style.LINES[1], capsize=2)
    ax.axvline(1, color="#888888", linewidth=0.6)
    low, high = ax.get_xlim()
    ax.set_xlim(max(low, -0.5), min(high, 3.0))
    ax.set_yticks(np.arange(len(rows)), [e.name for e, _, _ in reversed(rows)])
    ax.set_xlabel("value of this run over the expected one")
    return figure


def add_to(page: Page, run: Run, add_figure) -> list[dict]:
    """Adds the section, if the case of the run has expectations. Returns the rows as data.

    add_figure(name, caption, figure): puts a figure into the page."""
    try:
        case = case_of(run)
        found = case and run_of(case, run)
        if not found or not run.analysis:
            return []
        measures = Measures(run.folder, run.output)
        values = [(e, measures.value(e)) for e in found.expectations]
        histories = measured_history.figure(run.folder / "gauges.csv", found.expectations,
                                            lambda e: program.measure(run.folder, request(e, "history_shift")))
    except BadExpectation as error:
        page.note(f"The expectations of the case cannot be read: {error}")
        return []
    studies = studies_of(case, found)
    rows, data, drawn = [], [], []
    for e, value in values:
        study = studies.get(e.name, {})
        band = study.get("u_num")
        result = verdict(e, value, band)
        drawn.append((e, value, band))
        rows.append([e.name, shown(value, e.unit), expectation_text(e), shown(band, e.unit, 2),
                     shown(study.get("value"), e.unit), result, source_of(e)])
        data.append({"name": e.name, "value": value, "expected": e.value, "kind": e.kind, "tolerance": e.tolerance,
                     "band": band, "verdict": result})
    page.heading("Expected, and found in this run")
    page.paragraph(f"Expectations of {case.title}" + (f", {found.title}" if found.title else "") + " (expected.toml of the case).")
    if others := departures(case, found, run):
        page.note(f"They are those of another input: this run has another value of {', '.join(others)}.")
    page.table(["quantity", "this run", "expected", "band of 95 %", "finest grid", "", "source"], rows, text_columns=(0, 5, 6))
    add_figure("expected.png", "Points: this run, with the band of 95 % of the case's grid study. Blue: expected value with "
               "its tolerance; arrows: bounds, and the side that is allowed.", figure_of(drawn))
    add_figure("histories.png", "Measured histories and those of this run, moved in time so that both reach half the largest measured "
               "value together.", histories)
    page.note("The band is that of the case's own grid study (docs/generated/results: discretization, position of the "
              "lattice), where there is one; its value on the finest grid is next to it. A departure of a single run "
              "within the band says nothing." if studies else
              "No grid study of this case is at hand: the values have no band.")
    return data
