# SPDX-License-Identifier: BSD-3-Clause
"""The stored results as text and as pages: docs/generated/results.md, an overview with one row per case, and
docs/generated/results/<case>.md. The pages are functions of the stored results and of the digest of the sources alone."""
import collections
import itertools
import math

from studies.validation import bands, frozen_parameters
from studies.validation.bands import clean
from studies.validation.cases import ROOT, UNITS
from studies.validation.provenance import asked_of, digest_of_sources, inputs_of, is_current, is_same_program
from studies.validation.store import FOLDER, write_if_changed

OVERVIEW = ROOT / "docs" / "generated" / "results.md"
SENSITIVITIES = ROOT / "report" / "grid_sensitivity.json"
CLASSES_OF_PHYSICS = {"experiment": "Experiments", "exact": "Exact solutions", "other code": "Other codes"}
INTRODUCTION = """# Results

Cases compared with experiments, exact solutions and other codes. Every number has an uncertainty band
([uncertainty](../theory/uncertainty.md)) and refers to the finest grid of those that one program computed; "not
converged" is not agreement, and a single grid is never converged. A run agrees if all of its quantities do; one that differs decides. All cases use one set of
numerical parameters. What was found, with the known causes of differences: [findings](../manual/findings.md). Equations
of state from atoms: [six metals](results_md.md). Written by `scripts/results.py --write`
([how](../manual/expected_results.md)).
"""
OLDER = " **Older source.**"
NOT_CURRENT = "**Not current: the case, a material or what is expected has changed since.**"
PROGRAMS = "**Programs**"
CHECKED = (bands.AGREES, bands.DIFFERS, bands.NOT_CONVERGED, bands.NOT_FOUND)
BOLD = (bands.DIFFERS, bands.NOT_FOUND, bands.BROKEN)


