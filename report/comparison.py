# SPDX-License-Identifier: BSD-3-Clause
"""Several runs side by side on one page: input, quantities, curves, pictures of the last time on common scales."""
import json
import math
import pathlib
import string
from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from report import expected, pictures, style, units
from report.case_text import describe_value
from report.curves import legend_above, new_figure
from report.errors import NotARun
from report.expectations import BadExpectation
from report.files import encoded, write_whole
from report.measured import Measures
from report.page import Page
from report.run import Run
from report.units import number

# Columns of history.csv over time, and of the series of the analysis: label, factor to its unit, whether they grow with
# the number of copies of the model.
HISTORY = {"kinetic_energy": ("kinetic energy (kJ)", 1e-3, True), "internal_energy": ("internal energy (kJ)", 1e-3, True),
           "maximum_pressure": ("largest pressure (GPa)", units.GIGAPASCALS, False)}
SERIES = {"front": ("front of the debris (mm)", units.MILLIMETRES), "radius": ("radius of the debris (mm)", units.MILLIMETRES),
          "mean_velocity": ("mean axial velocity of the debris (km/s)", units.KM_PER_SECOND)}
NOT_COMPARED = ("provenance.", "title")


def flat(table: object, path: str = "") -> Iterator[tuple[str, str]]:
    """Yields the keys of nested tables with dots, and their values as texts."""
    if isinstance(table, dict):
        for key, value in table.items():
            yield from flat(value, f"{path}.{key}" if path else key)
    elif isinstance(table, list) and any(isinstance(value, dict) for value in table):
        for i, value in enumerate(table):
            yield from flat(value, f"{path}.{value.get('name', i) if isinstance(value, dict) else i}")
    else:
        yield path, describe_value(table)


def differences(inputs: list[dict]) -> list[list[str]]:
    """Returns a row per key of the input in which runs differ: key, then the value of each; a dash where there is none."""
    tables = [dict(flat(each)) for each in inputs]
    keys = dict.fromkeys(key for table in tables for key in table)
    rows = [[key, *(table.get(key, units.MISSING) for table in tables)] for key in keys
            if not key.startswith(NOT_COMPARED)]
    return [row for row in rows if len(set(row[1:])) > 1]


def spread(values: list[float]) -> str:
    """Writes the range of values over their mean magnitude; a dash if they are not all there."""
    if not all(map(math.isfinite, values)):
        return units.MISSING
    mean = sum(map(abs, values)) / len(values)
    return units.percent((max(values) - min(values)) / mean) if mean > 0 else units.percent(0)


