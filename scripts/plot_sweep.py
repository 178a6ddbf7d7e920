#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A figure per result of a study: plot_sweep.py STUDY.json FOLDER (started by whipple sweep)."""
import json
import math
import pathlib
import re
import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it at once

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from report.files import save_figure  # noqa: E402

MOST_PANELS = 4


def label(name, unit):
    return f"{name} ({unit})" if unit not in ("", "1") else name


def column(rows, name):
    return [math.nan if row[name] is None else row[name] for row in rows]


def panel(axes, rows, variable, quantity, limits):
    """Draw a result over one variable, numerical variants in colours of their own, and the limits as grey bands."""
    variants = sorted({(row["cell_size"], row["offset"]) for row in rows})
    for variant in variants:
        own = [row for row in rows if (row["cell_size"], row["offset"]) == variant]
        x, y = [row[variable["name"]] for row in own], column(own, quantity)
        text = ", ".join(filter(None, (variant[0], f"offset {variant[1]:g}" if variant[1] else "")))
        axes.plot(x, y, "o", ms=3.5, alpha=0.7, label=text or None)
    for row in limits if variable["is_limit"] else []:
        if row["lower"] is not None:
            axes.axvspan(row["lower"], row["upper"], color="0.8", zorder=0)
    axes.set_xlabel(label(variable["name"].rsplit(".material.", 1)[-1], variable["unit"]))
    if variable["is_number"]:
        axes.locator_params(axis="x", nbins=4)
    if len(variants) > 1:
        axes.legend(frameon=False)


def main():
    if len(sys.argv) != 3:
        asked = sys.argv[1:] in (["--help"], ["-h"])
        print(__doc__, file=sys.stdout if asked else sys.stderr)
        sys.exit(0 if asked else 2)
    study, folder = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")), pathlib.Path(sys.argv[2])
    rows, units = study["points"]["rows"], study["points"]["units"]
    limits = study.get("limits", {"rows": []})["rows"]
    variables = study["variables"]
    for variable in variables:
        variable["is_limit"] = bool(limits) and variable is variables[-1]
    sensitive = {row["variable"]: row for row in study.get("sensitivities", {"rows": []})["rows"]}
    for quantity in study["quantities"]:
        values = [value for value in column(rows, quantity) if math.isfinite(value)]
        if not values or (min(values) == max(values) and len(study["quantities"]) > MOST_PANELS):
            continue

        def weight(variable, name=quantity):
            return -((sensitive.get(variable["name"]) or {}).get(name) or 0.0)

        shown = sorted(variables, key=lambda v: (not v["is_limit"], weight(v)))[:MOST_PANELS]
        figure, axes = plt.subplots(1, len(shown) + 1, figsize=(3.4 * (len(shown) + 1), 3.2), layout="constrained", squeeze=False)
        for axis, variable in zip(axes[0], shown):
            panel(axis, rows, variable, quantity, limits)
        axes[0][0].set_ylabel(label(quantity, units[quantity]))
        axes[0][-1].hist(values, bins=max(5, min(40, round(math.sqrt(len(values))))), color="tab:blue", alpha=0.7)
        axes[0][-1].set(xlabel=label(quantity, units[quantity]), ylabel="points")
        save_figure(figure, folder / (re.sub(r"[^A-Za-z0-9_.-]+", "_", quantity) + ".png"))
        plt.close(figure)


if __name__ == "__main__":
    main()
