# SPDX-License-Identifier: BSD-3-Clause
"""Measured histories (velocity of a free surface, stress behind a window) beside those of the gauges of a run."""
import csv
import math
import pathlib

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


def crossing(times: np.ndarray, values: np.ndarray, level: float) -> float:
    """Returns the time at which a history first reaches a level of its sign, linear in between; NaN if it never does."""
    above = np.flatnonzero(values >= level if level > 0 else values <= level)
    if len(above) == 0 or above[0] == 0:
        return math.nan
    i = above[0]
    return times[i - 1] + (times[i] - times[i - 1]) * (level - values[i - 1]) / (values[i] - values[i - 1])


def aligned(times: np.ndarray, values: np.ndarray, measured_times: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """Returns the times of a simulated history, moved so that it reaches half the largest measured value when the measurement does.

    The moment of impact is in few records; shape and size are compared, not the arrival. NaN where half is never reached."""
    half = 0.5 * measured[np.argmax(np.abs(measured))]
    return times + crossing(measured_times, measured, half) - crossing(times, values, half)


def integral(times: np.ndarray, values: np.ndarray) -> float:
    """Returns the integral over time by the trapezoidal rule."""
    return float((0.5 * (values[1:] + values[:-1]) * np.diff(times)).sum())


def error(times: np.ndarray, values: np.ndarray, measured_times: np.ndarray, measured: np.ndarray) -> float:
    """Returns the integral of |f - f_measured| over that of |f_measured|, over the times of the measurement, after alignment.

    NaN where the simulated history does not reach half the largest measured value or does not cover the measurement."""
    moved = aligned(times, values, measured_times, measured)
    if not np.isfinite(moved).all() or moved[-1] < measured_times[-1]:
        return math.nan
    # A record may begin before the simulation: there nothing has happened yet.
    found = np.interp(measured_times, moved, values, left=0.0)
    return integral(measured_times, np.abs(found - measured)) / integral(measured_times, np.abs(measured))


def of_gauge(path: pathlib.Path, column: str) -> tuple[np.ndarray, np.ndarray]:
    """Reads times and a column ("NAME.QUANTITY") of gauges.csv; empty without them."""
    history = History(path)
    if column not in history or "time" not in history:
        return np.empty(0), np.empty(0)
    there = np.isfinite(history[column])
    return history["time"][there], history[column][there]


def measure(path: pathlib.Path, column: str, table: pathlib.Path) -> float:
    """Returns the error of a column of gauges.csv against a measured history; NaN without one."""
    times, values = of_gauge(path, column)
    return error(times, values, *read(table)[:2]) if len(times) > 1 else math.nan


def figure(path: pathlib.Path, expectations: list[Expectation]) -> Figure | None:
    """Draws every measured history of the expectations beside that of the run; None without any."""
    drawn = []
    for e in expectations:
        if e.measure.startswith("history_error."):
            column = e.measure.partition(".")[2]
            times, values = of_gauge(path, column)
            if len(times) > 1:
                drawn.append((column, times, values, *read(e.table)))
    if not drawn:
        return None
    result, axes = new_figure(len(drawn), 2.8)
    for ax, (column, times, values, measured_times, measured, unit) in zip(axes, drawn):
        moved = aligned(times, values, measured_times, measured)
        moved = moved if np.isfinite(moved).all() else times
        ax.plot(units.MICROSECONDS * measured_times, measured / UNITS[unit], "o", markersize=2.5, color=style.LINES[1], label="measured")
        ax.plot(units.MICROSECONDS * moved, values / UNITS[unit], color=style.LINES[0], label="this run")
        ax.set_xlim(units.MICROSECONDS * min(measured_times[0], moved[0]), units.MICROSECONDS * moved[-1])
        ax.set_ylabel(f"{column.replace('_', ' ')} ({unit})")
        legend_above(ax)
    return result
