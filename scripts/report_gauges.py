# SPDX-License-Identifier: BSD-3-Clause
"""Curves of the gauges and tracers of a run over time (gauges.csv, docs/manual/output.md)."""
import matplotlib.pyplot as plt
import numpy as np

from report_curves import MICRO, legend_above, new_figure
from report_data import History

PANELS = (("pressure", 1e-9, "pressure (GPa)"), ("speed", 1e-3, "speed (km/s)"), ("temperature", 1.0, "temperature (K)"))
FEW = 10  # more gauges than this share a colour scale instead of a legend


def read(run):
    return History(run.folder / "gauges.csv")


def names(history):
    """Of all gauges, in the order of their columns."""
    return [column[:-len(".pressure")] for column in history.columns if column.endswith(".pressure")]


def values(history, gauge, quantity):
    if quantity == "speed":
        return np.sqrt(sum(history[f"{gauge}.velocity_{axis}"] ** 2 for axis in "xyz"))
    return history[f"{gauge}.{quantity}"]


def figure(history):
    gauges = names(history)
    if not gauges or "time" not in history:
        return None
    figure, axes = new_figure(len(PANELS))
    colours = plt.cm.viridis(np.linspace(0, 0.95, len(gauges))) if len(gauges) > FEW else [None] * len(gauges)
    for ax, (quantity, scale, label) in zip(axes, PANELS):
        for gauge, colour in zip(gauges, colours):
            ax.plot(MICRO * history["time"], scale * values(history, gauge, quantity), label=gauge, color=colour,
                    linewidth=1.4 if len(gauges) <= FEW else 0.9)
        ax.set_ylabel(label)
    if len(gauges) <= FEW:
        legend_above(axes[0], columns=5)
    return figure
