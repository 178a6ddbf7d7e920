# SPDX-License-Identifier: BSD-3-Clause
"""From measured runs to numbers with bands: what docs/generated/results holds of a run."""
import copy
import math
import re
import types

from studies.validation import bands, execution, provenance
from studies.validation.bands import clean
from studies.validation.cases import quantity
from studies.validation.variants import variants_of

# Kinds of quantities whose dependence on the grid reports of single runs quote.
KINDS_OF_MEASURE = (("molten mass", r"melted"), ("vaporised mass", r"vaporised"), ("solid fraction", r"solid_fraction"),
                    ("speed of the front", r"front_speed|front_velocity|^front$"), ("fastest particle", r"maximum_speed"),
                    ("diameter of a hole", r"hole_diameter"), ("depth of a crater", r"crater_depth\."),
                    ("width of a crater", r"crater_radius|crater_diameter"),
                    ("largest fragment", r"fragment"), ("residual velocity", r"mean_velocity|residual_speed"),
                    ("final length", r"^length\.|residual_length"), ("diameter of a bar", r"foot_diameter|diameter_at"),
                    ("peak pressure", r"peak_pressure"), ("spall: pull-back and layer", r"pullback|spall_thickness"))


def known(value):
    return math.nan if value is None else value


def quantity_study(expectation, grids, samples, of_input):
    """Bands and mark of one quantity.

    grids: (cell size, value), samples: values at the normal grid over lattice positions and frames,
    of_input: largest change by the runs that bracket the input.
    """
    scatter = bands.scatter_band(samples) if len(samples) > 1 else math.nan
    study = bands.grid_study(grids, scatter)
    numerical = bands.together(study.band, scatter) if math.isfinite(study.band) else math.nan
    if expectation.kind == "record":
        mark, error, combined = bands.RECORDED, math.nan, math.nan
    elif expectation.kind == "within":
        mark, error, combined = bands.compare_within(study.value, expectation.value, expectation.tolerance, numerical,
                                                     of_input)
    else:
        mark, error, combined = bands.compare_bound(study.value, expectation.value, expectation.kind, numerical, of_input)
    return {"value": clean(study.value), "order": clean(study.order), "limit": clean(study.limit), "grid": study.state,
            "u_grid": clean(study.band), "u_lattice": clean(scatter), "u_num": clean(numerical), "u_input": clean(of_input),
            "error": clean(error), "u_val": clean(combined), "mark": mark}


def identity_study(expectation, values):
    """An identity holds if it holds in every run; there is nothing to converge."""
    found = [v for v in values if math.isfinite(v)]
    worst = max(found, key=abs) if found else math.nan
    mark = bands.NOT_FOUND if not found else (bands.HOLDS if all(expectation.holds(v) for v in found) else bands.BROKEN)
    return {"value": clean(worst), "mark": mark}


def input_change(run, values, records, used, collected):
    """Largest change of each quantity by the runs that bracket the input, at the finest grid that one program computed of both.

    used: names of the variants that count in the bands. collected: by name of run, from collect().
    """
    changes = []
    for expectation in run.expectations:
        found = [math.nan]
        for other in run.input:
            theirs, their_records = collected.get(other, ({}, {}))
            both = [r for r in reversed(GRIDS) if r in used and r in theirs
                    and provenance.is_same_program(records[r]["source"], their_records[r]["source"])]
            if both:
                found.append(abs(theirs[both[0]].value(expectation) - values[both[0]].value(expectation)))
        finite = [v for v in found if math.isfinite(v)]
        changes.append(max(finite) if finite else math.nan)
    return changes


class StoredMeasures:
    """What docs/generated/results knows of a variant whose folder is not here."""

    def __init__(self, entry, name):
        self.values = {(q["name"], q["measure"], q["asked"]): q["values"].get(name) for q in entry["quantities"]}
        self.projectile_size = math.nan

    def value(self, expectation):
        return known(self.values.get((expectation.name, expectation.measure, provenance.asked_of(expectation))))


