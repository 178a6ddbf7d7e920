# SPDX-License-Identifier: BSD-3-Clause
"""Measured histories (velocity of a free surface, stress behind a window) beside those of the gauges of a run."""
import csv
import math
import pathlib
from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from report import style, units
from report.curves import legend_above, new_figure
from report.expectations import UNITS, BadExpectation, Expectation
from report.history import History


def read(path: pathlib.Path) -> tuple[np.ndarray, np.ndarray, str]:
    """Reads a table of two columns, "time [UNIT]" and "NAME [UNIT]", lines of # apart. Returns SI values and the unit of the second."""
    if not path.is_file():
        raise BadExpectation(f"{path} is missing")
    with path.open(newline="") as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#") and line.strip()))
    heads = [head.strip().removesuffix("]").partition(" [") for head in rows[0]] if rows else []
    if len(heads) != 2 or heads[0][0] != "time" or any(not mark or unit not in UNITS for _, mark, unit in heads):
        raise BadExpectation(f'{path}: expected the columns "time [UNIT]" and "NAME [UNIT]", units {", ".join(filter(None, UNITS))}')
    try:
        table = np.array([[float(cell) for cell in row] for row in rows[1:]])
    except ValueError as error:
        raise BadExpectation(f"{path}: {error}") from None
    if table.ndim != 2 or table.shape[1] != 2 or len(table) < 3 or not (np.diff(table[:, 0]) >= 0).all():
        raise BadExpectation(f"{path}: expected three or more rows of two numbers in the order of time")
    return table[:, 0] * UNITS[heads[0][2]], table[:, 1] * UNITS[heads[1][2]], heads[1][2]


def of_gauge(path: pathlib.Path, column: str) -> tuple[np.ndarray, np.ndarray]:
    """Reads times and a column ("NAME.QUANTITY") of gauges.csv; empty without them."""
    history = History(path)
    if column not in history or "time" not in history:
        return np.empty(0), np.empty(0)
    there = np.isfinite(history[column])
    return history["time"][there], history[column][there]


def figure(path: pathlib.Path, expectations: list[Expectation], shift: Callable[[Expectation], float]) -> Figure | None:
    """Draws every measured history of the expectations beside that of the run; None without any.

    shift: the time (s) by which the run is moved to reach half the largest measured value when the measurement does."""
    drawn = []
    for e in expectations:
        if e.measure.startswith("history_error."):
            column = e.measure.partition(".")[2]
            times, values = of_gauge(path, column)
            if len(times) > 1:
                drawn.append((column, times, values, shift(e), *read(e.table)))
    if not drawn:
        return None
    result, axes = new_figure(len(drawn), 2.8)
    for ax, (column, times, values, by, measured_times, measured, unit) in zip(axes, drawn):
        moved = times + by if math.isfinite(by) else times
        ax.plot(units.MICROSECONDS * measured_times, measured / UNITS[unit], "o", markersize=2.5, color=style.LINES[1], label="measured")
        ax.plot(units.MICROSECONDS * moved, values / UNITS[unit], color=style.LINES[0], label="this run")
        ax.set_xlim(units.MICROSECONDS * min(measured_times[0], moved[0]), units.MICROSECONDS * moved[-1])
        ax.set_ylabel(f"{column.replace('_', ' ')} ({unit})")
        legend_above(ax)
    return result
