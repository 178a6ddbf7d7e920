#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Stale runs are found, departures from the numerical parameters need a reason, and drift is seen.

usage: results_provenance.py REPOSITORY
"""
import copy
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import types
from unittest import mock

ROOT = pathlib.Path(sys.argv[1]).resolve()
sys.path[:0] = [str(ROOT), str(ROOT / "scripts")]

import drift  # noqa: E402
from checks import require  # noqa: E402
from studies.validation import comparison, frozen_parameters, page, provenance, queue, store  # noqa: E402
from studies.validation.cases import Case, all_cases  # noqa: E402
from studies.validation.variants import variants_of  # noqa: E402


def changed(record, key, value):
    return {**copy.deepcopy(record), key: value}


def stale_runs_are_found():
    record = {"command": ["whipple", "run"], "case": "a", "materials": {"copper.toml": "b"}, "source": "c"}
    inputs = {"case": "a", "materials": {"copper.toml": "b"}}
    state = lambda r, command=("whipple", "run"): provenance.state(r, list(command), inputs, lambda source: source == "c")  # noqa: E731
    require(state(record) == provenance.CURRENT, "the same")
    require(state(None) == provenance.MISSING, "no record")
    require(state(record, ("whipple", "run", "--set")) == provenance.STALE, "another command")
    def set_to(value):
        return ["whipple", "run", "--set", f"body.0.velocity={value}"]
    bare = changed(record, "command", set_to("[0, 0, -150]"))
    require(state(bare, set_to("[0, 0, '-150 m/s']")) == provenance.CURRENT, "the same quantity with its unit")
    require(state(bare, set_to("[0, 0, '-0.15 km/s']")) == provenance.CURRENT, "the same quantity in another unit")
    require(state(bare, set_to("[0, 0, '-151 m/s']")) == provenance.STALE, "another quantity")
    require(state(changed(record, "case", "x")) == provenance.STALE, "another case")
    require(state(changed(record, "materials", {"copper.toml": "x"})) == provenance.STALE, "another material")
    require(state(changed(record, "source", "x")) == provenance.OLDER_SOURCE, "another source")


def digests_follow_the_files(work):
    folder = work / "case"
    folder.mkdir()
    (folder / "expected.toml").write_text('cell_size = { normal = "1 mm" }\n[[run]]\nname = "only"\n')
    (folder / "case.toml").write_text('[domain]\ncell_size = "1 mm"\n[[body]]\nmaterial = "own.toml"\n'
                                      '[[body]]\nmaterial = "copper.toml"\n')
    (folder / "own.toml").write_text("density = 1")
    run = Case(folder / "expected.toml").runs[0]
    before = provenance.inputs_of(run)
    require(set(before["materials"]) == {"own.toml", "copper.toml"} and all(before["materials"].values()), str(before))
    (folder / "own.toml").write_text("source = 'a book'\ndensity = 1  # said again")
    provenance.digest_of_toml.cache_clear()
    require(provenance.inputs_of(run) == before, "comments and sources do not count")
    (folder / "own.toml").write_text("density = 2")
    provenance.digest_of_toml.cache_clear()
    after = provenance.inputs_of(run)
    require(after["case"] == before["case"] and after["materials"]["own.toml"] != before["materials"]["own.toml"]
            and after["materials"]["copper.toml"] == before["materials"]["copper.toml"], f"{before}, {after}")
    stored = {"cases": {"case": {"expected": "x", "runs": [
        {"name": "only", "inputs": before, "records": {}}, {"name": "gone", "inputs": before, "records": {}}]}}}
    stale, older, expectations = page.outdated(stored, [run.case])
    require(stale == [("case", "only"), ("case", "gone")] and not older and not expectations, str(stale))
    entry = {"name": "only", "inputs": after, "records": {"normal": {"source": "another"}}, "quantities": []}
    stored["cases"]["case"]["runs"] = [entry]
    stale, older, expectations = page.outdated(stored, [run.case])
    require(not stale and older == [("case", "only")] and not expectations, f"{stale}, {older}, {expectations}")
    entry["quantities"] = [{"name": "x", "measure": "x", "asked": "", "class": "exact", "kind": "within", "expected": 1.0, "tolerance": 0.1}]
    require(page.outdated(stored, [run.case])[2] == [("case", "only")], "a quantity that is expected no more")

    def digest():
        provenance.digest_of_sources.cache_clear()
        return provenance.digest_of_sources(work)

    solver, page_of_runs = work / "src" / "solver", work / "src" / "monitor"
    for folder in (solver, page_of_runs):
        folder.mkdir(parents=True)
    (solver / "a.cpp").write_text('int a;  // a number\nauto b = "// c";\n')
    first = digest()
    (solver / "note.md").write_text("no code")
    require(digest() == first, "what is no code does not count")
    (page_of_runs / "a.cpp").write_text("int a;")
    require(digest() == first, "what computes nothing does not count")
    (solver / "a.cpp").write_text('/* of a run */ int a;\n\nauto b = "// c";')
    require(digest() == first, "comments and layout do not count")
    (solver / "a.cpp").write_text('int a;\nauto b = "// d";')
    require(digest() != first, "what is no comment counts")
    (solver / "a.cpp").write_text('int b;\nauto b = "// c";')
    require(digest() != first, "code counts")


def programs_that_compute_the_same_keep_tables_current(work):
    original = provenance.SAME_RESULTS
    provenance.SAME_RESULTS = work / "same_results.json"
    require(provenance.is_same_program("a", "a") and not provenance.is_same_program("a", "b"), "nothing is noted")
    provenance.SAME_RESULTS.write_text('{"c": "b", "b": "a", "z": "y"}')
    for one, other, same in (("a", "c", True), ("b", "c", True), ("a", "z", False), ("z", "y", True)):
        require(provenance.is_same_program(one, other) is same and provenance.is_same_program(other, one) is same,
                f"{one}, {other}")
    provenance.SAME_RESULTS = original
    former = next(iter(provenance.FORMER_PIECES))
    run = next(run for case in all_cases() if case.name == "two_spheres" for run in case.runs)
    pieces = next(run for case in all_cases() if case.name == "ring_expansion" for run in case.runs)
    require(provenance.is_current(former, former, pieces) and provenance.is_current(former, former, run), "the same program")
    provenance.SAME_RESULTS = work / "later.json"
    provenance.SAME_RESULTS.write_text(f'{{"later": "{former}"}}')
    require(provenance.is_current(former, "later", run), "what measures no pieces stays current")
    require(not provenance.is_current(former, "later", pieces), "pieces are defined otherwise")
    require(provenance.is_current("later", "later", pieces), "and now as they are")
    provenance.SAME_RESULTS = original
    if (ROOT / ".git").exists():
        digest = provenance.digest_of_revision("HEAD")
        require(re.fullmatch("[0-9a-f]{16}", digest), digest)
        revision = provenance.git("rev-parse", "--short=12", "HEAD")
        for word, source in ((revision, digest), (f"{revision}+changes", provenance.digest_of_sources()),
                             ("0123456789ab", "built from 0123456789ab")):
            fake = work / f"whipple_{word}"
            fake.write_text(f"#!/bin/sh\necho 'whipple 0.1.0 (revision {word})'\n")
            fake.chmod(0o755)
            require(provenance.source_of(str(fake)) == source, f"{word}: {provenance.source_of(str(fake))}, not {source}")
        require(provenance.is_same_program(f"built from {revision}", digest), "a source that is named by its revision")


def only_runs_of_one_program_make_a_band():
    def record(source):
        return {"source": source}
    mixed = {"coarse": record("a"), "normal": record("a"), "fine": record("b"), "offset_1": record("a")}
    require(set(comparison.comparable(mixed)) == {"coarse", "normal", "offset_1"}, str(comparison.comparable(mixed)))
    require(comparison.comparable({}) == [], "nothing was run")
    require(comparison.comparable({"coarse": record("a"), "fine": record("b")}) == ["fine"], "of equal ones the finest")
    here = provenance.digest_of_sources()
    require(comparison.comparable({"coarse": record("a"), "normal": record(here)}) == ["normal"], "the present program decides")


def input_brackets_are_of_one_program():
    """A change by the input counts where both runs are of one program, on a grid that counts."""
    class Measured:
        def __init__(self, value):
            self.value = lambda _: value
    run = types.SimpleNamespace(expectations=["x"], input=["other"])
    values = {"normal": Measured(1.0), "fine": Measured(2.0)}
    records = {"normal": {"source": "a"}, "fine": {"source": "b"}}
    others = {"normal": Measured(1.5), "fine": Measured(5.0)}
    change = lambda used, sources: comparison.input_change(  # noqa: E731
        run, values, records, used, {"other": (others, {name: {"source": source} for name, source in sources.items()})})[0]
    require(change(["normal", "fine"], {"normal": "a", "fine": "b"}) == 3.0, "the finest of both")
    require(change(["normal"], {"normal": "a", "fine": "b"}) == 0.5, "a grid that is apart does not count")
    require(math.isnan(change(["normal", "fine"], {"normal": "c", "fine": "c"})), "two programs")


def pages_are_what_is_stored(work):
    """A row too many, another count, a page of no case: each is seen; the remarks on age are no difference."""
    results = store.load()
    texts = page.pages(results, "", set())
    folder = work / "results"
    folder.mkdir()
    with mock.patch.object(page, "FOLDER", folder), mock.patch.object(page, "OVERVIEW", work / "results.md"):
        page.write(results, [(name, run["name"]) for name, case in results["cases"].items() for run in case["runs"]], "later")
        require(len(texts) == len(list(folder.glob("*.md"))) + 1 and not page.unlike(results), str(page.unlike(results)[:2]))
        overview = (work / "results.md").read_text()
        for other in (overview.replace("agree", "are right", 1), overview + "| a row | more |\n"):
            (work / "results.md").write_text(other)
            require(page.unlike(results), "another overview")
        (work / "results.md").write_text(overview)
        (folder / "no_case.md").write_text("# x\n")
        require([path.name for path, _ in page.unlike(results)] == ["no_case.md"], "a page of no case")


def departures_need_a_reason(work):
    parameters = frozen_parameters.defaults()
    for key, value in (("time.courant", "0.5"), ("contact.method", '"auto"'), ("body.discretization.per_cell", "8"),
                       ("artificial_viscosity.quadratic", "1.0"), ("transfer.kappa", "0.2")):
        require(parameters.get(key) == value, f"{key} = {parameters.get(key)}")
    for key in ("time.end", "domain.cell_size", "gravity.acceleration", "body.velocity", "output.fields"):
        require(key not in parameters, f"{key} is not numerical")
    other = parameters | {"time.courant": "0.4"}
    require(frozen_parameters.added_since(frozen_parameters.digest(parameters), parameters) == (), "the present set")
    require(frozen_parameters.added_since(frozen_parameters.digest(other), parameters) is None, "a set with another value")
    for name, keys in frozen_parameters.ADDED.items():
        require(frozen_parameters.added_since(name, parameters) == keys, f"{name} is no longer the set without {keys}")
    require(frozen_parameters.digest(parameters) != frozen_parameters.digest(other), "digest")

    folder = work / "tuned"
    folder.mkdir()
    domain, body = '[domain]\ncell_size = "1 mm"\n', '[[body]]\nname = "a"\n'
    (folder / "case.toml").write_text(f"{domain}[artificial_viscosity]\nquadratic = 3\n{body}")

    def wrong(head="", run=""):
        (folder / "expected.toml").write_text(f'cell_size = {{ normal = "1 mm" }}\n{head}\n[[run]]\nname = "only"\n{run}\n')
        return frozen_parameters.check([Case(folder / "expected.toml")], parameters)

    reason = '[overrides]\n"artificial_viscosity.quadratic" = "because"\n'
    require(len(wrong()) == 1 and "quadratic = 3" in wrong()[0], str(wrong()))
    require(not wrong(reason), "a reason allows it")
    per_cell = 'set = ["body.0.discretization.per_cell=27"]'
    require(len(wrong(reason, per_cell)) == 1, "assignments of a run count")
    require(not wrong(reason, f"{per_cell}\nsensitivity = true"), "but not of a run for sensitivity")
    require(not wrong(reason + '"body.discretization.per_cell" = "because"', per_cell), "a reason for all bodies")
    require(len(wrong(reason + '"time.courant" = "because"')) == 1, "a reason without a departure")
    (folder / "case.toml").write_text(f"{domain}[time]\ncourant = 0.5\n{body}")
    repeated = wrong('[overrides]\n"time.courant" = "because"')
    require(any("repeats the default" in text for text in repeated), "a default repeated")


def drift_is_seen():
    new = {"mass": 2.0, "internal_energy": 10.0, "total_energy": 100.0, "mass_vapour": 0.0, "steps": 100.0}
    perturbed = new | {"internal_energy": 10.01, "mass_vapour": 1e-9}
    old = drift.tolerances(new, perturbed)
    require(abs(old["internal_energy"]["tolerance"] - 1e-2) < 1e-12, str(old))
    require(old["steps"]["tolerance"] == drift.LEAST and old["mass_vapour"]["tolerance"] == drift.LEAST, str(old))
    require(not drift.drifted(old, new) and not drift.drifted(old, perturbed), "the same, and the perturbed one")
    for name, value in (("internal_energy", 10.2), ("mass_vapour", 1e-5), ("steps", 101.0), ("mass", float("nan"))):
        rows = drift.drifted(old, new | {name: value})
        require([row[0] for row in rows] == [name], f"{name} = {value}: {rows}")
    altered = copy.deepcopy(old)
    altered["internal_energy"]["value"] *= 1.02
    rows = drift.drifted(altered, new)
    require([row[0] for row in rows] == ["internal_energy"] and "10.2" in drift.table("case", rows), "an altered baseline")
    # A component that vanishes by symmetry is compared with the largest, not with its own round-off.
    vector = {"spin_x": 1e-18, "spin_y": 0.5, "spin_z": -0.5}
    stored = drift.tolerances(vector, vector | {"spin_x": -3e-18})
    require(stored["spin_x"]["tolerance"] == drift.LEAST, str(stored))
    require(not drift.drifted(stored, vector | {"spin_x": 9e-17}), "round-off")
    for name, value in (("spin_x", 1e-6), ("spin_y", 0.501)):
        require([row[0] for row in drift.drifted(stored, vector | {name: value})] == [name], f"{name} = {value}")
    less = {name: value for name, value in new.items() if name != "mass"}
    require([row[0] for row in drift.drifted(old, less)] == ["mass"], "a lost number")
    require([row[0] for row in drift.drifted(old, new | {"more": 1.0})] == ["more"], "a new number")
    require(tomllib.loads(drift.as_toml({"case": old}))["case"]["mass"] == old["mass"], "written and read")
    require(set(drift.baseline()) == {case["name"] for case in drift.cases()}, "every case of the gate has its numbers")


def stored_variants_count_beside_new_ones():
    """A run of one grid in a fresh checkout does not lose the other grids that the tables know."""
    case = next(case for case in all_cases() if case.name == "two_spheres")
    run = next(run for run in case.runs if run.name == "multi_field")
    entry = next(e for e in store.load()["cases"]["two_spheres"]["runs"] if e["name"] == run.name)
    measures, records = comparison.stored_variants(run, entry)
    require(set(records) == set(entry["records"]) == set(measures), f"{sorted(records)} of {sorted(entry['records'])}")
    quantity = entry["quantities"][0]
    expectation = next(e for e in run.expectations if e.name == quantity["name"])
    for name, value in quantity["values"].items():
        require(measures[name].value(expectation) == value, f"{name}: {measures[name].value(expectation)}, stored {value}")
    other = copy.deepcopy(entry)
    other["inputs"]["case"] = "another"
    require(comparison.stored_variants(run, other) == ({}, {}), "a stored run of another case")
    other = copy.deepcopy(entry)
    other["records"]["coarse"]["cell_size"] = "3 mm"
    require("coarse" not in comparison.stored_variants(run, other)[1], "a grid that is no longer asked for")


def marks_of_stored_runs_follow_their_expectations():
    """What is not here keeps its values, and is compared with what is expected now."""
    case = next(case for case in all_cases() if case.name == "two_spheres")
    run = next(run for run in case.runs if run.name == "multi_field")
    entry = next(e for e in store.load()["cases"]["two_spheres"]["runs"] if e["name"] == run.name)
    collected = {run.name: comparison.stored_variants(run, entry)}
    require(comparison.run_study(case, run, collected) is None, "nothing was run, nothing is stored")
    same = comparison.run_study(case, run, collected, entry)
    require(same == entry, f"renewed without a change: {same}")
    expectation = next(e for e in run.expectations if e.kind == "within" and e.origin != "identity")
    former = next(q for q in entry["quantities"] if q["name"] == expectation.name)
    expectation.value = former["value"] + 10 * (former["u_num"] + expectation.tolerance)
    renewed = next(q for q in comparison.run_study(case, run, collected, entry)["quantities"] if q["name"] == expectation.name)
    require(renewed["values"] == former["values"] and renewed["mark"] == "differs", str(renewed))
    expectation.value = former["expected"]
    for key, value in (("time", 1e-6), ("place", 1e-3), ("travel", 1e-3), ("speed", 1.0), ("fraction", 0.5)):
        with mock.patch.object(expectation, key, value):
            require(not comparison.can_be_renewed(entry, run, entry["records"]), f"measured with another {key}")
            require(page.compared(entry) != page.expected_now(run), f"expected with another {key}")
    for key, value in (("set", ["time.end=1 us"]), ("set_at", {"fine": ["time.end=1 us"]}), ("analyse", ["--axis", "x"])):
        with mock.patch.object(run, key, value):
            require(comparison.stored_variants(run, entry) == ({}, {}), f"a stored run with another {key}")
            require(not queue.is_stored(entry, run, variants_of(run, band=False)[0], entry["records"]["coarse"]["source"]), key)
    with mock.patch.object(run, "cell_size", run.cell_size | {"fine": "0.9 mm"}):
        bands = comparison.with_bands_of_one_program(run, entry)["quantities"]
        require(bands == entry["quantities"], "bands are those of the cells that were computed")
    expectation.measure = "never_measured"
    kept = comparison.run_study(case, run, collected, entry)
    require([q["name"] for q in kept["quantities"]] == [q["name"] for q in entry["quantities"]],
            "what was never measured needs a run")


def the_repository_is_in_order():
    wrong = frozen_parameters.check(all_cases(), frozen_parameters.defaults())
    require(not wrong, "\n".join(wrong))
    done = subprocess.run([sys.executable, str(ROOT / "scripts" / "results.py"), "--check-fresh"], capture_output=True,
                          text=True)
    require(done.returncode == 0, f"docs/generated/results:\n{done.stdout}{done.stderr}")


with tempfile.TemporaryDirectory() as name:
    stale_runs_are_found()
    digests_follow_the_files(pathlib.Path(name))
    programs_that_compute_the_same_keep_tables_current(pathlib.Path(name))
    only_runs_of_one_program_make_a_band()
    input_brackets_are_of_one_program()
    pages_are_what_is_stored(pathlib.Path(name))
    departures_need_a_reason(pathlib.Path(name))
    drift_is_seen()
    stored_variants_count_beside_new_ones()
    marks_of_stored_runs_follow_their_expectations()
    the_repository_is_in_order()
print("records, parameters and drift: all checks passed")