def stored_variants(run, entry):
    """Measures and records of the variants of a stored run that belong to its present case and materials."""
    if entry is None or entry["inputs"] != provenance.inputs_of(run):
        return {}, {}
    names = [variant.name for variant in variants_of(run, band=True) + extra_grids(run)]
    records = {name: entry["records"][name] for name in names if name in entry["records"]
               and entry["records"][name]["cell_size"] == run.cell_size[name if name in run.cell_size else "normal"]}
    return {name: StoredMeasures(entry, name) for name in records}, records


def collect(case, run, entry=None):
    """Measures and records of the variants of a run that are there and not stale; of others, what is stored."""
    measures, records = stored_variants(run, entry)
    for variant in variants_of(run, band=True) + extra_grids(run):
        folder = execution.folder_of(case, run, variant)
        record, state = execution.state_of(case, run, variant, folder)
        if state in (provenance.CURRENT, provenance.OLDER_SOURCE):
            measures[variant.name] = execution.measures_of(folder, variant)
            records[variant.name] = record
    return measures, records


def extra_grids(run):
    """Grids that were not asked for, but may have been run: the finest of a run that is no headline."""
    asked = {variant.name for variant in variants_of(run, band=False)}
    return [execution.variant_named(run, r) for r in run.cell_size if r not in asked and
            run.cells(r) not in {run.cells(a) for a in asked}]


RECORDED_KEYS = ("revision", "dirty", "program", "executable", "source", "parameters", "frozen_set", "processor",
                 "machine", "threads", "wall_time", "cell_size", "variant")


def comparable(records):
    """Names of the variants that one program computed: of the one that computed most grids; of equal ones the present
    program, else that of the finest grid. Others say nothing about the dependence on the grid."""
    groups = []
    for name in records:
        group = next((g for g in groups if provenance.is_same_program(records[g[0]]["source"], records[name]["source"])), None)
        if group is None:
            groups.append([name])
        else:
            group.append(name)
    here = provenance.digest_of_sources()
    return max(groups, default=[], key=lambda group: (
        sum(name in GRIDS for name in group), provenance.is_same_program(records[group[0]]["source"], here),
        max((GRIDS.index(name) for name in group if name in GRIDS), default=-1)))


GRIDS = ("coarse", "normal", "fine")


def can_be_renewed(stored, run, records):
    """Whether a stored entry of a run has all that its expectations measure now, and nothing of it is of former grids."""
    known_measures = {(q["name"], q["measure"], q["asked"]) for q in stored["quantities"]}
    return bool(records) and records.keys() == stored["records"].keys() and all(
        (e.name, e.measure, provenance.asked_of(e)) in known_measures for e in run.expectations)


def with_bands_of_one_program(run, entry):
    """A stored entry that cannot be compared with what is expected now, with the bands of what one program computed."""
    entry = copy.deepcopy(entry)
    used = comparable(entry["records"])
    entry["apart"] = sorted(set(entry["records"]) - set(used))
    grids = [(name, quantity(size, run.name)[0]) for name, size in entry["cells"].items() if name in used]
    moved = [name for name in used if name not in GRIDS]
    for q in entry["quantities"]:
        if q["class"] == "identity":
            continue
        values = {name: known(value) for name, value in q["values"].items()}
        former = types.SimpleNamespace(kind=q["kind"], value=known(q["expected"]), tolerance=known(q["tolerance"]))
        samples = [values[name] for name in (["normal"] if "normal" in used else []) + moved]
        q.update(quantity_study(former, [(size, values[name]) for name, size in grids], samples if moved else [],
                                known(q.get("u_input"))))
    return entry


