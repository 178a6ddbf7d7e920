#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figure of curves and measurements: plot_curves.py FIGURE.json OUTPUT (.png, .pdf or .svg), started by whipple eos.

FIGURE.json: title, axes x and y (label with unit, logarithmic), curves and points, each with label (what it is), material,
numbers x and y (null: not known), colour (index of the palette; curves of one material share it) and style; bands with
label, x, lower, upper and colour.
"""
import json
import pathlib
import re
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from report.files import save_figure  # noqa: E402

# Colours that stay apart in print and for colour-blind readers (after Okabe and Ito).
PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7a5195", "#e69f00", "#56b4e9", "#444444"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<"]
STYLES = {
    "solid": {"linestyle": "-", "linewidth": 1.6},
    "dashed": {"linestyle": (0, (5, 2)), "linewidth": 1.4},
    "dotted": {"linestyle": (0, (1, 1.6)), "linewidth": 1.4},
    "dashdot": {"linestyle": (0, (6, 2, 1, 2)), "linewidth": 1.3},
    "thin": {"linestyle": "-", "linewidth": 0.7},
    "marks": {"linestyle": "none", "marker": "|", "markersize": 13, "markeredgewidth": 1.6},
}
# Units and symbols as printed.
TYPESET = [(r"m\^3", r"m$^3$"), (r"V/V0", r"$V/V_0$"), (r"1e-6/K", r"10$^{-6}$/K")]


def typeset(text):
    for pattern, replacement in TYPESET:
        text = re.sub(pattern, replacement.replace("\\", "\\\\"), text)
    return text


def numbers(values):
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def legend_entries(curves):
    """Materials by colour if there are several, then kinds of curves by style (grey if there are several materials)."""
    materials = {curve["material"]: PALETTE[curve["colour"] % len(PALETTE)] for curve in curves}
    kinds = {curve["label"]: (STYLES[curve["style"]], PALETTE[curve["colour"] % len(PALETTE)]) for curve in curves}
    several = len(materials) > 1
    entries = [Line2D([], [], color=colour, linewidth=3, label=name) for name, colour in materials.items() if several]
    if len(kinds) > 1 or not several:
        entries += [Line2D([], [], color="#555555" if several else colour, label=typeset(kind), **style)
                    for kind, (style, colour) in kinds.items()]
    return entries


def main():
    if len(sys.argv) != 3:
        asked = sys.argv[1:] in (["--help"], ["-h"])
        print(__doc__, file=sys.stdout if asked else sys.stderr)
        sys.exit(0 if asked else 2)
    with open(sys.argv[1], encoding="utf-8") as file:
        description = json.load(file)
    plt.rcParams.update({
        "font.size": 10, "axes.linewidth": 0.8, "legend.frameon": False, "xtick.direction": "in",
        "ytick.direction": "in", "xtick.top": True, "ytick.right": True, "xtick.minor.visible": True,
        "ytick.minor.visible": True, "savefig.dpi": 250, "mathtext.default": "regular", "pdf.fonttype": 42,
        "svg.fonttype": "none",
    })
    figure, axes = plt.subplots(figsize=(6.0, 4.4), layout="constrained")
    for curve in description["curves"]:
        x, y = numbers(curve["x"]), numbers(curve["y"])
        style = {"marker": "o" if len(x) == 1 else None, **STYLES[curve["style"]]}
        axes.plot(x, y, color=PALETTE[curve["colour"] % len(PALETTE)], zorder=3, **style)
    for band in description["bands"]:
        axes.fill_between(numbers(band["x"]), numbers(band["lower"]), numbers(band["upper"]), alpha=0.2, linewidth=0,
                          color=PALETTE[band["colour"] % len(PALETTE)], label=band["label"], zorder=1)
    for i, points in enumerate(description["points"]):
        axes.plot(numbers(points["x"]), numbers(points["y"]), linestyle="none", marker=MARKERS[i % len(MARKERS)],
                  markersize=3.6, markerfacecolor="white", markeredgecolor="#333333", markeredgewidth=0.7,
                  label=points["label"], zorder=2)
    for name, set_label, set_scale in (("x", axes.set_xlabel, axes.set_xscale), ("y", axes.set_ylabel, axes.set_yscale)):
        set_label(typeset(description[name]["label"]))
        if description[name]["logarithmic"]:
            set_scale("log")
    if description["title"]:
        axes.set_title("\n".join(textwrap.wrap(description["title"], 76)), fontsize=10)
    axes.grid(True, linewidth=0.3, color="#cccccc", zorder=0)
    entries = legend_entries(description["curves"]) + axes.get_legend_handles_labels()[0]
    if len(entries) > 1:
        axes.legend(handles=entries, fontsize=8, handlelength=2.6)
    save_figure(figure, sys.argv[2])


if __name__ == "__main__":
    main()
