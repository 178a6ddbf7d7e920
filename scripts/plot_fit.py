#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Data, fitted laws and residuals of whipple-fit: plot_fit.py DATA.json FIGURE.png (started by whipple fit --plot)."""
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


def rows(data, quantity):
    found = [row for row in data["residuals"] if row["quantity"] == quantity]
    return {key: np.array([row[key] for row in found]) for key in found[0] if key != "quantity"} if found else None


def residual_panel(axes, x, table, size, unit):
    axes.errorbar(x, (table["datum"] - table["fitted"]) / size, yerr=table["sigma"] / size, fmt="o", ms=3.5, lw=0.9,
                  capsize=2, color="tab:blue")
    axes.axhline(0.0, color="0.4", lw=0.8)
    axes.set_ylabel(f"residual\n({unit})")


def value(data, name):
    return data["constants"][name]["value"]


def plot_shock_velocity(data, top, bottom):
    table = rows(data, "shock_velocity")
    up = np.linspace(0.0, 1.05 * table["abscissa"].max(), 50)
    c, s = value(data, "hugoniot_intercept"), value(data, "hugoniot_slope")
    top.plot(up / 1e3, (c + s * up) / 1e3, color="0.2", lw=1.2, label=f"{c / 1e3:.3f} km/s + {s:.3f} $u_p$")
    top.plot(table["abscissa"] / 1e3, table["datum"] / 1e3, "o", ms=4, color="tab:blue", label="simulations")
    top.set_ylabel("shock velocity (km/s)")
    top.legend(frameon=False)
    residual_panel(bottom, table["abscissa"] / 1e3, table, 1.0, "m/s")
    bottom.set_xlabel("particle velocity (km/s)")


def plot_gruneisen(data, top, bottom):
    v0 = data["reference_volume"]
    volume = np.array([row["volume"] for row in data["isochores"]]) / v0
    gamma = np.array([row["gruneisen"] for row in data["isochores"]])
    error = np.array([row["error"] for row in data["isochores"]])
    grid = np.linspace(volume.min() - 0.01, volume.max() + 0.01, 50)

    def line(ratio):
        at_reference, slope = data["gruneisen"]
        return at_reference - slope * (1.0 - ratio)

    top.plot(grid, line(grid), color="0.2", lw=1.2, label="fitted $\\gamma_0 - a (1 - V/V_0)$")
    top.errorbar(volume, gamma, yerr=error, fmt="o", ms=4, capsize=2, color="tab:blue",
                 label="$V\\,\\Delta P/\\Delta E$ of each isochore")
    top.set_ylabel("Grüneisen parameter")
    top.legend(frameon=False)
    bottom.errorbar(volume, gamma - line(volume), yerr=error, fmt="o", ms=3.5, capsize=2, color="tab:blue")
    bottom.axhline(0.0, color="0.4", lw=0.8)
    bottom.set_ylabel("residual")
    bottom.set_xlabel("$V/V_0$")


def plot_energy(data, top, bottom):
    table = rows(data, "thermal_energy")
    v0 = data["reference_volume"]
    mass = data["molar_mass"]
    gas_constant = 8.314  # J/(mol K), that of the GRAY constants
    colours = plt.get_cmap("viridis")
    volumes = sorted(set(table["volume"]), reverse=True)
    for i, volume in enumerate(volumes):
        here = table["volume"] == volume
        colour = colours(i / max(1, len(volumes) - 1) * 0.9)
        temperature = table["temperature"][here]
        harmonic = 3.0 * gas_constant * (temperature - temperature.min())
        # What is left of the energy is small: without its errors the scatter of the volumes would read as a failed fit.
        top.errorbar(temperature, (table["datum"][here] * mass - harmonic) / 1e3, yerr=table["sigma"][here] * mass / 1e3,
                     fmt="o", ms=4, lw=0.6, capsize=2, color=colour, label=f"{volume / v0:.3f}")
        top.plot(temperature, (table["fitted"][here] * mass - harmonic) / 1e3, "-", lw=1.0, color=colour)
        bottom.errorbar(temperature, (table["datum"][here] - table["fitted"][here]) * mass / 1e3,
                        yerr=table["sigma"][here] * mass / 1e3, fmt="o", ms=3.5, capsize=2, color=colour)
    top.set_ylabel("anharmonic energy $E - 3RT$ (kJ/mol)")
    top.legend(frameon=False, title="$V/V_0$", fontsize=7)
    bottom.axhline(0.0, color="0.4", lw=0.8)
    bottom.set_ylabel("residual\n(kJ/mol)")
    bottom.set_xlabel("temperature (K)")


def plot_isotherm(data, top, bottom):
    table = rows(data, "isotherm_pressure")
    ratio = table["volume"] / data["reference_volume"]
    order = np.argsort(ratio)
    top.plot(ratio[order], table["fitted"][order] / 1e9, color="0.2", lw=1.2, label="fitted isotherm")
    top.plot(ratio, table["datum"] / 1e9, "o", ms=4, color="tab:blue", label="simulations")
    top.set_ylabel("pressure (GPa)")
    top.legend(frameon=False)
    residual_panel(bottom, ratio, table, 1e9, "GPa")
    bottom.set_xlabel("$V/V_0$")


