# SPDX-License-Identifier: BSD-3-Clause
"""How far the numbers of a single run depend on its grid: cells across the projectile, and what grid studies found.

grid_sensitivity.json beside this file is written by `results.py --write`; without it the text alone is shown.
"""
import json
import pathlib
import statistics

TABLE = pathlib.Path(__file__).resolve().parent / "grid_sensitivity.json"
FACTORS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "m/s": 1.0, "km/s": 1e3, "cm/s": 1e-2}
ONE_RUN = ("One run on one grid does not show its own error. Speeds, lengths and craters change little with the cells; "
           "masses that melt or vaporise, extreme values and fragments change most, and round-off decides where material "
           "breaks. Repeat the run with two other cell sizes before relying on a number (docs/theory/uncertainty.md).")


def number(value):
    """In SI: 0.005, "5 mm", "1 km/s"."""
    words = str(value).split()
    return float(words[0]) * (FACTORS.get(words[1], 1.0) if len(words) > 1 else 1.0)


def projectile_size(bodies):
    """Smallest extent of the first moving body, in metres; None if its shape has none that is known."""
    for body in bodies:
        velocity = [number(v) for v in body.get("velocity", [0, 0, 0])]
        if not any(velocity):
            continue
        shape = body.get("shape", {})
        shape = shape.get("moved", shape).get("shape", shape)
        for kind, keys in shape.items():
            if kind in ("sphere", "ogive"):
                return 2 * number(keys["radius"])
            if kind == "cylinder":
                return min(2 * number(keys["radius"]), number(keys["height"]))
            if kind == "box":  # of a column between mirror planes the thickness counts
                axis = max(range(3), key=lambda i: abs(velocity[i]))
                return number(keys["upper"][axis]) - number(keys["lower"][axis])
    return None


def percent(value):
    return f"{100 * value:.2g} %"


def rows(studies):
    """One row per kind of quantity: typical and largest band, change by the last refinement, cells, converged studies."""
    found = []
    for kind, entries in studies.items():
        cells = [entry["cells"][-1] for entry in entries]
        across = f"{min(cells):.3g}" if min(cells) == max(cells) else f"{min(cells):.3g} to {max(cells):.3g}"
        found.append([kind, percent(statistics.median(entry["band"] for entry in entries)),
                      percent(max(entry["band"] for entry in entries)),
                      percent(statistics.median(entry["change"] for entry in entries)), across,
                      f"{sum(entry['converged'] for entry in entries)} of {len(entries)}"])
    return found


def add_to(page, run_input, table=TABLE):
    """Adds the section to a report; `run_input`: the tables of run.toml."""
    page.heading("How far the numbers depend on the grid")
    page.paragraph(ONE_RUN)
    size, cell = projectile_size(run_input.get("body", [])), run_input.get("domain", {}).get("cell_size")
    if size and cell:
        page.paragraph(f"This run: {size / number(cell):.3g} cells across the projectile.")
    studies = json.loads(table.read_text()) if table.is_file() else {}
    if studies:
        page.paragraph("What the grid studies of the cases found (docs/generated/results.md): half-width of the band of "
                       "95 % over the value on the finest grid, and the change by the last refinement.")
        page.table(["quantity", "band, typical", "band, largest", "change, typical", "cells across the projectile",
                    "converged studies"], rows(studies), text_columns=(0,))
