# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the page about shields: three dimensions beside sections, what unsafe misses have in common, the control of tiles."""
import math
import statistics

from studies.shields import scores
from studies.shields.scores import table

DEFEATS = {"perforated", "detached spall"}
SIZES = {"speed": "speed, km/s", "thickness": "bumper over sphere", "wall": "wall over sphere", "spacing": "spacing over sphere"}
CLOSE = 11  # spacing over sphere, an edge that was read off the outcomes
KEPT = 0.1  # fraction of the thickness that both walls keep whose ratio is stated
SPACE = """Twenty scored shots, chosen by the SHA-256 of their names among those whose quarter has at most 200,000 particles with 8 cells
across the sphere and two through every sheet (`python3 -m studies.shields.three_dimensions`, the list was written before any was computed).
Quarter: three dimensions between two mirror planes; section: the same cells; section of the rule: of outcomes.csv, twice as many cells
through the bumper. Left: least fraction of the thickness that connected material keeps (on the axis), hole: diameter in mm."""
CLOUDS = """Spheres of 9.53 mm at 6.7 km/s (`python3 -m studies.shields.clouds piekutowski`): sections with GRAY, failed points keep a size; value in the
finest cells ± half of the range over cells and positions of the grid. Speeds over that of the impact, of what 0.1 % of the debris is ahead of or
behind; intact: mass of the sphere that has not failed; sizes: quantiles by mass over the diameter. Measured: the front flies about as fast as
the sphere (NASA CR-4707, within 5 % up to t/D = 0.17 in the cases); its tables of speeds and fragments are not at hand."""
MELTING = """Sphere of 3.175 mm, bumper of 0.787 mm (`python3 -m studies.shields.clouds melting`): mass fractions of the liquid, median size over the diameter."""
CONTROL = """The tile of the rule (seed 1) and the same mass, speed and delays as dust in the same cells (`python3 -m
studies.shields.tile_control`): with the mean load of the grains, which crowd in the middle of the tile, and uniform. The first shots
with a tile in the order of the SHA-256 of their names. Speed: of the rear half of the wall, which decides; over spread: over that of the
load spread over the wall; rim: distance in which the rim stops it over the thickness, failed from 1 on."""

PANELS = """All normal shots on half an inch of aluminium foam between equal sheets in the open data, chosen before any was computed
(`python3 -m studies.shields.foam_panels`). Struts: a quarter of random cells, mirrored, three seeds; layer: a section through a porous
material of the same density; none: the sheets alone. Verdict: of the majority; left: least fraction of the wall's thickness that
connected material keeps, by seed."""


def defeated(outcome):
    return None if outcome == "undecided" else outcome in DEFEATS


def number(text):
    return math.nan if text in ("", None) else float(text)


def ratio_text(values):
    """Median and range of ratios; "-" of nothing."""
    own = [value for value in values if math.isfinite(value)]
    return f"{statistics.median(own):.2f} ({min(own):.2f} to {max(own):.2f}, {len(own)} shots)" if own else "-"


def space_section(rows, of_rule, measured):
    """Three dimensions beside sections. rows: of three_dimensions.csv; of_rule: outcomes of sections by shot; measured: failed or not, by shot."""
    quarters = {row["shot"]: row for row in rows if row["model"] == "space"}
    sections = {row["shot"]: row for row in rows if row["model"] == "section"}
    both = [name for name in quarters if name in sections]
    if not both:
        return []
    counts = []
    for title, other in (("section, same cells", {name: sections[name]["outcome"] for name in both}), ("section of the rule", of_rule)):
        pairs = [(quarters[name]["outcome"], other[name], measured[name]) for name in both
                 if defeated(quarters[name]["outcome"]) is not None and defeated(other[name]) is not None]
        alike = sum(defeated(a) == defeated(b) for a, b, _ in pairs)
        right = sum(defeated(a) == failed for a, _, failed in pairs), sum(defeated(b) == failed for _, b, failed in pairs)
        alone = sum(defeated(a) == failed != defeated(b) for a, b, failed in pairs), sum(defeated(b) == failed != defeated(a) for a, b, failed in pairs)
        counts.append([title, len(pairs), scores.percent(alike, len(pairs)), sum(a == b for a, b, _ in pairs), *right, f"{scores.mcnemar(*alone):.2g}"])
    coarse = [(sections[name]["outcome"], of_rule[name]) for name in both if None not in (defeated(sections[name]["outcome"]), defeated(of_rule[name]))]
    moved = sum(defeated(a) != defeated(b) for a, b in coarse)
    left = [number(quarters[name]["left"]) / number(sections[name]["left"]) for name in both
            if number(quarters[name]["left"]) > KEPT and number(sections[name]["left"]) > KEPT]
    hole = [number(quarters[name]["hole [mm]"]) / number(sections[name]["hole [mm]"]) for name in both]
    seconds = [(number(quarters[name]["seconds"]), number(sections[name]["seconds"])) for name in both]
    lines = ["## Three dimensions beside sections", "", SPACE, "",
             *table(["beside", "decided by both", "same verdict", "same word", "quarter right", "section right", "p"], counts),
             f"Sections in these cells and in those of the rule: {moved} of {len(coarse)} verdicts differ.",
             f"Quarter over section in the same cells: left {ratio_text(left)}, of walls that keep a tenth in both; hole {ratio_text(hole)}. Cost: "
             f"{sum(a for a, _ in seconds) / 3600:.2g} and {sum(b for _, b in seconds) / 3600:.2g} core hours in all, "
             f"{statistics.median(a / b for a, b in seconds):.0f} times as much per shot (median).", ""]
    body = []
    for name in both:
        own, other = quarters[name], sections[name]
        body.append([name, "P" if measured[name] else "NP", of_rule.get(name, "-"), other["outcome"], own["outcome"],
                     *(f"{row['left'] or '-'} ({row['left on the axis'] or '-'})" for row in (other, own)),
                     f"{other['hole [mm]'] or '-'}, {own['hole [mm]'] or '-'}",
                     *(f"{row['particles']}, {row['steps']}, {number(row['seconds']):.0f}" for row in (other, own))])
    return lines + table(["shot", "measured", "section of the rule", "section", "quarter", "left, section", "left, quarter", "holes",
                          "section: particles, steps, s", "quarter: particles, steps, s"], body)