def shown(value, unit, digits=4):
    """A number in the unit of the expectation."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value / UNITS[unit]:.{digits}g}"
    return text if unit in ("", "1") else f"{text} {unit}"


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


def deciding(run):
    """Whether the verdict of a run counts: no study of sensitivity, and no finer section decides."""
    return not run["sensitivity"] and not run["decided_by"]


def verdicts(case, origin):
    """(run, verdict) of the runs of a case that are compared with this class of reference."""
    of_run = ((run, [q["mark"] for q in run["quantities"] if q["class"] == origin]) for run in case["runs"] if deciding(run))
    return [(run, verdict(marks)) for run, marks in of_run if marks]


def counted(marks):
    """3 agree, 2 **differ**"""
    plural = {bands.AGREES: "agree", bands.DIFFERS: "**differ**", bands.NOT_FOUND: "**not found**"}
    return ", ".join(f"{n} {marked(mark) if n == 1 else plural.get(mark, mark)}" for mark in CHECKED if (n := marks.count(mark)))


def figure(case, origin):
    """The quantity that shows best what a case says: compared with a value, of a headline, on most
    grids; with its band and what is expected."""
    found = [(q["kind"] == "within", run["headline"], len(run["cells"]), q) for run, _ in verdicts(case, origin) for q in run["quantities"]
             if q["class"] == origin and q["kind"] != "record" and q["value"] is not None]
    if not found:
        return "–"
    q = max(found, key=lambda entry: entry[:3])[3]
    return f"{q['name']} {shown(q['value'], q['unit'])} ± {shown(q['u_num'], q['unit'], 2)}, expected {expected(q)}"


def overview(results, source):
    """The page over all cases: one row per case and class of reference; convergence, identities, programs."""
    lines = [INTRODUCTION]
    for origin, heading in CLASSES_OF_PHYSICS.items():
        rows, marks = [], []
        for name, case in results["cases"].items():
            of_case = [mark for _, mark in verdicts(case, origin)]
            if of_case:
                marks += of_case
                rows.append(f"| [{case['title']}](results/{name}.md) | {counted(of_case)} | {figure(case, origin)} |")
        if rows:
            lines += [f"## {heading}", "", f"{len(marks)} runs: {counted(marks)}.", "",
                      "| case | runs | one of the quantities |", "| --- | --- | --- |", *rows, ""]
    runs = [run for case in results["cases"].values() for run in case["runs"]]
    studies = [q for run in runs if deciding(run) for q in physics(run)]
    converged = sum(q["grid"] in bands.CONVERGED for q in studies)
    three = sum(all(q["values"].get(name) is not None for name in ("coarse", "normal", "fine")) for q in studies)
    identities = [q["mark"] for run in runs for q in run["quantities"] if q["class"] == "identity"]
    lines += ["## All of them", "",
              f"**Convergence**: of {len(studies)} quantities {three} have three grids; {converged} are converged.", "",
              f"**Identities** (energy, momentum; true by construction of the scheme, no evidence of physics): "
              f"{identities.count(bands.HOLDS)} of {len(identities)} hold.", "", *programs(runs, source), *parameter_sets(runs)]
    others = [f"[{case['title']}](results/{name}.md)" for name, case in results["cases"].items()
              if not any(verdicts(case, origin) for origin in CLASSES_OF_PHYSICS)]
    if others:
        lines += [f"**Recorded without a comparison**: {'; '.join(others)}.", ""]
    return "\n".join(lines).strip("\n") + "\n"


def programs(runs, source):
    """How many computations are of the program of these sources."""
    records = [record for run in runs if deciding(run) for record in run["records"].values()]
    now = sum(is_same_program(record["source"], source) for record in records)
    return [f"{PROGRAMS}: of {len(records)} computations of the runs that decide {now} are of the present program, "
            f"{len(records) - now} of older ones (the page of a case says which).", ""] if records else []


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
    heads = ["quantity", *(grid_text(run["cells"][g]) + (" (apart)" if g in run["apart"] else "") for g in grids), "order", "limit", "U_grid", "U_lattice", "U_num",
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
        older = "" if is_same_program(of, source) else OLDER
        times = ", ".join(f"{name} {record['wall_time']:.0f} s on {record['threads']}" for name, record in entries)
        lines.append(f"Computed with {program}{' and changes' if entries[0][1]['dirty'] else ''}, source {of}, "
                     f"numerical parameters {entries[0][1]['frozen_set']}, case {run['inputs']['case']}, {processor}; "
                     f"{times}.{older}")
    return lines


def notes(run):
    """Sources and known causes, each said once."""
    lines, sources = [], {}
    if run["apart"]:
        lines.append(f"- Apart, as another program computed them: {', '.join(run['apart'])}; bands and marks are without them")
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


def finest(run):
    """The finest cells of those that one program computed."""
    counted_in = [size for name, size in run["cells"].items() if name not in run["apart"]]
    return counted_in[-1]


def verdict_table(case):
    """One row per run that is compared and class of reference."""
    rows = []
    for origin, heading in CLASSES_OF_PHYSICS.items():
        for run, of_run in verdicts(case, origin):
            marks = [q["mark"] for q in run["quantities"] if q["class"] == origin]
            rows.append(f"| {run['title'] or run['name']} | {heading.lower()} | {grid_text(finest(run))} | "
                        + " | ".join(str(marks.count(mark)) for mark in CHECKED[:3]) + f" | {marked(of_run)} |")
    heads = ["| run | compared with | finest cells | quantities that agree | differ | not converged | all together |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    return [*heads, *rows, ""] if rows else []


def case_page(name, case, source, stale):
    """The page of a case. `stale`: names of its runs whose case or material has changed since."""
    lines = [f"# {case['title']}", "",
             f"Case: [cases/{name}](../../../cases/{name}). All cases: [results](../results.md); what the columns mean: "
             "[uncertainty](../../theory/uncertainty.md).", "", *verdict_table(case)]
    if case["overrides"]:
        lines += ["Departs from the one set of numerical parameters: "
                  + "; ".join(f"`{key}` ({reason})" for key, reason in case["overrides"].items()) + ".", ""]
    for reason in case["no_variants"]:
        lines += [reason, ""]
    for run in case["runs"]:
        lines += [f"## {run['title'] or run['name']}" + (" (sensitivity)" if run["sensitivity"] else ""), ""]
        for reason in run["no_variants"]:
            lines += [reason, ""]
        if run["decided_by"]:
            lines += [f"The same experiment with finer cells decides: {run['decided_by']}.", ""]
        if run["name"] in stale:
            lines += [NOT_CURRENT, ""]
        lines += [f"    scripts/results.py {name}:{run['name']} --band --run", "", *table(run), "", *notes(run), "",
                  *provenance(run, source), ""]
    return "\n".join(lines).strip("\n") + "\n"


def pages(results, source, stale):
    """All pages by path."""
    return {OVERVIEW: overview(results, source)} | {
        FOLDER / f"{name}.md": case_page(name, case, source, {run for of, run in stale if of == name})
        for name, case in results["cases"].items()}


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


def compared(entry):
    """What a stored run was compared with."""
    return [(q["name"], q["measure"], q["asked"], q["class"], q["kind"], q["expected"], q["tolerance"]) for q in entry["quantities"]]


def expected_now(run):
    """What a run is to be compared with."""
    return [(e.name, e.measure, asked_of(e), e.origin, e.kind, clean(e.value), clean(e.tolerance)) for e in run.expectations]


def outdated(results, cases):
    """(case, run) whose case or material file has changed since; those of another source; those whose expectations did."""
    stale, older, expectations = [], [], []
    source = digest_of_sources()
    for name, stored in results["cases"].items():
        case = next((case for case in cases if case.name == name), None)
        if case is None:
            stale += [(name, run["name"]) for run in stored["runs"]]
            continue
        runs = {run.name: run for run in case.runs}
        for run in stored["runs"]:
            if run["name"] not in runs or inputs_of(runs[run["name"]]) != run["inputs"]:
                stale.append((name, run["name"]))
                continue
            if any(not is_current(record["source"], source, runs[run["name"]]) for record in run["records"].values()):
                older.append((name, run["name"]))
            if compared(run) != expected_now(runs[run["name"]]):
                expectations.append((name, run["name"]))
    return stale, older, expectations


def write(results, stale, source):
    """Renew the pages that say something else than before; return their paths."""
    return [path for path, text in pages(results, source, stale).items() if write_if_changed(path, text)]


def lasting(text):
    """The lines of a page but for what says that sources, cases or expectations have changed since."""
    lines = (line.replace(OLDER, "") for line in text.split("\n"))
    return [line for line in lines if line and line != NOT_CURRENT and not line.startswith(PROGRAMS)]


def unlike(results):
    """Lines, with their page, that the stored results give and a page does not have, or the other way round."""
    found = []
    expected_pages = pages(results, "", set())
    for path, text in expected_pages.items():
        lines, written = lasting(text), lasting(path.read_text(encoding="utf-8")) if path.is_file() else []
        found += [(path, one or other) for one, other in itertools.zip_longest(lines, written) if one != other]
    found += [(path, "a page of no case") for path in sorted(FOLDER.glob("*.md")) if path not in expected_pages]
    return found
