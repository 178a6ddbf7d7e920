#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""expected.toml of every case can be read, and comparisons say what they should.

usage: results_expectations.py REPOSITORY WHIPPLE
"""
import contextlib
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT, WHIPPLE = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path.insert(0, str(ROOT))

from checks import require  # noqa: E402
from report import measured, sensitivity  # noqa: E402
from studies.validation import comparison, execution, page, provenance, variants  # noqa: E402
from report.expectations import KIND_OF_UNIT  # noqa: E402
from studies.validation.cases import UNITS, BadExpectation, Case, Expectation, apply  # noqa: E402


def every_case_is_understood():
    files = sorted((ROOT / "cases").glob("*/expected.toml"))
    require(len(files) >= 15, f"{len(files)} cases")
    for path in files:
        case = Case(path)
        require(case.file.is_file() and (path.parent / "README.md").is_file(), f"{case.name}: case.toml and README.md")
        require(len({run.name for run in case.runs}) == len(case.runs), f"{case.name}: two runs of one name")
        for run in case.runs:
            require(run.expectations, f"{case.name}:{run.name} expects nothing")
            sizes = [run.cells(resolution) for resolution in run.grids()]
            require(not run.headline or all(a / b > 1.3 for a, b in zip(sizes, sizes[1:])),
                    f"{case.name}:{run.name}: cell sizes {sizes} too near to one another for an order")
            require(not run.headline or len(run.grids()) == 3, f"{case.name}:{run.name}: a headline has three grids")
            for resolution in run.cell_size:
                require(run.resolved(resolution)["domain"]["cell_size"] == run.cell_size[resolution], resolution)
            for name, path in provenance.material_files(run).items():
                require(path.is_file(), f"{case.name}:{run.name}: {name} is not found")
            found = variants.variants_of(run, band=True)
            require(len({v.name for v in found}) == len(found), "two variants of one name")
            for variant in found:
                require("{" not in "".join(variant.assignments), f"{case.name}: {variant.assignments}")


def units_are_those_of_the_program():
    """The factors of expected.toml, by which cases are read for their variants too, against `whipple units`."""
    kinds = {"m": "m", "cm": "m", "mm": "m", "um": "m", "s": "s", "ms": "s", "us": "s", "ns": "s", "m/s": "m/s",
             "km/s": "m/s", "kg": "kg", "g": "kg", "mg": "kg", "J": "J", "kJ": "J", "Pa": "Pa", "MPa": "Pa", "GPa": "Pa",
             "N": "N", "kN": "N", "MN": "N", "K": "K", "degree": "rad"}
    require(set(KIND_OF_UNIT) == set(UNITS), f"units without a kind: {set(UNITS) ^ set(KIND_OF_UNIT)}")
    for one in kinds:
        for other in kinds:
            require((kinds[one] == kinds[other]) == (KIND_OF_UNIT[one] == KIND_OF_UNIT[other]), f"{one} and {other}")
    require(set(UNITS) == {"", "1", "%", *kinds}, f"units without a kind: {set(UNITS) - set(kinds)}")
    for unit, si in kinds.items():
        done = subprocess.run([WHIPPLE, "units", f"1 {unit}", "--to", si], capture_output=True, text=True, check=True)
        factor = float(done.stdout.split()[0])
        require(abs(factor - UNITS[unit]) < 1e-12 * factor, f"1 {unit} is {done.stdout}, not {UNITS[unit]} {si}")


def expectation(**keys):
    origin = {} if keys.get("kind") == "record" else {"class": "exact"}
    return Expectation({"name": "n", "measure": "m", "source": "s", **origin, **keys}, "test")


def comparisons():
    within = expectation(value="14 mm", tolerance="1 mm")
    require(within.holds(0.0149) and not within.holds(0.0151) and not within.holds(math.nan), "within a length")
    percent = expectation(value="26.54 mm", tolerance="1 %")
    require(percent.holds(0.02680) and not percent.holds(0.02681), "within percent")
    require(expectation(value=0.95, kind="at_least").holds(0.95), "at least")
    require(not expectation(value=1e-10, kind="at_most").holds(2e-10), "at most")
    require(expectation(kind="record", unit="g").holds(1.0) is None, "recorded values are not compared")
    require(within.origin == "exact" and expectation(kind="record").origin == "record", "classes")


def is_refused(path, text, reason):
    """A case of this text is refused for this reason."""
    path.write_text(text)
    try:
        Case(path)
    except BadExpectation as error:
        require(reason in str(error), f"{reason!r} is not in {error}")
    else:
        require(False, f"passed: {text}")


def mistakes_are_named():
    for keys, reason in (({"value": "14 furlong", "tolerance": "1 mm"}, "14 furlong"), ({"value": "14 mm"}, "tolerance"),
                         ({"value": "1e mm", "tolerance": "1 mm"}, "1e mm"),
                         ({"value": 1, "tolerance": 1, "kind": "near"}, "near"), ({"valeu": 1}, "valeu"),
                         ({"kind": "record", "unit": "stone"}, "stone"),
                         ({"value": 1, "tolerance": 1, "measure": "jet_fraction.strip", "speed": "1 m/s"}, "time"),
                         ({"value": 1, "tolerance": 1, "class": "rumour"}, "rumour"),
                         ({"value": 1, "tolerance": 1, "class": "record"}, "record"),
                         ({"value": "14 mm", "tolerance": "1 us"}, "tolerance: '1 us' is a time, expected a length"),
                         ({"value": "14 mm", "tolerance": 1}, "tolerance: 1 is a number, expected a length"),
                         ({"value": 14, "tolerance": "1 mm"}, "tolerance: '1 mm' is a length, expected a number"),
                         ({"value": "14 mm", "tolerance": "-1 mm"}, "negative"),
                         ({"value": math.nan, "tolerance": 1}, "not finite"),
                         ({"value": 1, "tolerance": 1, "time": "5 mm"}, "time: '5 mm' is a length, expected a time"),
                         ({"value": 1, "tolerance": 1, "measure": "jet_speed.x", "fraction": "5 mm"}, "expected a number"),
                         ({"value": 1, "tolerance": 1, "measure": "wall_speed.x", "place": "5 us", "travel": "1 mm"},
                          "place: '5 us' is a time, expected a length")):
        try:
            expectation(**keys)
        except BadExpectation as error:
            require(reason in str(error), f"{reason!r} is not in {error}")
        else:
            require(False, f"{keys} passed")
    with tempfile.TemporaryDirectory() as name:
        path = pathlib.Path(name) / "expected.toml"
        for text, reason in (('cell_size = { norml = "1 mm" }', "norml"),
                             ('cell_size = { normal = "1 mm" }\nset_at.fien = []', "fien")):
            is_refused(path, f'{text}\n[[run]]\nname = "only"\n', reason)


EXPECTED = """
title = "Made up"
cell_size = { coarse = "2 mm", normal = "1 mm", fine = "0.5 mm" }
set_at.fine = ["time.courant=0.4"]
[band]
offsets = [
  ['domain.lower=[0, 0, "{-8 - 0.25 cell} mm"]'],
  ['domain.lower=[0, 0, "{-8 - 0.5 cell} mm"]'],
  ['domain.lower=[0, 0, "{-8 - 0.75 cell} mm"]'],
]
frame = [0, 0, "-0.5 km/s"]
[[run]]
name = "only"
headline = true
""" + "".join(f"""
[[run.quantity]]
name = "{measure} {time}"
measure = "{measure}"
{f'time = "{time}"' if time else ''}
value = {value}
tolerance = "5 %"
class = "{origin}"
{'kind = "at_most"' if origin == 'identity' else ''}
source = "made up"
known = "a reason"
""" for measure, time, value, origin in (
    ("depth", "", 3.0, "experiment"), ("depth", "15 us", 2.5, "exact"), ("mass.wall.debris", "", 9.0, "experiment"),
    ("nothing", "", 1.0, "experiment"), ("energy_error", "", 4e-3, "identity"), ("maximum_speed", "", 700.0, "exact")))
CASE = """
title = "Made up"
time = { end = "20 us" }
[domain]
lower = [0, 0, "-8 mm"]
upper = ["4 mm", "4 mm", "8 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry" }
[[body]]
name = "bullet"
material = "copper.toml"
velocity = [0, 0, "1 km/s"]
shape = { sphere = { center = [0, 0, "-2 mm"], radius = "2 mm" } }
[[body]]
name = "wall"
material = "own.toml"
shape = { box = { lower = [0, 0, 0], upper = ["4 mm", "4 mm", "1 mm"] } }
"""


def made_up_case(work):
    (work / "case").mkdir()
    (work / "case" / "expected.toml").write_text(EXPECTED)
    (work / "case" / "case.toml").write_text(CASE)
    (work / "case" / "own.toml").write_text("name = 'own'")
    return Case(work / "case" / "expected.toml")


def assignments_are_those_of_the_program():
    table = {"body": [{}, {}]}
    for text in ("body.1.shape.box.upper=[1, 2]", "time.end=10 us", "contact.gap_test=false", "body.0.material=a.toml"):
        apply(table, text)
    require(table == {"body": [{"material": "a.toml"}, {"shape": {"box": {"upper": [1, 2]}}}], "time": {"end": "10 us"},
                      "contact": {"gap_test": False}}, str(table))


def runs_begin_like_others(case):
    """What a run takes from another, and what stays its own; who decides an experiment."""
    own = """
