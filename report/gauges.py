# SPDX-License-Identifier: BSD-3-Clause
"""Curves of the gauges and tracers of a run over time (gauges.csv, docs/manual/output.md)."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from report import units
from report.curves import legend_above, new_figure
from report.history import History
from report.run import Run

# Quantity, factor to the unit shown, label, and the least height of the panel: what is less is round-off of material at rest.
PANELS = (("pressure", units.GIGAPASCALS, "pressure (GPa)", 1e-4), ("speed", units.KM_PER_SECOND, "speed (km/s)", 1e-5),
          ("temperature", 1.0, "temperature (K)", 0.1))
FEW = 10  # more gauges than this share a colour scale instead of a legend


def read(run: Run) -> History:
    """Reads gauges.csv; without columns if the run has no gauges."""
    return History(run.folder / "gauges.csv")


def names(history: History) -> list[str]:
    """Returns the names of all gauges, in the order of their columns."""
    return [column[:-len(".pressure")] for column in history.columns if column.endswith(".pressure")]


def values(history: History, gauge: str, quantity: str) -> np.ndarray:
    """Returns a quantity of a gauge over time, SI; the speed is the magnitude of the velocity."""
    if quantity == "speed":
        return np.sqrt(sum(history[f"{gauge}.velocity_{axis}"] ** 2 for axis in "xyz"))
    return history[f"{gauge}.{quantity}"]


def figure(history: History) -> Figure | None:
    """Draws pressure, speed and temperature of all gauges; None if there are none."""
    gauges = names(history)
    if not gauges or "time" not in history:
        return None
    figure, axes = new_figure(len(PANELS))
    colours = plt.cm.viridis(np.linspace(0, 0.95, len(gauges))) if len(gauges) > FEW else [None] * len(gauges)
    for ax, (quantity, scale, label, least) in zip(axes, PANELS):
        for gauge, colour in zip(gauges, colours):
            ax.plot(units.MICROSECONDS * history["time"], scale * values(history, gauge, quantity), label=gauge,
                    color=colour, linewidth=1.2 if len(gauges) <= FEW else 0.7)
        ax.set_ylabel(label)
        low, high = ax.get_ylim()
        if high - low < least:
            middle = (low + high) / 2 if max(abs(low), abs(high)) >= least / 2 else 0.0
            ax.set_ylim(middle - least / 2, middle + least / 2)
        ax.ticklabel_format(axis="y", useOffset=False)
    if len(gauges) <= FEW:
        legend_above(axes[0], columns=3)
    return figure
