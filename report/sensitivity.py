# SPDX-License-Identifier: BSD-3-Clause
"""How far the numbers of a single run depend on its grid: cells across the projectile, and what grid studies found.

grid_sensitivity.json beside this file is written by `scripts/results.py --write`; without it the text alone is shown.
"""
import json
import math
import pathlib
import statistics

from report import units
from report.analysis import Analysis
from report.page import Page

TABLE = pathlib.Path(__file__).resolve().parent / "grid_sensitivity.json"
ONE_RUN = ("One run on one grid does not show its own error. Speeds, lengths and craters change little with the cells; "
           "masses that melt or vaporise, extreme values and fragments change most, and round-off decides where "
           "material breaks. Repeat the run with two other cell sizes before relying on a number "
           "(docs/theory/uncertainty.md).")


def rows(studies: dict[str, list[dict]]) -> list[list[str]]:
    """Writes one row per kind of quantity: typical and largest band, change by the last refinement, cells, converged
    studies."""
    found = []
    for kind, entries in studies.items():
        cells = [entry["cells"][-1] for entry in entries]
        across = f"{min(cells):.3g}" if min(cells) == max(cells) else f"{min(cells):.3g} to {max(cells):.3g}"
        found.append([kind, units.percent(statistics.median(entry["band"] for entry in entries)),
                      units.percent(max(entry["band"] for entry in entries)),
                      units.percent(statistics.median(entry["change"] for entry in entries)), across,
                      f"{sum(entry['converged'] for entry in entries)} of {len(entries)}"])
    return found


def add_to(page: Page, analysis: Analysis | None, table: pathlib.Path = TABLE) -> None:
    """Adds the section to a report; without an analysis the cells of this run are not known."""
    page.heading("How far the numbers depend on the grid")
    page.paragraph(ONE_RUN)
    size = analysis.quantity("projectile_size") if analysis else math.nan
    if math.isfinite(size):
        page.paragraph(f"This run: {size / analysis.cell_size:.3g} cells across the projectile.")
    studies = json.loads(table.read_text()) if table.is_file() else {}
    if studies:
        page.paragraph("What the grid studies of the cases found (docs/generated/results.md): half-width of the band of 95 % "
                       "over the value on the finest grid, and the change by the last refinement.")
        page.table(["quantity", "band, typical", "band, largest", "change, typical", "cells across the projectile",
                    "converged studies"], rows(studies), text_columns=(0,))
