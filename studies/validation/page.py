# SPDX-License-Identifier: BSD-3-Clause
"""docs/generated/results.json as text and as the generated part of docs/generated/results.md: the page is a function of that file alone."""
import collections
import json
import math

from studies.validation import bands, frozen_parameters
from studies.validation.cases import ROOT, UNITS
from studies.validation.provenance import digest_of_file, digest_of_sources, inputs_of, is_same_program

STORE = ROOT / "docs" / "generated" / "results.json"
PAGE = ROOT / "docs" / "generated" / "results.md"
SENSITIVITIES = ROOT / "report" / "grid_sensitivity.json"
MARKERS = ("<!-- begin of the part that scripts/results.py writes -->", "<!-- end of that part -->")
CLASSES_OF_PHYSICS = ("experiment", "exact", "other code")
CHECKED = (bands.AGREES, bands.DIFFERS, bands.NOT_CONVERGED, bands.NOT_FOUND)
BOLD = (bands.DIFFERS, bands.NOT_FOUND, bands.BROKEN)


def load(path=STORE):
    return json.loads(path.read_text()) if path.is_file() else {"format": 1, "cases": {}}


def shown(value, unit, digits=4):
    """A number in the unit of the expectation."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value / UNITS[unit]:.{digits}g}"
    return f"{text} {unit}" if unit else text


def expected(q):
    """14 mm ± 1 mm, ≤ 0 mg, –"""
    value = shown(q["expected"], q["unit"])
    if q["kind"] == "within":
        return f"{value} ± {shown(q['tolerance'], q['unit'])}"
    return {"at_most": f"≤ {value}", "at_least": f"≥ {value}", "record": "–"}[q["kind"]]


def marked(mark):
    return f"**{mark}**" if mark in BOLD else mark


def physics(run):
    return [q for q in run["quantities"] if q["class"] != "identity"]


def verdict(marks):
    """Of a shot: it agrees if every quantity does; one that differs decides."""
    marks = list(marks)
    for mark in (bands.DIFFERS, bands.NOT_FOUND, bands.NOT_CONVERGED, bands.AGREES):
        if mark in marks:
            return mark
    return bands.RECORDED


def summary(results):
    """Tables over all cases: one line per experiment or problem; identities and convergence apart."""
    lines = []
    for origin, heading in zip(CLASSES_OF_PHYSICS, ("Experiments", "Exact solutions", "Other codes")):
        rows, totals = [], []
        for case in results["cases"].values():
            for run in case["runs"]:
                marks = [q["mark"] for q in run["quantities"] if q["class"] == origin]
                if run["sensitivity"] or run["decided_by"] or not marks:
                    continue
                totals.append(verdict(marks))
                grid = list(run["cells"].values())[-1]
                rows.append(f"| {case['title']}{': ' + run['title'] if run['title'] else ''} | {grid_text(grid)} | "
                            + " | ".join(str(marks.count(mark)) for mark in CHECKED[:3]) + f" | {marked(totals[-1])} |")
        if rows:
            counts = ", ".join(f"{totals.count(mark)} {mark}" for mark in CHECKED if totals.count(mark))
            lines += [f"**{heading}**, one line each: {len(totals)}, of which {counts}.", "",
                      "| what | finest cells | quantities that agree | differ | not converged | all together |",
                      "| --- | --- | --- | --- | --- | --- |", *rows, ""]
    runs = [run for case in results["cases"].values() for run in case["runs"]]
    studies = [q for run in runs if not run["sensitivity"] and not run["decided_by"] for q in physics(run)]
    converged = sum(q["grid"] in bands.CONVERGED for q in studies)
    three = sum(all(q["values"].get(name) is not None for name in ("coarse", "normal", "fine")) for q in studies)
    identities = [q["mark"] for run in runs for q in run["quantities"] if q["class"] == "identity"]
    lines += [f"**Convergence**: of {len(studies)} quantities {three} have three grids; {converged} are converged.", "",
              f"**Identities** (energy, momentum; true by construction of the scheme, no evidence of physics): "
              f"{identities.count(bands.HOLDS)} of {len(identities)} hold.", ""]
    return lines + parameter_sets(runs)


def parameter_sets(runs):
    """How many computations belong to which set of default numerical parameters: one set is the aim."""
    counts = collections.Counter(record["frozen_set"] for run in runs for record in run["records"].values())
    if not counts:
        return []
    parameters, parts = frozen_parameters.defaults(), []
    for name, number in counts.most_common():
        added = frozen_parameters.added_since(name, parameters)
        parts.append(f"{number} with the set {name}" + (
            " (**other values than now**)" if added is None else
            f", which is the same but for {', '.join(f'`{key}`' for key in added)} that came later" if added else ""))
    return [f"**Numerical parameters**, defaults by digest (`scripts/frozen_parameters.py --defaults`): of {counts.total()} "
            f"computations {'; '.join(parts)}.", ""]


def grid_text(text):
    """Cell sizes such as 1.0714285714 mm with four digits."""
    number, _, unit = text.partition(" ")
    return f"{float(number):.4g} {unit}"


def table(run):
    """The quantities of a run; values by grid, then bands, then the comparison."""
    grids = list(run["cells"])
    heads = ["quantity", *(grid_text(run["cells"][g]) for g in grids), "order", "limit", "U_grid", "U_lattice", "U_num",
             "expected", "E", "U_val", "", "class"]
    lines = ["| " + " | ".join(heads) + " |", "| --- |" + " --- |" * (len(heads) - 1)]
    for q in physics(run):
        unit = q["unit"]
        order = f"{q['order']:.2g}" if q["grid"] == "converged" else q["grid"]
        cells = [q["name"], *(shown(q["values"][g], unit) for g in grids), order, shown(q["limit"], unit),
                 *(shown(q[key], unit, 2) for key in ("u_grid", "u_lattice", "u_num")), expected(q),
                 shown(q["error"], unit, 3), shown(q["u_val"], unit, 2), marked(q["mark"]), q["class"]]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def provenance(run, source):
    """One line per program that computed runs of this table."""
    by_program = {}
    for name, record in run["records"].items():
        by_program.setdefault((record["program"], record["source"], record["processor"]), []).append((name, record))
    lines = []
    for (program, of, processor), entries in by_program.items():
        older = "" if is_same_program(of, source) else " **Older source.**"
        times = ", ".join(f"{name} {record['wall_time']:.0f} s on {record['threads']}" for name, record in entries)
        lines.append(f"Computed with {program}{' and changes' if entries[0][1]['dirty'] else ''}, source {of}, "
                     f"numerical parameters {entries[0][1]['frozen_set']}, case {run['inputs']['case']}, {processor}; "
                     f"{times}.{older}")
    return lines


def notes(run):
    """Sources and known causes, each said once."""
    lines, sources = [], {}
    for q in physics(run):
        sources.setdefault(q["source"], []).append(q["name"])
    for source, names in sources.items():
        lines.append(f"- Source of {'; '.join(names) if len(sources) > 1 else 'all'}: {source}")
    for q in physics(run):
        if q["u_input"] is not None:
            lines.append(f"- U_input of {q['name']}: {shown(q['u_input'], q['unit'], 2)}, by {', '.join(run['input'])}")
        if q["known"] and q["mark"] in (bands.DIFFERS, bands.NOT_CONVERGED, bands.NOT_FOUND):
            lines.append(f"- {q['name']}: {q['known']}")
    for q in run["quantities"]:
        if q["class"] == "identity":
            lines.append(f"- {q['name']}: {shown(q['value'], q['unit'], 2)}, {marked(q['mark'])}")
    return lines


def section(name, case, source, stale):
    """The part of a case. `stale`: names of its runs whose case or material has changed since."""
    lines = [f"### {case['title']}", "", f"[cases/{name}](../../cases/{name})", ""]
    if case["overrides"]:
        lines += ["Departs from the one set of numerical parameters: "
                  + "; ".join(f"`{key}` ({reason})" for key, reason in case["overrides"].items()) + ".", ""]
    for reason in case["no_variants"]:
        lines += [reason, ""]
    for run in case["runs"]:
        if run["title"] or len(case["runs"]) > 1:
            lines += [f"**{run['title'] or run['name']}**" + (" (sensitivity)" if run["sensitivity"] else ""), ""]
        for reason in run["no_variants"]:
            lines += [reason, ""]
        if run["decided_by"]:
            lines += [f"The same experiment with finer cells decides: {run['decided_by']}.", ""]
        if run["name"] in stale:
            lines += ["**Not current: the case or a material has changed since.**", ""]
        lines += [f"    scripts/results.py {name}:{run['name']} --band --run", "", *table(run), "", *notes(run), "",
                  *provenance(run, source), ""]
    return lines


def body(results, source, stale):
    """All between the markers of the page."""
    lines = summary(results)
    for name, case in results["cases"].items():
        lines += section(name, case, source, {run for of, run in stale if of == name})
    return "\n".join(lines).strip("\n")


def as_text(results):
    """What the command prints."""
    lines = []
    for name, case in results["cases"].items():
        for run in case["runs"]:
            grids = ", ".join(f"{g} {grid_text(c)}" for g, c in run["cells"].items())
            moved = [v for v in run["records"] if v not in run["cells"]]
            lines.append(f"{name}:{run['name']} ({grids}{'; ' + ', '.join(moved) if moved else ''})")
            for q in run["quantities"]:
                unit = q["unit"]
                line = f"  {q['mark']:13} {q['name']}: {shown(q['value'], unit)}"
                if q["class"] != "identity":
                    line += (f" ± {shown(q['u_num'], unit, 2)} ({q['grid']}"
                             + (f", order {q['order']:.2g}" if q["grid"] == "converged" else "") + ")")
                lines.append(f"{line}, expected {expected(q)}")
    return "\n".join(lines)


def outdated(results, cases):
    """(case, run) whose case or material file has changed since; those of another source; cases whose expectations did."""
    stale, older, expectations = [], [], []
    source = digest_of_sources()
    for name, stored in results["cases"].items():
        case = next((case for case in cases if case.name == name), None)
        if case is None:
            stale += [(name, run["name"]) for run in stored["runs"]]
            continue
        if stored["expected"] != digest_of_file(case.path):
            expectations.append(name)
        runs = {run.name: run for run in case.runs}
        for run in stored["runs"]:
            if run["name"] not in runs or inputs_of(runs[run["name"]]) != run["inputs"]:
                stale.append((name, run["name"]))
            elif any(not is_same_program(record["source"], source) for record in run["records"].values()):
                older.append((name, run["name"]))
    return stale, older, expectations


def write(results, stale, source):
    """Renews the page between its markers."""
    old = PAGE.read_text()
    if not all(marker in old for marker in MARKERS):
        raise ValueError(f"{PAGE}: the markers of the generated part are missing")
    head, rest = old.split(MARKERS[0])
    _, tail = rest.split(MARKERS[1])
    PAGE.write_text(f"{head}{MARKERS[0]}\n\n{body(results, source, stale)}\n\n{MARKERS[1]}{tail}")


def written():
    """What is between the markers now."""
    text = PAGE.read_text()
    return text.split(MARKERS[0])[-1].split(MARKERS[1])[0].strip("\n")