class Comparison:
    """Builds the page of several runs, named A, B, C... Raises NotARun if one of them was not measured."""

    def __init__(self, runs: list[Run], output: pathlib.Path, dots_per_inch: int):
        style.apply()
        self.runs, self.output, self.dots_per_inch = runs, output, dots_per_inch
        self.letters = [string.ascii_uppercase[i] if i < 26 else str(i + 1) for i in range(len(runs))]
        for run in runs:
            if run.analysis is None:
                raise NotARun(f"{run.folder}: has no snapshots to be compared")
        output.mkdir(parents=True, exist_ok=True)
        titles = dict.fromkeys(run.title for run in runs)
        self.page = Page(f"{len(runs)} runs side by side", " · ".join(titles))
        self.data = {}

    def add_all(self) -> None:
        """Adds all sections."""
        self.page.heading("Runs")
        self.page.table(["", "run", "title", "cells", "particles", "until", "program"],
                        [self._facts(letter, run) for letter, run in zip(self.letters, self.runs)], text_columns=(0, 1, 2, 6))
        self.page.heading("Input in which they differ")
        rows = differences([run.input for run in self.runs])
        if rows:
            self.page.table(["key", *self.letters], rows, text_columns=range(len(self.letters) + 1))
        else:
            self.page.paragraph("None.")
        self._expectations()
        self._curves()
        self._pictures()
        self._quantities()

    def _facts(self, letter, run):
        cells = f"{units.MILLIMETRES * run.analysis.cell_size:.4g} mm"
        particles = run.history.last("particles")
        return [letter, run.folder.resolve(), run.title, cells, f"{particles:,.0f}" if particles else units.MISSING,
                units.time(run.entries[-1][1]), run.input.get("provenance", {}).get("program", units.MISSING)]

    def _expectations(self):
        try:
            cases = [expected.case_of(run) for run in self.runs]
            chosen = [case and expected.run_of(case, run) for case, run in zip(cases, self.runs)]
            if not all(chosen) or len({case.path.resolve() for case in cases}) > 1:
                return
            measures = [Measures(run.folder, run.output) for run in self.runs]
            rows = []
            for e in chosen[0].expectations:
                found = [next((mine for mine in each.expectations if mine.name == e.name), None) for each in chosen]
                values = [each.value(mine) if mine else math.nan for each, mine in zip(measures, found)]
                rows.append([e.name, expected.expectation_text(e), *(expected.shown(value, e.unit) for value in values)])
        except BadExpectation as error:
            self.page.note(f"The expectations of the case cannot be read: {error}")
            return
        self.page.heading("Expected, and found")
        self.page.table(["quantity", "expected", *self.letters], rows, text_columns=(0,))

    def _add_figure(self, name: str, caption: str, figure: Figure) -> None:
        path = self.output / name
        width = style.share_of_page(figure)
        pictures.save(figure, path, self.dots_per_inch)
        self.page.image(pictures.small_copy(path), caption, width)

    def _overlay(self, columns, of_run, name, caption):
        shown = [key for key in columns if all(key in of_run(run) for run in self.runs)]
        if not shown:
            return
        figure, axes = new_figure(max(len(shown), 2))
        for ax in axes[len(shown):]:
            ax.set_visible(False)
        for ax, key in zip(axes, shown):
            label, scale, *grows = columns[key]
            for letter, run in zip(self.letters, self.runs):
                factor = scale * (run.multiplicity if grows and grows[0] else 1)
                table = of_run(run)
                ax.plot(units.MICROSECONDS * np.asarray(table["time"]), factor * np.asarray(table[key]), label=letter)
            ax.set_ylabel(label)
        legend_above(axes[0], columns=4)
        self._add_figure(name, caption, figure)

    def _curves(self):
        self.page.heading("Over time")
        self._overlay(HISTORY, lambda run: run.history, "compare_history.png", "Energies of the full problem, and the "
                      "largest pressure of any particle.")
        self._overlay(SERIES, lambda run: run.analysis.series, "compare_debris.png", "Front, radius and mean velocity of the "
                      "debris.")

    def _pictures(self):
        views = [run.analysis.views for run in self.runs]
        if not all(view and view.times for view in views):
            self.page.note("Not all analyses have views: pictures are made by `whipple report`.")
            return
        if len({view.geo.planar for view in views}) == 1 and len({view.geo.labels for view in views}) == 1:
            self.page.heading("Pictures of the last time")
            last = [view.times[-1] for view in views]
            titles = [f"{letter}: t = {units.time(view.time)}" for letter, view in zip(self.letters, last)]
            limits = [view.limits for view in views]
            for field, (name, factor, _) in pictures.SCALED.items():
                if not all(field in view.scales and field in at.section.fields for view, at in zip(views, last)):
                    continue
                ends = [tuple(factor * end for end in pictures.WHOLE.get(field, view.scales[field])) for view in views]
                norm = pictures.scale_of((min(low for low, _ in ends), max(high for _, high in ends)))
                painted = [pictures.scaled_picture(at.section, field, norm) for at in last]
                extend = pictures.beyond([factor * at.section.fields[field] for at in last], norm)
                self._add_figure(f"compare_{field}.png", f"Sections coloured by {name}, on one scale.",
                                 pictures.panels(views[0].geo, limits, [image for image, _ in painted], titles,
                                                 f"Section, by {name}", bar=(*painted[0][1], extend)))
        else:
            self.page.note("The runs have different frames of reference or dimensions: no pictures side by side.")

    def _quantities(self):
        self.page.heading("All quantities")
        finals = [run.analysis.final for run in self.runs]
        rows = []
        for name in dict.fromkeys(name for final in finals for name in final):
            values = [final.get(name, math.nan) for final in finals]
            if any(map(math.isfinite, values)):
                rows.append([name, *map(number, values), spread(values)])
                self.data[name] = [value if math.isfinite(value) else None for value in values]
        self.page.table(["quantity (SI)", *self.letters, "range over mean"], rows)
        self.page.paragraph("Meanings and units: quantities.csv of each report, docs/manual/output.md.")

    def write(self) -> pathlib.Path:
        """Writes comparison.html and comparison.json. Returns the path of the page."""
        path = self.output / "comparison.html"
        write_whole(path, lambda stream: stream.write(encoded(self.page.text())))
        text = json.dumps({"runs": [str(run.folder) for run in self.runs], "quantities": self.data}, indent=1) + "\n"
        write_whole(self.output / "comparison.json", lambda stream: stream.write(encoded(text)))
        return path