[[run]]
name = "longer"
title = "longer"
like = "only"
decided_by = "only"
set = ["time.end=40 us"]
[[run]]
name = "longest"
like = "longer"
set = ["time.end=80 us"]
band = { no_offsets = "made up", no_frame = "made up" }
headline = true
cell_size = { coarse = "4 mm", normal = "2 mm" }
"""
    path = case.path.parent / "like.toml"
    path.write_text(EXPECTED + own)
    longest = Case(path).run_of("longest")
    require(longest.set == ["time.end=40 us", "time.end=80 us"] and longest.resolved()["time"]["end"] == "80 us", str(longest.set))
    require([q.name for q in longest.expectations] == [q.name for q in case.runs[0].expectations], "expectations")
    require(longest.grids() == ["coarse", "normal"] and not longest.decided_by, "its own cells and place")
    require(len(variants.variants_of(longest, band=True)) == 2 and comparison.reasons(longest.band)[0].endswith("made up."),
            "its own band")
    for text, reason in ((own.replace('like = "only"', 'like = "longest"'), "longest"),
                         (own.replace('decided_by = "only"', 'decided_by = "nobody"'), "nobody"),
                         (own.replace('name = "longest"', 'name = "longer"'), "two runs are named 'longer'")):
        is_refused(path, EXPECTED + text, reason)


def variants_are_complete(case):
    run = case.runs[0]
    found = {v.name: v for v in variants.variants_of(run, band=True)}
    require(list(found) == ["coarse", "normal", "fine", "offset_1", "offset_2", "offset_3", "frame"], str(list(found)))
    require(found["offset_3"].assignments == ['domain.lower=[0, 0, "-8.75 mm"]'], str(found["offset_3"]))
    require(found["frame"].assignments == [
        'body.0.velocity=[0, 0, "500 m/s"]', 'body.1.velocity=[0, 0, "-500 m/s"]', 'domain.lower=[0, 0, "-0.018 m"]',
        'domain.upper=["0.004 m", "0.004 m", "0.008 m"]'], str(found["frame"].assignments))
    require(run.assignments("fine") == ["domain.cell_size=0.5 mm", "time.courant=0.4"], "refined with the cells")
    try:
        variants.frame_assignments(run.resolved(), (1.0, 0.0, 0.0), "test")
    except BadExpectation as error:
        require("x_lower" in str(error), str(error))
    else:
        require(False, "a frame moves through a mirror plane")


def vectors_of_sections_are_turned():
    require(variants.as_simulated([1, 2, 3], {}) == [1, 2, 3], "three dimensions")
    require(variants.as_simulated([1, 2, 3], {"dimension": "axisymmetric", "axis": "z"}) == [3, 1, 2], "the axis is x")
    require(variants.as_simulated([1, 2, 3], {"dimension": "plane_strain"}) == [1, 2, 3], "x by default")
    require(variants.as_simulated([1, 2], {"dimension": "axisymmetric"}) == [1, 2], "two components")


def snapshots_go_back_to_rest(work):
    import h5py
    import numpy as np
    folder = work / "moving"
    folder.mkdir()
    (folder / "run.toml").write_text('[[body]]\nvelocity = ["0 m/s", "0 m/s", "500 m/s"]  # initial\n'
                                     "angular_velocity = [0, 0, 0]\n[[body]]\nvelocity = [0, 0, -500]\n")
    (folder / "a.particles.hdf.series").write_text('{"files": [{"name": "a.hdf", "time": 1e-5}]}')
    with h5py.File(folder / "a.hdf", "w") as file:
        file["VTKHDF/Points"] = np.array([[1.0, 2.0, 3.0]], dtype="f4")
        file["VTKHDF/PointData/velocity"] = np.array([[0.0, 0.0, 400.0]], dtype="f4")
    variants.back_to_rest(folder, (0.0, 0.0, -500.0), [[0, 0, 1000.0], [0, 0, 0]])
    with h5py.File(folder / "a.hdf") as file:
        require(np.allclose(file["VTKHDF/Points"][:], [[1.0, 2.0, 3.005]]), "positions")
        require(np.allclose(file["VTKHDF/PointData/velocity"][:], [[0.0, 0.0, 900.0]]), "velocities")
    text = (folder / "run.toml").read_text()
    require('velocity = [0, 0, "1000 m/s"]\nangular_velocity = [0, 0, 0]\n[[body]]\nvelocity = [0, 0, 0]' in text, text)


def write_run(folder, depth, mass, error):
    (folder / "report").mkdir(parents=True)
    (folder / "report" / "quantities.csv").write_text(f"quantity,value\ndepth,{depth}\nprojectile_size,4e-3\n")
    (folder / "report" / "series.csv").write_text("time [s],depth [m]\n0,1\n1e-05,2\n2e-05,3\n")
    (folder / "report" / "bodies.csv").write_text(f"body part,mass [kg]\nwall debris,{mass}\n")
    (folder / "history.csv").write_text(f"step,energy_error [1],maximum_speed [m/s]\n0,1e-3,500\n1,-{error},700\n")


def a_run_is_compared(case, work):
    """Three grids of first order, three positions and a frame; a mass that differs; an identity that breaks in one run."""
    run, measures, records = case.runs[0], {}, {}
    record = dict.fromkeys(comparison.RECORDED_KEYS, "-") | {"wall_time": 1.0, "dirty": False, "threads": 2}
    for i, variant in enumerate(variants.variants_of(run, band=True)):
        folder = work / variant.name
        depth = {"coarse": 3.08, "normal": 3.04, "fine": 3.02}.get(variant.name, 3.04 + 0.001 * i)
        write_run(folder, depth, 7.0, 5e-3 if variant.name == "offset_2" else 4e-3)
        measures[variant.name], records[variant.name] = execution.measures_of(folder, variant), record
    study = comparison.run_study(case, run, {"only": (measures, records)})
    marks = [q["mark"] for q in study["quantities"]]
    require(marks == ["agrees", "agrees", "differs", "not found", "broken", "agrees"], str(marks))
    depth, _, _, _, _, speed = study["quantities"]
    for key, value in (("order", 1.0), ("limit", 3.0), ("u_grid", 0.025)):
        require(abs(depth[key] - value) < 1e-6, f"{key}: {depth}")
    require(0.0 < depth["u_lattice"] < 0.02 and depth["u_num"] > depth["u_grid"], str(depth))
    require(speed["values"]["frame"] is None, "the greatest speed depends on the frame")
    for measure, moves in (("gauge.rear.velocity_z", True), ("history_error.rear.velocity_z", True), ("peak.rear.pressure", False),
                           ("gauge.rear.x", True), ("wall_speed.wall", True), ("front_velocity.wall", False)):
        require(measured.depends_on_frame(measure) == moves, measure)
    require(study["across"] == {"coarse": 2.0, "normal": 4.0, "fine": 8.0}, str(study["across"]))
    results = {"cases": {"made_up": {"title": case.title, "overrides": {}, "no_variants": [],
                                     "runs": [study]}}}
    def pages(stale):
        return "\n".join(page.pages(results, "-", stale).values())
    text = pages({("made_up", "only")})
    for words in ("| quantity | 2 mm | 1 mm | 0.5 mm | order | limit |", "**differs**", "Not current",
                  "scripts/results.py made_up:only --band --run", "## Experiments", "1 runs: 1 **differs**.", "0 of 1 hold",
                  "of 5 quantities 4 have three grids; 4 are converged",
                  f"of {len(records)} computations {len(records)} with the set - (**other values than now**)."):
        require(words in text, f"{words!r} is not in the page:\n{text}")
    study["decided_by"] = "finer"
    text = pages(set())
    require("Experiments" not in text and "finer cells decides: finer" in text, "another run stands for the experiment")
    study["decided_by"] = ""
    text = pages(set())
    require(text.count("a reason") == 2, "the cause is given where there is no agreement")
    found = comparison.sensitivities(results)
    require(found["fastest particle"][0]["cells"] == [4.0, 8.0], str(found))
    require(sensitivity.rows(found)[0][4:] == ["8", "1 of 1"], str(sensitivity.rows(found)))


with contextlib.ExitStack() as stack:
    every_case_is_understood()
    units_are_those_of_the_program()
    comparisons()
    mistakes_are_named()
    assignments_are_those_of_the_program()
    work = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
    made_up = made_up_case(work)
    variants_are_complete(made_up)
    runs_begin_like_others(made_up)
    vectors_of_sections_are_turned()
    snapshots_go_back_to_rest(work)
    a_run_is_compared(made_up, work)
print("expectations: all checks passed")
