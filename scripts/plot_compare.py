#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Materials against experiments: plot_compare.py DATA.json FIGURE.png (started by whipple compare --plot)."""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from report.files import save_figure  # noqa: E402


def numbers(values):
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def label(quantity, unit):
    names = {"up": "particle velocity", "Us": "shock velocity", "P": "pressure", "V/V0": "$V/V_0$", "T": "temperature", "rho": "density",
             "c": "bulk sound speed"}
    name = names.get(quantity, quantity)
    return f"{name} ({unit})" if unit else name


def main():
    if len(sys.argv) != 3:
        asked = sys.argv[1:] in (["--help"], ["-h"])
        print(__doc__, file=sys.stdout if asked else sys.stderr)
        sys.exit(0 if asked else 2)
    with open(sys.argv[1], encoding="utf-8") as file:
        panels = json.load(file)
    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    columns = 2 if len(panels) == 4 else min(len(panels), 3)
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(2 * rows, columns, figsize=(5.2 * columns, 5.4 * rows), sharex=False,
                                height_ratios=(3, 1.2) * rows, layout="constrained", squeeze=False)
    for unused in range(len(panels), rows * columns):
        axes[2 * (unused // columns), unused % columns].set_axis_off()
        axes[2 * (unused // columns) + 1, unused % columns].set_axis_off()
    for i, panel in enumerate(panels):
        top, bottom = axes[2 * (i // columns), i % columns], axes[2 * (i // columns) + 1, i % columns]
        bottom.sharex(top)
        top.tick_params(labelbottom=False)
        x = numbers(panel["x"])
        top.plot(x, numbers(panel["measured"]), "o", ms=4, mfc="none", mec="0.25", mew=0.8, label="experiment",
                 zorder=3)
        unit = panel["deviation_unit"].split()[0]
        for k, material in enumerate(panel["materials"]):
            colour = f"C{k}"
            top.plot(numbers(material["x"]), numbers(material["curve"]), color=colour, lw=1.3,
                     label=f"{material['name']} (rms {material['rms']:.2f} {unit})")
            if "lower" in material:
                top.fill_between(numbers(material["x"]), numbers(material["lower"]), numbers(material["upper"]),
                                 color=colour, alpha=0.2, lw=0, label=f"{material['name']}, 95 % band")
            bottom.plot(x, numbers(material["deviation"]), "o", ms=2.8, color=colour)
        bottom.axhline(0.0, color="0.4", lw=0.8)
        top.set_title(f"{panel['experiment']}\n{panel['kind']}", fontsize=9)
        top.set_ylabel(label(panel["ordinate"], panel["ordinate_unit"]))
        bottom.set_ylabel(f"material less\nexperiment ({panel['deviation_unit']})")
        bottom.set_xlabel(label(panel["abscissa"], panel["abscissa_unit"]))
        top.legend(frameon=False, fontsize=8)
    save_figure(figure, sys.argv[2], dpi=200)


if __name__ == "__main__":
    main()