def common_section(scored):
    """What the misses of scored shots have in common: tables of two by two, shots above the median of a ratio or of one alloy beside the others."""
    groups = [(f"{title} above {{:.3g}}", name) for name, title in SIZES.items()]
    rows = []
    for measured, right, wrong in ((True, "found", "unsafe"), (False, "held", "called failed")):
        own = [shot for shot in scored if shot.failed == measured]
        if not own:
            continue
        tests = []
        for title, name in groups:
            edge = statistics.median(getattr(shot, name) for shot in own)
            tests.append((title.format(edge), lambda shot, name=name, edge=edge: getattr(shot, name) > edge))
        for kind in ("alloy", "sphere"):
            for alloy in sorted({getattr(shot, kind) for shot in own}):
                if sum(getattr(shot, kind) == alloy for shot in own) >= 5:
                    tests.append((f"{'wall' if kind == 'alloy' else 'sphere'} of {alloy}", lambda shot, kind=kind, alloy=alloy: getattr(shot, kind) == alloy))
        for title, within in tests:
            numbers = [sum(within(shot) == inside and (shot.defeated() == shot.failed) == alike for shot in own)
                       for inside in (True, False) for alike in (True, False)]
            p = scores.fisher(*numbers)
            rows.append([f"{right} or {wrong}", title, f"{numbers[0]}, {numbers[1]}", f"{numbers[2]}, {numbers[3]}", f"{p:.2g}", f"{min(1.0, p * len(tests)):.2g}"])
    near = [shot for shot in scored if shot.spacing <= CLOSE]
    called, other = sum(shot.defeated() for shot in near), sum(shot.defeated() for shot in scored) - sum(shot.defeated() for shot in near)
    failed = sum(shot.failed for shot in near), sum(shot.failed for shot in scored) - sum(shot.failed for shot in near)
    sorted_by = [[title, *(f"{scores.separation([-getattr(shot, name) for shot in scored], [answer(shot) for shot in scored]):.2f}"
                           for answer in (lambda shot: shot.defeated(), lambda shot: shot.failed))] for name, title in SIZES.items()]
    return ["### What misses have in common", "",
            "Right and wrong shots in the group and out of it; edges are medians of the shots with that result, alloys those of five shots or more, so",
            "that no edge is chosen by an outcome. p: exact test of Fisher; corrected: times the number of groups (Bonferroni).", "",
            *table(["right or wrong", "group", "in it", "out of it", "p", "corrected"], rows),
            f"**The spacing decides**: of {len(near)} shots with at most {CLOSE} diameters between the sheets {called} are called failed ({failed[0]} failed), of",
            f"{len(scored) - len(near)} with more {other} ({failed[1]} failed). This edge was read off the outcomes, in a gap of the spacings.", "",
            "How well one number alone sorts the shots: probability that a shot that fails has less of it than one that holds (0.5: nothing).", "",
            *table(["less", "fails in the run", "failed"], sorted_by)]


