# SPDX-License-Identifier: BSD-3-Clause
"""What an explosive does: arrival of the detonation at the gauges, mass of what it drives by velocity, expansion, pieces."""
import tomllib
from collections.abc import Callable

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from report import gauges, pieces, style, units
from report.analysis import AXES
from report.curves import legend_above, new_figure
from report.particles import particles_of
from report.expectations import quantity
from report.history import History
from report.page import Page
from report.run import Run
from report.units import number

LEAST_MASS = 1e-3  # fraction of a body down to which its velocities are shown
OUTER = 0.01  # fraction of a body that is farther out than its radius
MOVES = 10.0  # m/s
EXPANDS = 1.1  # radius over that at the start


def driven_bodies(run: Run) -> list[str]:
    """Returns the names of the bodies that are no explosive."""
    def explodes(material: str) -> bool:
        path = run.folder / material
        eos = tomllib.loads(path.read_text(encoding="utf-8")).get("eos", {}) if path.is_file() else {}
        return "unreacted" in eos or "detonation_energy" in eos

    return [body["name"] for body in run.input.get("body", []) if not explodes(body.get("material", ""))]


def arrivals(history: History) -> list[tuple[str, np.ndarray, float, float]]:
    """Returns of every gauge its name, place at the start (m), arrival (s), when the pressure is first half way from that at
    the start to the largest one, and this pressure (Pa); without those that no pressure reaches."""
    found = []
    for name in gauges.names(history):
        pressure = history[f"{name}.pressure"]
        if not np.isfinite(pressure).any():
            continue
        start, most = pressure[np.isfinite(pressure)][0], np.nanmax(pressure)
        if most > start:
            first = int(np.argmax(pressure >= 0.5 * (start + most)))
            found.append((name, np.array([history[f"{name}.{axis}"][0] for axis in "xyz"]),
                          float(history["time"][first]), float(most)))
    return found


def arrival_figure(found: list) -> Figure:
    """Draws the arrivals at many gauges over the coordinate along which they differ most."""
    places = np.array([place for _, place, _, _ in found])
    along = int(np.argmax(np.ptp(places, axis=0)))
    figure, (left, right) = new_figure(2)
    for ax, values, label in ((left, [units.MICROSECONDS * time for _, _, time, _ in found], "arrival (µs)"),
                              (right, [units.GIGAPASCALS * most for _, _, _, most in found], "largest pressure (GPa)")):
        ax.plot(units.MILLIMETRES * places[:, along], values, "o")
        ax.set(xlabel=f"{AXES[along]} at the start (mm)", ylabel=label)
    return figure


def mass_figure(run: Run, bodies: list[str]) -> Figure | None:
    """Draws the fraction of each body's mass that is faster along the axis than a velocity, at the last snapshot."""
    geo = run.analysis.geometry
    figure, (ax,) = new_figure(1)
    drawn = False
    for name in bodies:
        found = particles_of(run.folder, name)
        if found is None or len(found["mass"]) == 0:
            continue
        velocity = geo.sign * found["velocity"][:, geo.axis]
        order = velocity.argsort()[::-1]
        mass = found["mass"][order].cumsum() / found["mass"].sum()
        shown = mass >= LEAST_MASS
        if np.ptp(velocity[order][shown]) < MOVES and abs(velocity).max() < MOVES:
            continue
        ax.step(units.KM_PER_SECOND * velocity[order][shown], units.PERCENT * mass[shown], where="post", label=name)
        drawn = True
    if not drawn:
        plt.close(figure)
        return None
    ax.set(yscale="log", xlabel=f"velocity along {geo.axis_name()} (km/s)", ylabel="mass that is faster (% of the body)")
    ax.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    legend_above(ax)
    return figure


def axis_of_charge(run: Run) -> tuple[int, np.ndarray]:
    """Returns the axis about which bodies expand and a point of it (m): that of a line of detonators, else that of the pictures."""
    for detonation in run.input["detonation"]:
        begin, end = (np.array([quantity(x, "")[0] for x in detonation.get(key, [0, 0, 0])]) for key in ("position", "end"))
        along = np.flatnonzero(end - begin)
        if detonation.get("shape") == "line" and len(along) == 1:
            return int(along[0]), begin
    return run.analysis.geometry.axis, run.analysis.geometry.centre