def run_study(case, run, collected, stored=None):
    """Return the stored entry of a run; None if nothing was run. `collected`: by name of run, from collect();
    `stored`: the entry as it is, whose marks are renewed if its variants are not here but all that is expected was measured.
    """
    measures, records = collected[run.name]
    if all(isinstance(of_run, StoredMeasures) for of_run in measures.values()) and not (
            stored and can_be_renewed(stored, run, records)):
        return with_bands_of_one_program(run, stored) if stored else None
    grids = [name for name in GRIDS if name in measures]
    used = comparable(records)
    moved = [name for name in used if name not in GRIDS]
    changes = input_change(run, measures, records, used, collected)
    rows = []
    for expectation, change in zip(run.expectations, changes):
        values = {name: of_run.value(expectation) for name, of_run in measures.items()}
        if expectation.origin == "identity":
            study = identity_study(expectation, values.values())
        else:
            samples = [values[name] for name in (["normal"] if "normal" in used else []) + moved]
            study = quantity_study(expectation, [(run.cells(name), values[name]) for name in grids if name in used],
                                   samples if moved else [], change)
        rows.append({"name": expectation.name, "measure": expectation.measure, "asked": provenance.asked_of(expectation),
                     "class": expectation.origin,
                     "kind": expectation.kind, "unit": expectation.unit, "expected": clean(expectation.value),
                     "tolerance": clean(expectation.tolerance), "source": expectation.source, "known": expectation.known,
                     "values": {name: clean(value) for name, value in values.items()}, **study})
    size = next((s for s in (measures[name].projectile_size for name in reversed(grids)) if math.isfinite(s)), math.nan)
    across = {name: round(size / run.cells(name), 1) for name in grids} if math.isfinite(size) else (stored or {}).get("across", {})
    return {"name": run.name, "title": run.title, "sensitivity": run.sensitivity, "headline": run.headline, "input": run.input,
            "decided_by": run.decided_by,
            "no_variants": [] if run.band is case.band else reasons(run.band),
            "cells": {name: run.cell_size[name] for name in grids},
            "across": across,
            "apart": sorted(set(records) - set(used)),
            "inputs": provenance.inputs_of(run), "quantities": rows,
            "records": {name: {key: record[key] for key in RECORDED_KEYS} for name, record in records.items()}}


def reasons(band):
    """Sentences that say which variants of the normal grid there are not, and why."""
    return [f"No {what}: {why}." for what, why in (("positions of the lattice", band.no_offsets),
                                                   ("moving frame", band.no_frame)) if why]


def case_study(case, runs, stored=None):
    """What docs/generated/results says of a case: the runs that are there. `stored`: by name of run, what it says now."""
    collected = {run.name: collect(case, run, (stored or {}).get(run.name)) for run in case.runs}
    studies = [run_study(case, run, collected, (stored or {}).get(run.name)) for run in runs]
    return {"title": case.title, "overrides": case.overrides,
            "no_variants": reasons(case.band) if case.band else ["No positions of the lattice or moving frame are declared."],
            "runs": [study for study in studies if study]}


def sensitivities(results):
    """Typical dependence on the grid by kind of quantity: for reports of single runs.

    Per kind the relative band of every converged or unconverged study, the change from the normal to the finest grid and
    the cells across the projectile of both.
    """
    rows = {}
    for name, case in results["cases"].items():
        for run in case["runs"]:
            grids = list(run["cells"])
            if run["sensitivity"] or len(grids) < 2 or not run["across"]:
                continue
            for q in run["quantities"]:
                kind = next((kind for kind, pattern in KINDS_OF_MEASURE if re.search(pattern, q["measure"])), None)
                fine, before, band = (q["values"][grids[-1]], q["values"][grids[-2]], q.get("u_num"))
                if kind is None or not fine or before is None or band is None:
                    continue
                rows.setdefault(kind, []).append(
                    {"case": f"{name}:{run['name']}", "quantity": q["name"],
                     "cells": [run["across"][g] for g in grids[-2:]], "change": abs(fine - before) / abs(fine), "band": band / abs(fine),
                     "converged": q["grid"] in bands.CONVERGED})
    return rows
