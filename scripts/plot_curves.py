#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figure of one or more curves of `whipple eos`, with measurements as points.

The curves are CSV files whose column names carry units (P_GPa, up_km_s, V_over_V0); '#' lines are comments, the first
one is the label. Measurements (--overlay) are CSV files with the same column names; columns that a file lacks are
derived where the definition allows it (V_over_V0 from an atomic volume with a row at P = 0).

Example: plot_curves.py copper.csv aluminium.csv --x up_km_s --y us_km_s --overlay cu_hugoniot.csv --output fig.png
"""
import argparse
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LABELS = {
    "rho": "density", "V_over_V0": r"$V/V_0$", "P": "pressure", "T": "temperature", "e": "specific internal energy",
    "c": "sound speed", "s": "specific entropy", "cv": "heat capacity", "gamma": r"Grüneisen parameter",
    "KT": "isothermal bulk modulus", "up": "particle velocity", "us": "shock velocity", "u": "Riemann velocity",
    "melted": "melted fraction", "vaporised": "vaporised fraction", "solidus": "solidus", "liquidus": "liquidus",
    "liquid": "density of the liquid", "vapour": "density of the vapour", "latent": "latent heat",
}
UNITS = {
    "kg_m3": r"kg/m$^3$", "g_cm3": r"g/cm$^3$", "GPa": "GPa", "MPa": "MPa", "K": "K", "kJ_kg": "kJ/kg", "km_s": "km/s",
    "J_kg_K": "J/(kg K)",
}


def axis_label(column):
    """'P_GPa' -> 'pressure (GPa)'; unknown names stay as they are."""
    if column in LABELS:
        return LABELS[column]
    name, _, unit = column.partition("_")
    if unit in UNITS and name in LABELS:
        return f"{LABELS[name]} ({UNITS[unit]})"
    return column


def read(path):
    """(first comment, {column: list of words})"""
    comment, names, columns = "", None, {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.reader(file):
            if not row:
                continue
            if row[0].startswith("#"):
                comment = comment or ",".join(row)[1:].strip()
            elif names is None:
                names = row
                columns = {name: [] for name in names}
            else:
                for name, word in zip(names, row):
                    columns[name].append(word)
    if names is None:
        sys.exit(f"plot_curves.py: {path} holds no table")
    if "P_GPa" not in columns and "P_revised_ruby_GPa" in columns:
        columns["P_GPa"] = columns["P_revised_ruby_GPa"]
    if "V_over_V0" not in columns and "atomic_volume_A3" in columns and "P_GPa" in columns:
        rest = [float(v) for v, p in zip(columns["atomic_volume_A3"], columns["P_GPa"]) if float(p) == 0.0]
        if rest:
            columns["V_over_V0"] = [str(float(v) / rest[0]) for v in columns["atomic_volume_A3"]]
    return comment, columns


def pairs(path, columns, x, y):
    for name in (x, y):
        if name not in columns:
            sys.exit(f"plot_curves.py: {path} has no column '{name}' (it has: {', '.join(columns)})")
    points = []
    for a, b in zip(columns[x], columns[y]):
        try:
            points.append((float(a), float(b)))
        except ValueError:
            continue  # an empty cell: not known there
    return [p[0] for p in points], [p[1] for p in points]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("curves", nargs="+", help="CSV files of whipple eos")
    parser.add_argument("--x", required=True, help="column along the figure")
    parser.add_argument("--y", required=True, help="column up the figure")
    parser.add_argument("--overlay", nargs="*", default=[], help="CSV files of measurements")
    parser.add_argument("--label", nargs="*", default=[], help="labels of the curves (default: their first comment)")
    parser.add_argument("--title", default="")
    parser.add_argument("--log", choices=["x", "y", "xy"], default="", help="logarithmic axes")
    parser.add_argument("--output", required=True, help="FILE.png, FILE.pdf or FILE.svg")
    arguments = parser.parse_args()

    plt.rcParams.update({
        "font.size": 10, "axes.linewidth": 0.8, "lines.linewidth": 1.6, "legend.frameon": False, "xtick.direction": "in",
        "ytick.direction": "in", "xtick.top": True, "ytick.right": True, "savefig.dpi": 200, "mathtext.default": "regular",
    })
    figure, axes = plt.subplots(figsize=(5.6, 4.2), constrained_layout=True)
    colours = ["#0b559f", "#c03a2b", "#3a7d34", "#7a4fa3", "#b8860b", "#444444"]
    markers = ["o", "s", "^", "D", "v", "P"]
    for i, path in enumerate(arguments.curves):
        comment, columns = read(path)
        label = arguments.label[i] if i < len(arguments.label) else comment
        x, y = pairs(path, columns, arguments.x, arguments.y)
        axes.plot(x, y, color=colours[i % len(colours)], label=label, zorder=3,
                  marker="o" if len(x) == 1 else None)
    for i, path in enumerate(arguments.overlay):
        _, columns = read(path)
        x, y = pairs(path, columns, arguments.x, arguments.y)
        axes.plot(x, y, linestyle="none", marker=markers[i % len(markers)], markersize=4, markerfacecolor="white",
                  markeredgecolor="#222222", markeredgewidth=0.8, label=pathlib.Path(path).stem, zorder=4)
    axes.set_xlabel(axis_label(arguments.x))
    axes.set_ylabel(axis_label(arguments.y))
    if "x" in arguments.log:
        axes.set_xscale("log")
    if "y" in arguments.log:
        axes.set_yscale("log")
    if arguments.title:
        axes.set_title(arguments.title)
    axes.grid(True, linewidth=0.3, color="#cccccc", zorder=0)
    axes.legend(fontsize=8)
    figure.savefig(arguments.output)


if __name__ == "__main__":
    main()