def control_section(rows):
    """Tiles struck by grains and by dust. rows: of tile_control.csv"""
    if not rows:
        return []
    body = [[row["shot"], row["load"], row["number"], row["cell size [mm]"], row["outcome"], row["speed [m/s]"], row["over spread"],
             row["rim over thickness"]] for row in rows]
    speeds = {}
    for row in rows:
        speeds.setdefault(row["shot"], {})[row["load"]] = number(row["speed [m/s]"])
    parts = [f"{load}: {ratio_text([own[load] / own['grains'] for own in speeds.values() if load in own and own.get('grains', math.nan) > 0])}"
             for load in ("dust as grains", "dust")]
    return ["## Tiles struck by dust", "", CONTROL, "", *table(["shot", "load", "number", "cells, mm", "outcome", "speed, m/s", "over spread", "rim"], body),
            f"Speed over that with grains: {'; '.join(parts)}.", ""]


def band_text(rows, column):
    """Value of the finest row on the grid, with half of the range over all rows."""
    values = [number(row[column]) for row in rows if row[column]]
    if not values:
        return "-"
    finest = min((row for row in rows if row[column]), key=lambda row: (float(row["cell size [mm]"]), float(row["shift"])))
    return f"{number(finest[column]):.3g} ± {0.5 * (max(values) - min(values)):.2g}"


def cloud_section(rows):
    """Clouds of spheres of 9.53 mm and melting of those of 3.175 mm. rows: of clouds.csv"""
    series, melting = {}, {}
    for row in rows:
        key = float(row["bumper [mm]"]) / float(row["diameter [mm]"])
        if float(row["diameter [mm]"]) > 5:
            series.setdefault(key, []).append(row)
        else:
            melting.setdefault(float(row["velocity [km/s]"]), {})[float(row["cell size [mm]"])] = row
    lines = []
    if series:
        sizes = [("size at 50 %", "median size"), ("size at 84 %", "84 %"), ("size at 97.5 %", "97.5 %")]
        body = [[f"{key:.3f}", ", ".join(sorted({row["cell size [mm]"] for row in own}, key=float)),
                 *(band_text(own, column) for column in ("front", "rear", "radial", "length over width", "sphere intact", "debris melted")),
                 *(band_text(own, column) for column, _ in sizes)] for key, own in sorted(series.items())]
        lines += ["## Clouds of Piekutowski's series", "", CLOUDS, "",
                  *table(["t/D", "cells, mm", "front", "rear", "radial", "length over width", "intact", "melted", *(f"{title}" for _, title in sizes)], body),
                  "![Clouds as radiographs would see them](../images/shield_clouds.png)", ""]
    if melting:
        cells = sorted({cell for own in melting.values() for cell in own}, reverse=True)
        body = [[f"{speed:g}", *(own[cell][column] if cell in own else "-" for column in ("debris melted", "sphere melted", "size at 50 %") for cell in cells)]
                for speed, own in sorted(melting.items())]
        lines += ["## Onset of melting behind the bumper of Ryan's shield", "", MELTING, "",
                  *table(["km/s", *(f"{title}, {cell:g} mm" for title in ("debris melted", "sphere melted", "median size") for cell in cells)], body)]
    return lines


def majority(outcomes):
    """Whether most of the decided outcomes are failures; None where none is decided or as many are as are not."""
    decided = [value for value in map(defeated, outcomes) if value is not None]
    failed = sum(decided)
    return None if 2 * failed == len(decided) else 2 * failed > len(decided)


def panel_section(rows):
    """Outcomes of panels of foam, by what stands for the foam. rows: of foam_outcomes.csv"""
    if not rows:
        return []
    lines, counts = [], []
    for kind in dict.fromkeys((row["foam"], row["cell size [mm]"]) for row in rows):
        members = sorted((row for row in rows if (row["foam"], row["cell size [mm]"]) == kind), key=lambda row: (row["shot"], row["seed"] or ""))
        failed = right = 0
        shots = list(dict.fromkeys(row["shot"] for row in members))
        for shot in shots:
            of_shot = [row for row in members if row["shot"] == shot]
            verdict = majority([row["outcome"] for row in of_shot])
            measured = of_shot[0]["measured"]
            failed += verdict is True
            right += verdict is not None and verdict == (measured == "P")
            lines.append([shot, measured, *kind, ", ".join(row["outcome"] for row in of_shot), {None: "-", True: "P", False: "NP"}[verdict],
                          ", ".join(row["left"] or "-" for row in of_shot), f"{statistics.median(float(row['seconds']) for row in of_shot):.0f}"])
        counts.append([*kind, len(shots), failed, "-" if kind[0] == "none" else right])
    return ["## Panels of foam", "", *PANELS.splitlines(), "", *table(["foam", "cells, mm", "shots", "failed", "right"], counts),
            *table(["shot", "measured", "foam", "cells, mm", "outcome", "verdict", "left", "s"], sorted(lines, key=lambda line: line[0]))]
