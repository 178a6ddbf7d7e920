#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures and tables of a run: one self-contained HTML page with its PNG files beside it.

usage: report.py RUN_DIR [--output DIR] [--figure TITLE=FILE.png]... [--times N] [--dpi N]

Reads run.toml, history.csv, the snapshots of RUN.particles.hdf.series and analysis.h5 in the folder of the report, which
`whipple analyse` makes (`whipple report` calls both; docs/manual/output.md). Columns and fields that the run did not
write are left out. A quarter or half model is reported as the full problem (masses, momentum and
energies times 4 or 2), with the figures of the model beside it where both matter.
Exit code 2 if the folder is not that of a run.
"""
import argparse
import json
import math
import pathlib
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    import numpy as np
    import report_curves
    import report_gauges
    import report_metrics
    import report_pictures
    import report_planar
    import report_sensitivity
    from report_data import AXES, PHASES, NotARun, Run, Snapshot
    from report_files import write_whole
    from report_html import Page
except ImportError as missing:
    sys.exit(f"report: error: {missing}; install python3-numpy python3-h5py python3-matplotlib")

# Clamps are counted by the solver and shown if there were any.
COUNTED = (("below_cold_curve", "points clamped to the cold curve"),
           ("at_pressure_floor", "points held at the floor of their pressure"),
           ("limited_volume_changes", "limited changes of volume"),
           ("limited_densities", "points held at the least density"),
           ("limited_void_steps", "limited changes beside voids"),
           ("limited_bulking", "limited bulking"),
           ("limited_domains", "limited domains"),
           ("held_time_steps", "steps longer than compression asks for"))
# What took kinetic energy from the motion, and where it is (docs/theory/dissipation.md).
DISSIPATION = (("viscous_work", "artificial viscosity", "internal energy"),
               ("plastic_work", "plastic work", "internal energy (and stored cold work)"),
               ("contact_heat", "contact, normal", "internal energy"),
               ("friction_heat", "contact, friction", "internal energy"),
               ("transfer_heat", "transfers between particles and grid", "internal energy"),
               ("unresolved_kept", "transfers and viscosity", "unresolved motion"),
               ("unresolved_returned", "unresolved motion where gaps close", "internal energy"),
               ("conducted_heat", "conduction inside shocks", "moved between particles"))
FINER_CELLS_ADVISED = 0.05  # of the kinetic energy, unresolved
# Columns of the table of bodies: heading and factor.
BODY_COLUMNS = {"mass": ("mass (g)", 1e3), "axial_momentum": ("axial momentum (kg m/s)", 1),
                "mean_axial_velocity": ("mean axial velocity (m/s)", 1), "kinetic_energy": ("kinetic energy (J)", 1),
                "internal_energy": ("internal energy (J)", 1), "mean_temperature": ("mean temperature (K)", 1),
                **{f"{p}_fraction": (f"{p} (%)", 100) for p in (*PHASES, "failed")}}


def number(value, digits=4):
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    return f"{value:.{digits}g}"


class Report:
    def __init__(self, run, output, picture_times, dots_per_inch):
        self.run, self.output, self.picture_times = run, output, picture_times
        self.dots_per_inch = dots_per_inch
        output.mkdir(parents=True, exist_ok=True)
        origin = run.input.get("provenance", {})
        facts = [origin[key] for key in ("program", "machine", "started") if key in origin]
        self.page = Page(run.title, " · ".join(map(str, [run.folder.resolve(), *facts])))
        self.metrics = {"title": run.title, "multiplicity": run.multiplicity}

    def add_figure(self, name, caption, figure):
        if figure is None:
            return
        path = self.output / name
        report_pictures.save(figure, path, self.dots_per_inch)
        self.page.image(path, caption)

    def summary(self):
        run, history = self.run, self.run.history
        tiles = []
        if history.last("time") is not None:
            tiles.append(("physical time", f"{1e6 * history.last('time'):.4g} µs"))
        if history.last("step") is not None:
            tiles.append(("steps", f"{history.last('step'):.0f}"))
        if history.last("particles") is not None:
            tiles.append(("particles", f"{history.last('particles'):,.0f}"))
        if history.last("elements"):
            tiles.append(("elements", f"{history.last('elements'):,.0f}"))
        if history.last("mass") is not None:
            tiles.append(("mass" + (", full problem" if run.multiplicity > 1 else ""),
                          report_curves.format_mass(run.multiplicity * history.last("mass"))))
        if history.last("outflow_mass"):
            tiles.append(("left through the border",
                          report_curves.format_mass(run.multiplicity * history.last("outflow_mass"))))
        if "energy_error" in history:
            tiles.append(("largest energy error", number(float(abs(history["energy_error"]).max()), 2)))
        if "momentum_error" in history:
            tiles.append(("largest momentum error", number(float(abs(history["momentum_error"]).max()), 2)))
        for name, meaning in COUNTED:
            if history.last(name):
                tiles.append((meaning, f"{history.last(name):.0f}"))
        self.page.tiles(tiles)
        if run.multiplicity > 1:
            planes = ", ".join(AXES[axis] for axis in sorted(run.symmetry_planes))
            self.page.note(f"Symmetry planes normal to {planes}: the model is 1/{run.multiplicity} of the problem. "
                           f"Masses, axial momentum and energies below are those of the full problem "
                           f"({run.multiplicity} times the model) unless they are said to be of the model.")

    def input(self):
        run = self.run
        self.page.heading("Input")
        rows = []
        for body in run.input.get("body", []):
            velocity = body.get("velocity", "")
            discretization = body.get("discretization", {})
            shape = body.get("shape", {})
            rows.append([body.get("name", ""), body.get("material", ""),
                         describe_value(velocity), describe_discretization(discretization), describe_shape(shape)])
        if rows:
            self.page.table(["body", "material", "velocity", "discretization", "shape"], rows, text_columns=range(5))
        facts = []
        for table, keys in (("domain", ("lower", "upper", "cell_size", "boundary")),
                            ("time", ("end", "courant", "scheme")),
                            ("transfer", ("shape_function", "particle_update"))):
            values = run.input.get(table, {})
            for key in keys if isinstance(values, dict) else ():
                if key in values:
                    facts.append([f"{table}.{key}", describe_value(values[key])])
        if facts:
            self.page.table(["setting", "value"], facts, text_columns=(0, 1))
        self.page.details("complete input (run.toml)", run.input_text)

    def given_figures(self, figures):
        for title, path in figures:
            self.page.heading(title)
            (self.output / path.name).write_bytes(path.read_bytes())
            self.page.image(self.output / path.name, title)

    def cloud(self):
        run, path = self.run, self.output / "analysis.h5"
        if not run.entries:
            self.page.note("The run has no snapshots: no pictures and no measures of the cloud.")
            return
        analysis = report_metrics.Analysis(path)
        shown = [Snapshot(*run.entries[i]) for i in run.spread(self.picture_times)]
        if not any(len(snapshot) for snapshot in shown):
            self.page.note("The snapshots hold no particles and no elements: no pictures and no measures of the cloud.")
            return
        self.page.heading("Debris cloud")
        view = report_pictures.View(run, analysis.geometry, shown, self.dots_per_inch)
        for name, caption, figure in report_pictures.cloud_figures(run, view, shown):
            self.add_figure(name, caption, figure)
        self.add_figure("radiograph.png", f"Transmission along the line of sight through the complete problem, blurred "
                        f"over a spot of {1e3 * analysis.spot:.3g} mm: what a flash radiograph shows, without the response "
                        f"of a film.", report_pictures.radiograph_figure(analysis, view))
        self.extent(analysis)
        self.add_figure("surfaces.png", "Depth of the crater on the axis and diameter at the original surface; diameter "
                        "within which less than half of a plate is left.", report_curves.surface_figure(analysis))
        fragments = report_curves.fragment_figure(analysis)
        if fragments is not None:
            self.page.heading("Fragments of the debris")
        self.add_figure("fragments.png", "Number of fragments of at least a mass (connected particles of condensed "
                        "matter; fragments cut by symmetry planes are completed).", fragments)
        self.add_figure("witness.png", "Loads on the witness plate if the debris flies on freely.",
                        report_curves.witness_figure(analysis))
        self.final_table(shown[-1].time, analysis)
        report_planar.add_to(self.page, self.output, analysis, run.history)

    def extent(self, analysis):
        columns = analysis.series
        if not np.isfinite(columns["mean_velocity"]).any():
            return
        self.page.heading("Front, rear and radius of the cloud")
        for name, what in (("front", "front"), ("radius", "side")):
            gone = ~np.isfinite(columns[name]) & np.isfinite(columns["mean_velocity"])
            if gone.any():
                self.page.note(f"The {what} of the debris reached the border of the domain at "
                               f"{1e6 * columns['time'][gone][0]:.4g} µs: it is not followed further, and the "
                               f"table below counts what is still inside.")
        self.add_figure("extent.png", "Position and speed of the debris. " + "; ".join(
            f"{name}: {text}" for name, text in report_metrics.DEFINITIONS
            if name in ("front, rear", "radius", "radial speed")) + ".", report_curves.extent_figure(columns))

    def final_table(self, time, analysis):
        run, geo, final = self.run, analysis.geometry, analysis.quantity
        self.page.heading(f"Cloud at {1e6 * time:.4g} µs")
        residual = final(f"mean_velocity.{geo.projectile}")
        tiles = [
            ("impact speed", f"{number(1e-3 * geo.impact_speed)} km/s"),
            (f"residual velocity of {geo.projectile}", f"{number(1e-3 * residual)} km/s"),
            ("front speed", f"{number(1e-3 * final('front_speed'))} km/s"),
            ("rear speed", f"{number(1e-3 * final('rear_speed'))} km/s"),
            ("radial speed", f"{number(1e-3 * final('radial_speed'))} km/s"),
            ("half angle", f"{number(math.degrees(final('half_angle')))}°"),
            ("length", f"{number(1e3 * (final('front') - final('rear')))} mm"),
            ("diameter", f"{number(2e3 * final('radius'))} mm"),
            ("fragments of at least 8 particles", number(final("debris_fragments_resolved"), 6)),
        ]
        tiles += [(f"hole of {name.split('.')[1]}", f"{number(1e3 * value)} mm")
                  for name, value in analysis.final.items() if name.startswith("hole_diameter.") and value > 0]
        self.page.tiles(tiles)
        carried = [column for column in analysis.tables["bodies"] if column in BODY_COLUMNS]
        head = ["body", "part"] + (["mass of model (g)"] if run.multiplicity > 1 else []) + [
            BODY_COLUMNS[column][0] for column in carried]
        lines, strong = [], []
        for body, part, m in analysis.bodies:
            if part == "whole":
                strong.append(len(lines))
            model = [number(1e3 * m["mass"] / run.multiplicity)] if run.multiplicity > 1 else []
            lines.append([body if part == "whole" else "", part, *model,
                          *(number(BODY_COLUMNS[column][1] * m[column]) for column in carried)])
        self.page.table(head, lines, strong=strong, text_columns=(0, 1))
        self.page.definitions(report_metrics.DEFINITIONS)
        self.metrics |= {
            "time": time, "axis": geo.axis_name(), "impact_speed": geo.impact_speed, "projectile": geo.projectile,
            "residual_velocity": residual, "cloud": analysis.final,
            "bodies": [{"body": body, "part": part, **m} for body, part, m in analysis.bodies]}

    def curves(self):
        run = self.run
        if "time" not in run.history:
            self.page.note("The run has no history.csv: no curves.")
            return
        self.page.heading("Phases")
        phases = report_curves.phase_figure(run)
        if phases is None:
            self.page.note("The run wrote no masses of phases.")
        self.add_figure("phases.png", "Mass of each phase over time, as shares of the mass of the body.", phases)
        self.page.heading("Energy and momentum")
        self.add_figure("energy.png", "Energies, and the errors of their balance relative to the beginning.",
                        report_curves.energy_figure(run))
        self.page.heading("Time step and extreme states")
        self.add_figure("step.png", "Time step, largest pressure and temperature of any particle.",
                        report_curves.step_figure(run))

    def dissipation(self):
        history, scale = self.run.history, self.run.multiplicity
        rows = [[cause, number(scale * history.last(name), 4), into] for name, cause, into in DISSIPATION
                if history.last(name)]
        if not rows:
            return
        self.page.heading("Where the energy went")
        self.page.table(["cause", "energy (J)", "into"], rows, text_columns=(0, 2))
        share = history.last("unresolved_share")
        if share:
            text = (f"Unresolved motion: {number(scale * history.last('unresolved_energy'), 4)} J, "
                    f"{100 * share:.2g} % of the kinetic energy.")
            if share > FINER_CELLS_ADVISED:
                text += " Above 5 % the cells are too coarse for the motion of the fragments: finer ones would change the result."
            self.page.note(text)

    def gauges(self):
        history = report_gauges.read(self.run)
        figure = report_gauges.figure(history)
        if figure is not None:
            self.page.heading("Gauges")
            self.add_figure("gauges.png", "State at the gauges and tracers: " +
                            ", ".join(report_gauges.names(history)) + ".", figure)

    def write(self):
        path = self.output / "report.html"
        write_whole(path, lambda stream: stream.write(self.page.text().encode()))
        clean = json.loads(json.dumps(self.metrics), parse_constant=lambda _: None)  # JSON knows no NaN
        text = json.dumps(clean, indent=1) + "\n"
        write_whole(self.output / "metrics.json", lambda stream: stream.write(text.encode()))
        return path


UNITS = {"m": (("mm", 1e-3), ("µm", 1e-6)), "s": (("µs", 1e-6), ("ns", 1e-9)), "m/s": (("km/s", 1e3),)}
LEAST = 0.01  # of a unit, in which a value is given


def describe_value(value):
    """Text of a value of the input: words without program text, lengths, times and speeds in the units of the field."""
    if isinstance(value, dict):
        return ", ".join(f"{k.replace('_', ' ')} {describe_value(v)}" for k, v in value.items())
    if isinstance(value, list):
        return "(" + ", ".join(map(describe_value, value)) + ")"
    if isinstance(value, bool):
        return "yes" if value else "no"
    figure, _, unit = str(value).partition(" ")
    try:
        amount = float(figure)
    except ValueError:
        return str(value)
    for name, size in UNITS.get(unit, ()):
        if amount == 0:
            return "0"
        if abs(amount) >= LEAST * size:
            return f"{amount / size:.6g} {name}"
    return f"{amount:.6g} {unit}".strip() if unit else str(value)


def describe_discretization(keys):
    """What differs from nothing: empty texts and keys of meshes that are not there are left out."""
    if not isinstance(keys, dict):
        return str(keys)
    shown = {k: v for k, v in keys.items() if v not in ("", False) and k != "mesh_unit"}
    of_elements = keys.get("method") in ("finite_elements", "adaptive")
    for key in list(shown):
        if (key.startswith(("element", "hourglass")) and not of_elements) or (key.startswith("bar_") and
                                                                               keys.get("method") != "bars"):
            del shown[key]
    method = str(shown.pop("method", "")).replace("_", " ")
    return "; ".join(filter(None, [method, describe_value(shown)]))


def describe_shape(shape):
    if not isinstance(shape, dict):
        return str(shape)
    return "; ".join(f"{kind} ({describe_value(keys)})" for kind, keys in shape.items())


def parse_figure(text):
    title, separator, path = text.partition("=")
    if not separator or not title:
        raise argparse.ArgumentTypeError(f"{text!r}: give TITLE=FILE.png")
    path = pathlib.Path(path)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{path}: there is no such file")
    return title, path


def main(words=None):
    parser = argparse.ArgumentParser(prog="report", description="Figures and tables of a run as one HTML page.",
                                     epilog="example: report.py RUN_DIR --figure 'Hugoniot of copper=hugoniot.png'")
    parser.add_argument("run", metavar="RUN_DIR", help="folder that `whipple run` wrote")
    parser.add_argument("--output", metavar="DIR", help="folder of the report (default: RUN_DIR/report)")
    parser.add_argument("--figure", metavar="TITLE=FILE.png", action="append", default=[], type=parse_figure,
                        help="a figure to show before the pictures (Hugoniot, isotherm, ...); may be repeated")
    parser.add_argument("--times", metavar="N", type=int, default=6, help="pictures at so many times (default 6)")
    parser.add_argument("--dpi", metavar="N", type=int, default=180, help="dots per inch of the pictures (default 180)")
    arguments = parser.parse_args(words)
    try:
        run = Run(arguments.run)
        output = pathlib.Path(arguments.output) if arguments.output else run.folder / "report"
        run.symmetry_planes = report_metrics.symmetry_planes(output / "analysis.h5")
        report = Report(run, output, max(arguments.times, 1), max(arguments.dpi, 20))
        report.summary()
        report.input()
        report.given_figures(arguments.figure)
        report.cloud()
        report.curves()
        report.dissipation()
        report.gauges()
        report_sensitivity.add_to(report.page, run.input)
        print(report.write())
    except (NotARun, OSError) as error:
        print(f"report: error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
