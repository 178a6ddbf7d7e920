# SPDX-License-Identifier: BSD-3-Clause
"""Curves over time: energies, errors, phases, time step, front and radial speeds."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report import style, units
from report.analysis import Analysis
from report.history import History
from report.pictures import legend_below
from report.run import Run
from report.views import PHASES

MOST_PANELS = 4  # side by side


def new_figure(columns: int, height: float = 2.4) -> tuple[Figure, np.ndarray]:
    """Makes a figure of so many panels over time. `height` in inches."""
    figure, axes = plt.subplots(1, columns, figsize=(style.WIDTH if columns > 1 else style.NARROW, height), squeeze=False,
                                layout="constrained")
    for ax in axes.flat:
        ax.grid(True, color="#e3e5e8")
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
        ax.set_xlabel("time (µs)")
    return figure, axes[0]


def legend_above(ax: Axes, columns: int = 2) -> None:
    """Adds a legend in rows above a panel."""
    ax.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncols=columns, frameon=False, borderaxespad=0.2)


def lines(ax: Axes, history: History, names: list[tuple[str, str]], scale: float = 1.0) -> bool:
    """Draws the columns (name, label) that a history has. Returns whether there is one."""
    drawn = False
    for name, label in names:
        if name in history:
            ax.plot(units.MICROSECONDS * history["time"], scale * history[name], label=label)
            drawn = True
    return drawn


def only_phase(run: Run) -> str | None:
    """Returns the phase of all material at all times; None if there are several, or no masses of phases."""
    columns = {phase: f"mass_{phase}" for phase in PHASES}
    if not all(column in run.history for column in columns.values()):
        return None
    found = [phase for phase, column in columns.items() if (run.history[column] > 0).any()]
    return found[0] if len(found) == 1 else None


def phase_figure(run: Run) -> Figure | None:
    """Draws the mass of every phase over time as fractions of the mass, one panel per body, of the four of the largest mass
    at the start; None of a single phase."""
    history = run.history
    if only_phase(run):
        return None
    first = f"mass_{PHASES[0]}."
    bodies = [column.removeprefix(first) for column in history.columns if column.startswith(first)]
    groups = [(name, [f"mass_{p}.{name}" for p in PHASES]) for name in bodies]
    groups = [g for g in groups if all(column in history for column in g[1])]
    if not groups:
        groups = [("all bodies", [f"mass_{p}" for p in PHASES])]
        if not all(column in history for column in groups[0][1]):
            return None
    largest = sorted(groups, key=lambda group: -sum(history[column][0] for column in group[1]))[:MOST_PANELS]
    groups = [group for group in groups if group in largest]
    figure, axes = new_figure(len(groups))
    for ax, (name, columns) in zip(axes, groups):
        masses = np.array([history[c] for c in columns])
        total = np.maximum(masses.sum(axis=0), 1e-300)
        ax.stackplot(units.MICROSECONDS * history["time"], 100 * masses / total, colors=style.WORDS[:len(PHASES)], labels=PHASES,
                     linewidth=0, alpha=0.95)
        ax.set_title(f"{name}: {units.mass(run.multiplicity * total[-1])}", loc="left")
        ax.set_ylim(0, 100)
        ax.set_xlim(units.MICROSECONDS * history["time"][0], max(units.MICROSECONDS * history["time"][-1], 1e-12))
    axes[0].set_ylabel("fraction of the mass (%)")
    legend_below(figure, *axes[0].get_legend_handles_labels())
    return figure


def energy_figure(run: Run) -> Figure | None:
    """Draws the energies of the full problem, and the errors of the balances; None without columns of them."""
    history = run.history
    figure, (left, right) = new_figure(2)
    scale = run.multiplicity * 1e-3  # kJ
    drawn = lines(left, history, [("total_energy", "total"), ("kinetic_energy", "kinetic"),
                                  ("internal_energy", "internal"), ("affine_kinetic_energy", "affine kinetic"),
                                  ("unresolved_energy", "unresolved kinetic"),
                                  ("chemical_energy", "chemical, part of the internal"),
                                  ("outflow_energy", "left through the border")], scale)
    left.set_ylabel("energy (kJ)" + (", full problem" if run.multiplicity > 1 else ""))
    if drawn:
        legend_above(left)
    errors = lines(right, history, [("energy_error", "energy"), ("momentum_error", "momentum")])
    right.set_ylabel("relative error")
    right.yaxis.set_major_formatter(lambda value, _: f"{value:.2g}")
    if errors:
        legend_above(right)
    if drawn or errors:
        return figure
    plt.close(figure)
    return None


def step_figure(run: Run) -> Figure | None:
    """Draws time step, largest pressure and temperature; None without columns of them."""
    history = run.history
    figure, (left, middle, right) = new_figure(3)
    drawn = lines(left, history, [("dt", "time step")], units.NANOSECONDS)
    left.set_ylabel("time step (ns)")
    drawn |= lines(middle, history, [("maximum_pressure", "largest pressure")], units.GIGAPASCALS)
    middle.set_ylabel("largest pressure (GPa)")
    drawn |= lines(right, history, [("maximum_temperature", "largest temperature")])
    right.set_ylabel("largest temperature (K)")
    if drawn:
        return figure
    plt.close(figure)
    return None


def extent_figure(columns: dict[str, np.ndarray]) -> Figure:
    """Draws position and speed of front, rear and radius of the debris; `columns`: the series of the analysis."""
    figure, (left, right) = new_figure(2)
    time = units.MICROSECONDS * columns["time"]
    for name, label, colour, outer in (("front", "front", style.LINES[1], "foremost"), ("rear", "rear", style.LINES[0], None),
                                       ("radius", "radius", style.LINES[2], "outermost")):
        left.plot(time, units.MILLIMETRES * columns[name], "o-", color=colour, label=label)
        if outer:
            left.plot(time, units.MILLIMETRES * columns[outer], ":", color=colour, label=f"{outer} particle",
                      linewidth=1.0)
    left.set_ylabel("position of the debris (mm)")
    legend_above(left)
    for name, label, colour in (("front_speed", "front", style.LINES[1]), ("rear_speed", "rear", style.LINES[0]),
                                ("expansion_speed", "expansion of the radius", style.LINES[2]),
                                ("mean_velocity", "mean axial velocity", style.LINES[7]),
                                ("radial_speed", "radial speed exceeded by 0.1 %", style.LINES[3])):
        right.plot(time, units.KM_PER_SECOND * columns[name], "o-", color=colour, label=label)
    right.set_ylabel("speed (km/s)")
    legend_above(right)
    return figure


def fragment_figure(analysis: Analysis) -> Figure | None:
    """Draws the number of debris fragments over their mass, with the power law fitted to it."""
    table = analysis.tables["fragment_distribution"]
    if not table or len(table["mass"]) < 2:
        return None
    figure, (ax,) = new_figure(1)
    ax.step(units.MILLIGRAMS * table["mass"], table["number"], where="pre",
            label="debris fragments")
    exponent = analysis.quantity("fragment_exponent")
    if np.isfinite(exponent):
        mass, number = table["mass"], table["number"]
        middle = len(mass) // 2
        error = analysis.quantity("fragment_exponent_error")
        ax.plot(units.MILLIGRAMS * mass, number[middle] * (mass / mass[middle]) ** -exponent, "--", label=f"power law, exponent {exponent:.3g} ± {error:.2g}")
    ax.set(xscale="log", yscale="log", xlabel="mass m of a fragment (mg)", ylabel="fragments of at least m")
    ax.set_ylim(0.7, 1.5 * table["number"].max())
    legend_above(ax)
    return figure


def surface_figure(analysis: Analysis) -> Figure | None:
    """Draws craters, penetration and holes over time; None if there are none."""
    series = analysis.series
    labels = {"crater_depth": "depth of the crater", "crater_diameter": "diameter of the crater",
              "bulge": "bulge of the rear face", "penetration_depth": "depth of penetration", "hole_diameter": "hole"}
    # A legend for a single point says more than its curve; the bulge of a body that barely moves is none.
    few = min(3, len(series["time"]))
    least = {"bulge": 0.1 * analysis.cell_size}
    shown = [(name, f"{body}, {labels[measure]}") for name in series
             for measure, _, body in [name.partition(".")]
             if measure in labels and (np.nan_to_num(series[name]) > least.get(measure, 0.0)).sum() >= few]
    if not shown:
        return None
    figure, (ax,) = new_figure(1)
    for name, label in shown:
        ax.plot(units.MICROSECONDS * series["time"], units.MILLIMETRES * series[name], "o-", label=label)
    ax.set_ylabel("length (mm)")
    legend_above(ax)
    return figure


def loads_figure(analysis: Analysis, plane: str) -> Figure | None:
    """Draws the loads on a plane ("witness", "loads") by distance from the axis and over time; None without hits."""
    rings, flux = (analysis.tables.get(f"{plane}_{kind}") for kind in ("rings", "flux"))
    if not rings or not flux:
        return None
    figure, (left, right) = new_figure(2)
    for ax, table, x, scale, suffix, per in ((left, rings, "radius", units.MILLIMETRES, "_per_area", "/m²"),
                                             (right, flux, "time", units.MICROSECONDS, "_flux", "/s")):
        for name, unit in (("mass", "kg"), ("momentum", "N s"), ("energy", "J")):
            values = table[name + suffix]
            ax.plot(scale * table[x], values / max(values.max(), 1e-300),
                    label=f"{name}, highest {values.max():.3g} {unit}{per}")
    left.set(xlabel="distance from the axis (mm)", ylabel="per area, over the highest")
    right.set_ylabel("per time, over the highest")
    for ax in (left, right):
        ax.legend(loc="upper right", frameon=False)
    return figure