def plot_against(quantity, size, unit, label, abscissa_size, abscissa_label):
    def draw(data, top, bottom):
        table = rows(data, quantity)
        order = np.argsort(table["abscissa"])
        x = table["abscissa"] / abscissa_size
        top.plot(x[order], table["fitted"][order] / size, "-", marker="_", color="0.2", lw=1.2, label="fitted")
        top.errorbar(x, table["datum"] / size, yerr=table["sigma"] / size, fmt="o", ms=4, capsize=2, color="tab:blue",
                     label="simulations")
        top.set_ylabel(f"{label} ({unit})")
        top.legend(frameon=False)
        residual_panel(bottom, x, table, size, unit)
        bottom.set_xlabel(abscissa_label)

    return draw


# Residuals that call for a panel, and what draws it.
PANELS = {
    "shock_velocity": plot_shock_velocity,
    "isotherm_pressure": plot_isotherm,
    "thermal_pressure": plot_gruneisen,
    "thermal_energy": plot_energy,
    "melting": plot_against("melting", 1.0, "K", "melting temperature", 1e9, "pressure (GPa)"),
    "latent_heat": plot_against("latent_heat", 1e3, "kJ/kg", "heat of fusion", 1e9, "pressure (GPa)"),
    "liquid_density": plot_against("liquid_density", 1e3, "g/cm$^3$", "saturated melt", 1.0, "temperature (K)"),
    "vapour_density": plot_against("vapour_density", 1e3, "g/cm$^3$", "saturated vapour", 1.0, "temperature (K)"),
}

def plot_correction(name, kinds, unit, abscissa, abscissa_label):
    """Data less model, before (upper panel) and after the correction of the free energy."""
    def draw(data, top, bottom):
        v0 = data["reference_volume"]
        for kind in sorted({row["kind"] for row in chosen(data, kinds)}):
            table = [row for row in chosen(data, kinds) if row["kind"] == kind]
            x = [row["volume"] / v0 if abscissa == "volume" else row["temperature"] for row in table]
            top.plot(x, [100 * row["gray"] for row in table], "o", ms=3.5, fillstyle="none", label=kind)
            bottom.errorbar(x, [100 * row["corrected"] for row in table], yerr=[100 * row["error"] for row in table], fmt="o",
                            ms=3, lw=0.8, capsize=2)
        top.axhline(0.0, color="0.4", lw=0.8)
        bottom.axhline(0.0, color="0.4", lw=0.8)
        top.set_ylabel(f"{name}: simulated less GRAY\n({unit})")
        top.legend(frameon=False, fontsize=7)
        bottom.set_ylabel("less corrected")
        bottom.set_xlabel(abscissa_label)

    return draw


def chosen(data, kinds):
    return [row for row in data.get("correction", []) if any(kind in row["kind"] for kind in kinds)]


def of_states(quantity):
    return tuple(f"{kind}, {quantity}" for kind in ("isotherm", "isochore", "shock", "melt"))


# Panels of a correction: what is drawn, kinds of data, unit, abscissa.
CORRECTIONS = [
    ("pressure", (*of_states("pressure"), "zero pressure"), "% of $\\rho_0 C^2$", "volume", "$V/V_0$"),
    ("energy", of_states("energy"), "% of 3RT", "volume", "$V/V_0$"),
    ("melting", ("coexistence, Gibbs", "coexistence, heat", "melting line"), "% of $T_m$ and of the heat", "temperature",
     "temperature (K)"),
    ("films", ("film",), "% of $RT$ and of $RT/V$", "temperature", "temperature (K)"),
]
MOST_COLUMNS = 3  # of panels: more cannot be read at the width of a page


def main():
    if len(sys.argv) != 3:
        asked = sys.argv[1:] in (["--help"], ["-h"])
        print(__doc__, file=sys.stdout if asked else sys.stderr)
        sys.exit(0 if asked else 2)
    with open(sys.argv[1], encoding="utf-8") as file:
        data = json.load(file)
    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    panels = [draw for quantity, draw in PANELS.items() if rows(data, quantity) is not None]
    panels += [plot_correction(*panel) for panel in CORRECTIONS if chosen(data, panel[1])]
    columns = min(len(panels), MOST_COLUMNS)
    lines = -(-len(panels) // columns)
    figure = plt.figure(figsize=(4.2 * columns, 5.2 * lines), layout="constrained")
    grid = figure.add_gridspec(2 * lines, columns, height_ratios=(3, 1) * lines)
    for i, draw in enumerate(panels):
        line, column = divmod(i, columns)
        top = figure.add_subplot(grid[2 * line, column])
        bottom = figure.add_subplot(grid[2 * line + 1, column], sharex=top)
        top.tick_params(labelbottom=False)
        draw(data, top, bottom)
    figure.suptitle(f"{data['model']} fitted to {data['title']}")
    save_figure(figure, sys.argv[2], dpi=200)


if __name__ == "__main__":
    main()
