#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How often are ballistic limit equations right about measured shots on Whipple shields, and how often are runs?

Usage: python3 -m studies.shields.page [--whipple PROGRAM] [--outcomes FILE.csv] [--output PAGE.md]

Reads studies/shields/shots.csv with the critical diameters of `whipple shield --json`, the outcomes of runs
(studies/shields/outcomes.csv, written by studies/shields/run_shots.py) and the shots that were used to choose constants
(calibrating.csv), which no score of runs contains; models are compared on the shots that both have, and a model with itself where it was
repeated with other seeds and cells (REPEATS). Without outcomes it states the scores of the equations alone.
"""
import argparse
import csv
import dataclasses
import itertools
import json
import math
import pathlib
import sys

from studies import commands
from studies.shields import comparisons, scores
from studies.shields.scores import table

HERE = pathlib.Path(__file__).resolve().parent
EQUATIONS = {"nno_1993": "NNO (1993)", "nno_2001": "modified NNO (2001)", "jsc_2011": "thin bumpers (2011)"}
NEAR = 0.75, 4 / 3  # diameter over the critical one
SPEEDS = (0, 3, 4.5, 6, 7.5, 20)  # km/s
THICKNESSES = (0, 0.05, 0.1, 0.2, 0.4, 100)  # bumper over sphere
REFERENCE = "nno_1993"  # whose critical diameter says how far a shot is from the limit
DEFEATS = {"perforated", "detached spall"}
REPEATS = {"other places of the grains": "tile_seed_2.csv", "cells 1.23 times as large": "tile_coarser.csv",
           "cells 0.8 times as large": "tile_finer.csv"}  # of the model of tiles
NOTES = {"space": """With 8 cells across the sphere, two and a little more through the bumper. Normal shots: quarters of twenty that no outcome chose
(below), a comparison with sections. Oblique shots: halves of all near the limit that are resolved so with at most 700,000 particles, a rule
written before the first was computed (`python3 -m studies.shields.oblique`).""", "tile": """**The score of a model that was amended while it was scored** ([decision 25](../decisions/0025_grains_before_a_wall.md)), after 3 and
after 18 outcomes; its own rule makes those void, they were kept. 26 verdicts are of tiles, that of CR-915/E-44 is of a section.
All verdicts of tiles come from the speed of the rear half of the wall and a rule for its rim; a fit of that speed to the load, without
a tile, gives 27 of the 29 verdicts. The control, the same load as dust, is below: the grains decide the speed, but not as measured.
The speed follows the cells, and its error may be a factor of 2."""}  # what has to be known of the score of a model
SCORED = """Shots were chosen within a third of the limit of NNO (1993), which is a handicap for that equation above all."""
PICTURES = {"section": ["Pictures, in the order of the names (`python3 -m studies.shields.pictures`): half section of the wall at the outcome, mm, intact by",
                        "plastic strain from 0 to 0.5, failed (red), debris of other bodies (grey).", "",
                        *(f"![Unsafe misses, sheet {k}](../images/shield_misses_{k}.png)" for k in (1, 2, 3)), ""],
            "space": ["Oblique shots, likewise (`--only space`): the first cell behind the mirror plane, where the line of flight meets the wall.", "",
                      "![Unsafe misses, oblique](../images/shield_misses_oblique.png)", ""]}
REPEATED = """Chosen when the outcomes of all shots were known, by no rule written before; the two shots nearest to the line between held and
failed (Morrison_1972/SR-246, AFML-TR-70-135/U) have no repetition with other cells, and that of AFML-TR-68-257/2372 with cells 0.8 times
as large was started and stopped. All shots draw the places of their grains from the same seed: what another seed changes is an
error that they have in common, not the scatter between shots."""


@dataclasses.dataclass
class Run:
    """An outcome of outcomes.csv."""
    model: str  # section, space or tile
    outcome: str
    resolved: bool
    hours: float
    revision: str
    reason: str


@dataclasses.dataclass
class Shot:
    """A measured shot, what equations say, and the outcome of its run."""
    name: str
    failed: bool
    speed: float       # km/s
    angle: float       # rad
    thickness: float   # of the bumper over the diameter
    alloy: str         # of the wall
    sizes: dict        # diameter over the critical one, by equation
    runnable: bool
    resolved: bool     # of the case that would be made
    run: Run | None = None
    wall: float = math.nan     # its thickness over the diameter
    spacing: float = math.nan  # over the diameter
    sphere: str = ""           # its alloy

    def equation(self, name):
        return None if self.sizes[name] is None else self.sizes[name] > 1

    def is_near(self, name=REFERENCE):
        return self.sizes[name] is not None and NEAR[0] <= self.sizes[name] <= NEAR[1]

    def defeated(self):
        return None if self.run is None or self.run.outcome == "undecided" else self.run.outcome in DEFEATS

    def perforated(self):
        return None if self.defeated() is None else self.run.outcome == "perforated"


def read_csv(file):
    if not file.exists():
        return []
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return list(csv.DictReader(lines))


def shot_of(entry):
    diameter = entry["sphere"]["diameter"]
    limits = {name: entry["equations"][name]["critical_diameter"] for name in EQUATIONS}
    return Shot(name=f"{entry['source']}/{entry['name']}", failed=entry["result"] == "P",
                speed=entry["sphere"]["velocity"] / 1e3, angle=entry["sphere"]["angle"],
                thickness=entry["bumpers"][0]["thickness"] / diameter, alloy=entry["wall"]["alloy"],
                sizes={name: diameter / limit if limit else None for name, limit in limits.items()},
                runnable="refused" not in entry["case"], resolved=entry["case"].get("resolved", False),
                wall=entry["wall"]["thickness"] / diameter, spacing=entry["bumpers"][0]["spacing"] / diameter, sphere=entry["sphere"]["alloy"])


def read_shots(whipple, table):
    entries = json.loads(commands.call([whipple, "shield", table, "--model", "space", "--json", "--quiet"]).stdout)
    return [shot_of(entry) for entry in entries]


def by_model(shots, rows):
    """Shots by model, each with the last outcome by that model. Sections and space are never scored together: a fragment off the
    axis of a section is a ring. @throws SystemExit for a shot that the table does not have"""
    names = {shot.name for shot in shots}
    for row in rows:
        if row["shot"] not in names:
            sys.exit(f"outcomes of a shot that is not in the table: {row['shot']}")
    models = sorted({row["model"] for row in rows}) or ["space"]
    runs = {(row["model"], row["shot"]): Run(model=row["model"], outcome=row["outcome"], resolved=row["resolved"] == "yes",
                                             hours=float(row["core hours"]), revision=row["revision"], reason=row["reason"])
            for row in rows}
    return {model: [dataclasses.replace(shot, run=runs.get((model, shot.name))) for shot in shots] for model in models}


def equation_section(shots):
    groups = {"all": shots, "normal": [s for s in shots if s.angle == 0], "oblique": [s for s in shots if s.angle > 0]}
    rows = []
    for name, title in EQUATIONS.items():
        for group, members in [*groups.items(), ("normal, near", [s for s in groups["normal"] if s.is_near(name)])]:
            result = scores.confusion(members, lambda shot, name=name: shot.equation(name))
            rows.append([title, group, f"{result.right}/{result.count}", scores.percent(result.right, result.count),
                         result.unsafe, f"{100 * result.majority / result.count:.1f} %" if result.count else "-"])
    return ["## Equations", "", "Right predictions of P or NP with their interval of 95 %; unsafe: perforated or spalled, predicted to hold;",
            f"near: the sphere has {NEAR[0]} to {NEAR[1]:.2f} of the critical diameter of the same equation; majority: always the more frequent result.", "",
            *table(["equation", "shots", "right", "accuracy", "unsafe", "majority"], rows)]


def bands(edges, unit):
    return [(f"{low:g} to {high:g}{unit}", low, high) for low, high in zip(edges, edges[1:])]


def groups_of(scored):
    """Named groups of scored shots: all, near the limit, by speed, thickness of the bumper, alloy of the wall."""
    yield "all", scored
    yield "near the limit", [s for s in scored if s.is_near()]
    yield "normal", [s for s in scored if s.angle == 0]
    yield "oblique", [s for s in scored if s.angle > 0]
    for title, low, high in bands(SPEEDS, " km/s"):
        yield title, [s for s in scored if low <= s.speed < high]
    for title, low, high in bands(THICKNESSES, " bumper over sphere"):
        yield title, [s for s in scored if low <= s.thickness < high]
    for alloy in sorted({s.alloy for s in scored}):
        yield f"wall {alloy}", [s for s in scored if s.alloy == alloy]


def confusion_rows(scored, prediction):
    for title, members in groups_of(scored):
        result = scores.confusion(members, prediction)
        if result.count:
            yield [title, result.hit, result.unsafe, result.alarm, result.held, scores.percent(result.right, result.count)]


def paired_rows(scored):
    for group, members in (("all", scored), ("near the limit", [s for s in scored if s.is_near()])):
        for name, title in EQUATIONS.items():
            both, run, equation, neither = scores.paired(members, Shot.defeated, lambda shot, name=name: shot.equation(name))
            if both + run + equation + neither:
                yield [group, title, both, run, equation, neither, f"{scores.mcnemar(run, equation):.3g}"]


def run_section(model, shots, calibrating):
    runs = [s for s in shots if s.run is not None]
    left = [s for s in shots if s.run is None and s.runnable and s.resolved and s.name not in calibrating]
    scored = list(scored_by(shots, calibrating).values())
    lines = [f"## Runs: {model}", "",
             f"Of {len(shots)} shots {sum(s.runnable for s in shots)} have materials in the library and {sum(s.runnable and s.resolved for s in shots)} of "
             f"these are resolved (two cells through every sheet). Runs: {len(runs)}, of these {sum(s.name in calibrating for s in runs)} calibrating, "
             f"{sum(not s.run.resolved for s in runs)} not resolved, {sum(s.defeated() is None for s in runs)} undecided; scored: {len(scored)}. "
             f"Resolved shots without a run: {len(left)}, {sum(s.is_near() for s in left)} of them near the limit of {EQUATIONS[REFERENCE]}.", "",
             *([NOTES[model], ""] if model in NOTES else [])]
    if not scored:
        return [*lines, "**No shot has been scored: there is no accuracy of runs.**", ""]
    head = ["shots", "P, defeated", "P, held (unsafe)", "NP, defeated", "NP, held", "accuracy"]
    lines += [f"Scored revisions: {', '.join(sorted({s.run.revision for s in scored}))}.", "",
              "### Detached spall counts as defeat", "", *table(head, confusion_rows(scored, Shot.defeated)),
              "### Perforation alone counts", "", *table(head, confusion_rows(scored, Shot.perforated)),
              "### Beside the equations, on the same shots", "",
              f"p: two-sided probability of McNemar that equally good predictions differ so much. {SCORED}", "",
              *table(["shots", "equation", "both right", "run alone", "equation alone", "neither", "p"], paired_rows(scored))]
    unsafe = [s for s in scored if s.failed and not s.defeated()]
    lines += ["### Unsafe misses", ""]
    lines += table(["shot", "outcome", "reason", "core hours"], [[s.name, s.run.outcome, s.run.reason, f"{s.run.hours:.3g}"] for s in unsafe]) if unsafe else ["None.", ""]
    lines += PICTURES.get(model, []) if unsafe else []
    lines += comparisons.common_section(scored) if model == "section" else []
    undecided = [s for s in runs if s.defeated() is None]
    if undecided:
        lines += ["### Undecided", "", *table(["shot", "reason"], [[s.name, s.run.reason] for s in undecided])]
    hours = sorted(s.run.hours for s in runs)
    lines += ["### Cost", "", f"Core hours per run: {hours[0]:.2g} to {hours[-1]:.2g}, median {hours[len(hours) // 2]:.2g}, sum {sum(hours):.3g}.", ""]
    return lines


def scored_by(shots, calibrating):
    """Shots whose outcome by a model counts."""
    return {s.name: s for s in shots if s.run is not None and s.run.resolved and s.defeated() is not None and s.name not in calibrating}


def model_section(models, calibrating):
    """Models beside one another, on the shots that two of them have scored."""
    rows = []
    for first, second in itertools.combinations(models, 2):
        one, other = scored_by(models[first], calibrating), scored_by(models[second], calibrating)
        common = [one[name] for name in one if name in other]
        if common:
            both, alone, without, neither = scores.paired(common, Shot.defeated, lambda shot, other=other: other[shot.name].defeated())
            rows.append([f"{first}, {second}", both, alone, without, neither, f"{scores.mcnemar(alone, without):.3g}"])
    return ["## Models beside one another", "", *table(["models", "both right", "first alone", "second alone", "neither", "p"], rows)] if rows else []


def repeat_section(shots, repeats):
    """Outcomes of a model beside those of its repetitions. shots: of the model; repeats: rows of outcomes, by name."""
    first = {shot.name: shot.run for shot in shots if shot.run is not None}
    lines = []
    for title, rows in repeats.items():
        pairs = [(row["shot"], first[row["shot"]].outcome, row["outcome"]) for row in rows if row["shot"] in first]
        changed = [pair for pair in pairs if (pair[1] in DEFEATS) != (pair[2] in DEFEATS)]
        if pairs:
            lines += [f"### Tiles with {title}", "", f"Of {len(pairs)} shots {len(changed)} change between defeated and not.", "",
                      *table(["shot", "outcome", "repeated"], pairs)]
    return ["## Tiles repeated", "", REPEATED, "", *lines] if lines else []


def section_repeats(rows):
    """Verdicts of sections that were repeated. rows: of repeats.csv"""
    if not rows:
        return []
    counts, changed = [], []
    for variant in dict.fromkeys(row["variant"] for row in rows):
        members = [row for row in rows if row["variant"] == variant]
        decided = [row for row in members if row["outcome"] != "undecided"]
        other = [row for row in decided if (row["first"] in DEFEATS) != (row["outcome"] in DEFEATS)]
        words = [row for row in decided if row["first"] != row["outcome"]]
        same = sum(row["same bytes"] == "yes" for row in members)
        counts.append([variant, len(members), len(members) - len(decided), scores.percent(len(other), len(decided)), len(words),
                       f"{same} of {len(members)}" if any(row["same bytes"] for row in members) else "-"])
        changed += [[row["shot"], variant, row["first"], row["outcome"]] for row in words]
    return ["## Sections repeated", "",
            "Shots chosen by their place in the order of names alone (`studies/shields/repeats.py`): the lattice moved by a quarter of a cell along",
            "the flight, cells 0.8 times as large, two threads. Changed: between defeated (perforated, detached spall) and not, of those decided.",
            f"Repeated by {', '.join(sorted({row['revision'] for row in rows}))}, outcomes.csv by earlier revisions, whose programs give the same",
            "digits in the ten cases of `scripts/drift.py`.", "",
            *table(["repeated with", "shots", "undecided", "changed", "other word", "same bytes"], counts),
            *(table(["shot", "repeated with", "outcome", "repeated"], changed) if changed else ["No outcome has another word.", ""])]


def page(models, calibrating, repeats=None, of_sections=(), in_space=(), of_dust=(), of_clouds=(), of_foam=()):
    """Text of the page, of shots by model; repeats: rows of outcomes of tiles, by what is different; of_sections: rows of repeats.csv;
    in_space: of three_dimensions.csv; of_dust: of tile_control.csv; of_clouds: of clouds.csv; of_foam: of foam_outcomes.csv."""
    shots = next(iter(models.values()))
    named = [f"- {name}: {why}" for name, why in calibrating.items()]
    return "\n".join(["# Shields: predictions and shots", "",
                      "Written by `python3 -m studies.shields.page`. Shots and their sources: `studies/shields/shots.csv`; equations:",
                      "[theory](../theory/ballistic_limits.md); outcome of a run: [shields](../manual/shields.md).", "",
                      *equation_section(shots), *(line for model, members in models.items() for line in run_section(model, members, calibrating)),
                      *model_section(models, calibrating),
                      *comparisons.space_section(in_space, {s.name: s.run.outcome for s in models.get("section", []) if s.run}, {s.name: s.failed for s in shots}),
                      *comparisons.control_section(of_dust), *repeat_section(models.get("tile", []), repeats or {}), *section_repeats(of_sections),
                      *comparisons.cloud_section(of_clouds), *comparisons.panel_section(of_foam),
                      "## Calibrating shots", "", "In no score of runs:", "", *named, ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--whipple", default=commands.ROOT / "build" / "release" / "bin" / "whipple")
    parser.add_argument("--outcomes", type=pathlib.Path, default=HERE / "outcomes.csv")
    parser.add_argument("--output", type=pathlib.Path, default=commands.ROOT / "docs" / "generated" / "shields.md")
    arguments = parser.parse_args()
    shots = read_shots(arguments.whipple, HERE / "shots.csv")
    models = by_model(shots, read_csv(arguments.outcomes))
    calibrating = {row["shot"]: row["why"] for row in read_csv(HERE / "calibrating.csv")}
    text = page(models, calibrating, {title: read_csv(HERE / file) for title, file in REPEATS.items()},
                read_csv(HERE / "repeats.csv"), read_csv(HERE / "three_dimensions.csv"), read_csv(HERE / "tile_control.csv"), read_csv(HERE / "clouds.csv"),
                read_csv(HERE / "foam_outcomes.csv"))
    arguments.output.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