def expansion_figure(run: Run, bodies: list[str]) -> Figure | None:
    """Draws the outer radius about the axis of the bodies that expand, and its speed from snapshot to snapshot."""
    axis_number, centre = axis_of_charge(run)
    across = [axis for axis in range(2 if run.analysis.geometry.planar else 3) if axis != axis_number]
    figure, (left, right) = new_figure(2)
    drawn = False
    for name in bodies:
        times, radii = [], []
        for _, time in run.entries:
            found = particles_of(run.folder, name, time)
            if found is None or len(found["mass"]) == 0:
                continue
            radius = np.sqrt(((found["position"] - centre)[:, across] ** 2).sum(axis=1))
            order = radius.argsort()[::-1]
            outer = found["mass"][order].cumsum() >= OUTER * found["mass"].sum()
            times.append(units.MICROSECONDS * time)
            radii.append(radius[order[outer.argmax()]])
        if len(radii) < 3 or max(radii) < EXPANDS * radii[0]:
            continue
        left.plot(times, units.MILLIMETRES * np.array(radii), "o-", label=name)
        middles = 0.5 * (np.array(times[1:]) + times[:-1])
        right.plot(middles, units.MILLIMETRES * np.diff(radii) / np.diff(times), "o-", label=name)  # mm/us = km/s
        drawn = True
    if not drawn:
        plt.close(figure)
        return None
    left.set_ylabel(f"outer radius about {AXES[axis_number]} (mm)")
    right.set_ylabel("speed of the radius (km/s)")
    legend_above(left)
    return figure


def piece_figure(run: Run, bodies: list[str]) -> Figure | None:
    """Draws the number of fragments over their mass of bodies that break, with N exp(-(m/m_c)^b) fitted to it."""
    if run.analysis.geometry.planar:
        return None  # a piece of the section is a ring or a bar
    figure, (ax,) = new_figure(1)
    drawn = 0
    shares = {body: row.get("failed_fraction", 0.0) for body, part, row in run.analysis.bodies if part == "whole"}
    for name in bodies:
        if not shares.get(name, 0.0) > 0.0:
            continue
        masses = pieces.masses_of(run.analysis.tables["fragments"], run.analysis.body_names.index(name))
        exponent, error, typical = (run.analysis.quantity(f"{kind}.{name}")
                                    for kind in ("piece_exponent", "piece_exponent_error", "piece_scale"))
        if not np.isfinite(exponent):
            continue
        colour = style.LINES[drawn % len(style.LINES)]
        order = np.argsort(masses.mass)
        mass, copies = masses.mass[order], masses.copies[order]
        ax.step(units.MILLIGRAMS * mass, masses.number - np.cumsum(copies) + copies, where="pre", color=colour,
                label=f"{name}: {masses.number} fragments, mean {units.mass(masses.mean)}; {units.percent(shares[name])} of the mass has "
                f"failed, {units.percent(run.analysis.quantity(f'loose_fraction.{name}'))} is in no fragment")
        along = np.linspace(0.0, mass[-1], 200)
        ax.plot(units.MILLIGRAMS * along, masses.number * np.exp(-((along / typical) ** exponent)), "--", color=colour,
                label=f"exponent b {exponent:.3g} ± {error:.1g}, m_c {units.mass(typical)}")
        drawn += 1
    if not drawn:
        plt.close(figure)
        return None
    ax.set(yscale="log", xlabel="mass m of a fragment (mg)", ylabel="fragments of at least m", ylim=(0.7, None))
    legend_above(ax, columns=1)
    return figure


def add_to(page: Page, run: Run, add_figure: Callable) -> None:
    """Adds the section of a run with detonators."""
    if not run.input.get("detonation") or run.analysis is None:
        return
    bodies = driven_bodies(run)
    found = arrivals(gauges.read(run))
    figures = [(name, caption, figure) for name, caption, figure in (
        ("mass_by_velocity.png", f"Mass of the bodies that the explosive drives by their velocity along the axis, at the last snapshot, "
         f"down to {units.percent(LEAST_MASS)} of each.", mass_figure(run, bodies)),
        ("expansion.png", f"Outer radius about the axis, which {units.percent(OUTER)} of the body's mass exceeds, and its speed from snapshot "
         "to snapshot.", expansion_figure(run, bodies)),
        ("pieces.png", "Number of fragments of at least a mass at the last snapshot, N(>m), and N exp(-(m/m_c)^b) fitted to them.",
         piece_figure(run, bodies))) if figure is not None]
    if not found and not figures:
        return
    page.heading("Explosive and what it drives")
    if 0 < len(found) <= gauges.FEW:
        page.table(["gauge", *(f"{axis} at the start (mm)" for axis in "xyz"), "arrival (µs)", "largest pressure (GPa)"],
                   [[name, *(number(units.MILLIMETRES * x) for x in place), number(units.MICROSECONDS * time),
                     number(units.GIGAPASCALS * most)] for name, place, time, most in found], text_columns=(0,))
        page.paragraph("Arrival: when the pressure first comes half way to the largest one.")
    elif found:
        add_figure("arrival.png", "Arrival at the gauges and tracers, when their pressure first comes half way to the largest one, and this "
                   "pressure.", arrival_figure(found))
    for name, caption, figure in figures:
        add_figure(name, caption, figure)
