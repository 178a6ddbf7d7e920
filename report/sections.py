# SPDX-License-Identifier: BSD-3-Clause
"""Sections of the page of a run.

Columns and fields that the run did not write are left out. A quarter or half model is reported as the full problem
(masses, momentum and energies times 4 or 2), with the figures of the model beside it where both matter.
"""
import json
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import numpy as np
from matplotlib.figure import Figure

from report import analysis as measures
from report import curves, expected, explosives, fits, gauges, pictures, planar, sensitivity, style, units
from report.analysis import AXES
from report.case_text import describe_discretization, describe_shape, describe_value
from report.files import encoded, write_whole
from report.page import Page
from report.run import Run
from report.units import number
from report.views import PHASES

DIMENSIONS = {
    "axisymmetric": "Axisymmetric model: particles are rings, and all masses, momenta and energies are those of whole "
                    "rings. A fragment of the section is a ring too: numbers and masses of fragments, petals and "
                    "everything that breaks the symmetry need three dimensions.",
    "plane_strain": "Plane strain: the same for all z. Masses, momenta and energies are those of 1 m along z."}
FINER_CELLS_ADVISED = 0.05  # of the kinetic energy, unresolved
NEARLY_AT_REST = 0.05  # of the largest kinetic energy
# Columns of the table of bodies: heading and factor.
BODY_COLUMNS = {"mass": ("mass (g)", units.GRAMS), "axial_momentum": ("axial momentum (kg m/s)", 1),
                "mean_axial_velocity": ("mean axial velocity (m/s)", 1), "kinetic_energy": ("kinetic energy (J)", 1),
                "internal_energy": ("internal energy (J)", 1), "mean_temperature": ("mean temperature (K)", 1),
                **{f"{p}_fraction": (f"{p} (%)", units.PERCENT) for p in (*PHASES, "failed")}}


class Report:
    """Builds the page of a run, with its figures beside it."""

    def __init__(self, run: Run, dots_per_inch: int):
        self.run, self.output = run, run.output
        self.dots_per_inch = dots_per_inch
        style.apply()
        self.output.mkdir(parents=True, exist_ok=True)
        origin = run.input.get("provenance", {})
        facts = [origin[key] for key in ("program", "machine", "started") if key in origin]
        self.page = Page(run.title, " · ".join(map(str, [run.folder.resolve(), *facts])))
        self.metrics = {"title": run.title, "multiplicity": run.multiplicity}

    def add_all(self, figures: list[tuple[str, pathlib.Path]], view: pathlib.Path | None = None) -> None:
        """Adds all sections. `figures`: titles and PNG files to show before the pictures; `view`: page of the view in
        three dimensions."""
        self._summary()
        self.metrics["expected"] = expected.add_to(self.page, self.run, self._add_figure)
        self._input()
        fits.add_to(self.page, self.run)
        self._given_figures(figures)
        self._cloud()
        self._view(view)
        explosives.add_to(self.page, self.run, self._add_figure)
        self._curves()
        self._dissipation()
        self._gauges()
        sensitivity.add_to(self.page, self.run.analysis)

    def _add_figure(self, name: str, caption: str, figure: Figure | None) -> None:
        if figure is None:
            return
        path = self.output / name
        width = style.share_of_page(figure)
        pictures.save(figure, path, self.dots_per_inch)
        self.page.image(pictures.small_copy(path), caption, width)

    def _summary(self):
        run, history = self.run, self.run.history
        tiles = []
        if history.last("time") is not None:
            tiles.append(("physical time", units.time(history.last("time"))))
        if history.last("step") is not None:
            tiles.append(("steps", f"{history.last('step'):.0f}"))
        if history.last("particles") is not None:
            tiles.append(("particles", f"{history.last('particles'):,.0f}"))
        if history.last("elements"):
            tiles.append(("elements", f"{history.last('elements'):,.0f}"))
        if history.last("mass") is not None:
            tiles.append(("mass" + (", full problem" if run.multiplicity > 1 else ""),
                          units.mass(run.multiplicity * history.last("mass"))))
        if history.last("outflow_mass"):
            tiles.append(("left through the border",
                          units.mass(run.multiplicity * history.last("outflow_mass"))))
        if "energy_error" in history:
            tiles.append(("largest energy error", units.error(float(abs(history["energy_error"]).max()))))
        if "momentum_error" in history:
            tiles.append(("largest momentum error", units.error(float(abs(history["momentum_error"]).max()))))
        for column in run.columns:
            if "limiter" in column and history.last(column["name"]):
                tiles.append((column["limiter"].replace("`", ""), f"{history.last(column['name']):.0f}"))
        if run.goes_on:
            measured = f", pictures and measures to {units.time(float(run.analysis.series['time'][-1]))}" if run.analysis else ""
            self.page.note(f"The run goes on: curves reach to {units.time(history.last('time') or 0.0)}{measured}, its end "
                           f"is {units.quantity(str(run.input.get('time', {}).get('end', 'not known')))}.")
            self.metrics["goes_on"] = True
        self.page.tiles(tiles)
        if run.ended_by:
            self.page.note(f"The run ended before its end time because {run.ended_by}.")
        if run.analysis and run.analysis.geometry.planar:
            self.page.note(DIMENSIONS[run.analysis.geometry.dimension])
        if run.multiplicity > 1:
            planes = ", ".join(AXES[axis] for axis in sorted(run.symmetry_planes))
            self.page.note(f"Symmetry planes normal to {planes}: the model is 1/{run.multiplicity} of the problem. "
                           f"Masses, axial momentum and energies below are those of the full problem "
                           f"({run.multiplicity} times the model) unless they are said to be of the model.")

    def _input(self):
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

    def _given_figures(self, figures):
        for title, path in figures:
            self.page.heading(title)
            (self.output / path.name).write_bytes(path.read_bytes())
            self.page.image(pictures.small_copy(path), title)

    def _cloud(self):
        run = self.run
        if not run.entries:
            self.page.note("The run has no snapshots: no pictures and no measures of the cloud.")
            return
        analysis = run.analysis
        if analysis.views and not any(view.items for view in analysis.views.times):
            self.page.note("The snapshots hold no particles and no elements: no pictures and no measures of the cloud.")
            return
        self.page.heading("Debris cloud" if analysis.is_impact else "Pictures")
        if analysis.views is None:
            self.page.note("The analysis has no views: pictures are made by `whipple report`.")
        else:
            for name, caption, figure in pictures.cloud_figures(run, analysis.views):
                self._add_figure(name, caption, figure)
        spot = units.MILLIMETRES * analysis.spot
        self._add_figure("radiograph.png", "Transmission along the line of sight through the complete problem, blurred "
                         f"over a spot of {spot:.3g} mm: what a flash radiograph shows, without the response of a "
                         "film. The scale is that of the cloud: what is denser, as walls, is black.",
                         pictures.radiograph_figure(analysis))
        self._extent(analysis)
        self._add_figure("surfaces.png", "Depth of craters on the axis and diameter at the original surface; bulge of rear faces; depth of "
                         "penetration; diameter within which less than half of a plate is left.",
                         curves.surface_figure(analysis))
        # A piece of a section is a ring or a bar.
        fragments = None if analysis.geometry.planar else curves.fragment_figure(analysis)
        if fragments is not None:
            self.page.heading("Fragments of the debris")
        self._add_figure("fragments.png", "Number of fragments of at least a mass (connected particles that have not failed, "
                         "with failed ones beside them; fragments cut by symmetry planes are completed).", fragments)
        self._add_figure("witness.png", "Loads on the witness plate if the debris flies on freely.",
                         curves.loads_figure(analysis, "witness"))
        self._final_table(float(analysis.series["time"][-1]), analysis)
        planar.add_to(self.page, self.output, analysis, run.history)
        self._add_figure("loads.png", "Loads on the plane in the course of the run: what has passed it until the end.",
                         curves.loads_figure(analysis, "loads"))

    def _view(self, view):
        if view is None:
            return
        self.page.heading("In three dimensions")
        self.page.frame(view.read_text(encoding="utf-8"), "The run in three dimensions")
        self.page.paragraph(f"The same as {view.name}. Drag to turn, with Shift to shift, wheel to come nearer; a click "
                            "on a particle shows its fields.")

    def _extent(self, analysis):
        columns = analysis.series
        if not analysis.has_debris:
            return
        self.page.heading("Front, rear and radius of the cloud")
        for name, what in (("front", "front"), ("radius", "side")):
            gone = ~np.isfinite(columns[name]) & np.isfinite(columns["mean_velocity"])
            if gone.any():
                self.page.note(f"The {what} of the debris reached the border of the domain at "
                               f"{units.time(columns['time'][gone][0])}: it is not followed further, and the "
                               f"table below counts what is still inside.")
        self._add_figure("extent.png", "Position and speed of the debris. " + "; ".join(
            f"{name}: {text}" for name, text in measures.DEFINITIONS
            if name in ("front, rear", "radius", "radial speed")) + ".", curves.extent_figure(columns))

    def _final_table(self, time, analysis):
        run, geo, final = self.run, analysis.geometry, analysis.quantity
        self.page.heading(f"{'Cloud' if analysis.is_impact else 'State'} at {units.time(time)}")
        residual = final(f"mean_velocity.{geo.projectile}")
        tiles = [("impact speed", f"{number(units.KM_PER_SECOND * geo.impact_speed)} km/s")] if geo.impact_speed > 0 else []
        tiles += [
            (f"{'residual' if geo.impact_speed > 0 else 'mean axial'} velocity of {geo.projectile}", f"{number(units.KM_PER_SECOND * residual)} km/s"),
            ("front speed", f"{number(units.KM_PER_SECOND * final('front_speed'))} km/s"),
            ("rear speed", f"{number(units.KM_PER_SECOND * final('rear_speed'))} km/s"),
            ("radial speed", f"{number(units.KM_PER_SECOND * final('radial_speed'))} km/s"),
            ("half angle", f"{number(math.degrees(final('half_angle')))}°"),
            ("length", f"{number(units.MILLIMETRES * (final('front') - final('rear')))} mm"),
            ("diameter", f"{number(2 * units.MILLIMETRES * final('radius'))} mm"),
        ]
        if analysis.has_debris:
            tiles.append(("fragments of at least 8 particles", number(final("debris_fragments_resolved"), 6)))
        tiles += [(f"{name.split('.', 1)[1]} in no fragment", units.percent(value))
                  for name, value in analysis.final.items() if name.startswith("loose_fraction.") and value > 0.001]
        tiles += [(f"hole of {name.split('.')[1]}", f"{number(units.MILLIMETRES * value)} mm")
                  for name, value in analysis.final.items() if name.startswith("hole_diameter.") and value > 0]
        tiles += [(f"{name.split('.', 1)[1]} perforated", "yes" if value else "no")
                  for name, value in analysis.final.items() if name.startswith("perforated.") and np.isfinite(value)]
        for measure, text, factor, unit, least in (("bulge", "bulge of {}", units.MILLIMETRES, "mm", 0.1 * analysis.cell_size),
                                                   ("spall_mass", "spall behind {}", units.GRAMS, "g", 0.0),
                                                   ("damaged_area", "damaged area of {}", 1e6, "mm²", 0.0)):
            tiles += [(text.format(name.split(".", 1)[1]), f"{number(factor * value)} {unit}")
                      for name, value in analysis.final.items() if name.startswith(f"{measure}.") and value > least]
        self.page.tiles((name, value) for name, value in tiles if not value.startswith(units.MISSING))
        carried = [column for column in analysis.tables["bodies"] if column in BODY_COLUMNS]
        head = ["body", "part"] + (["mass of model (g)"] if run.multiplicity > 1 else []) + [
            BODY_COLUMNS[column][0] for column in carried]
        lines, strong = [], []
        for body, part, m in analysis.bodies:
            if part != "whole" and m["mass"] == 0:
                continue
            if part == "whole":
                strong.append(len(lines))
            model = [number(units.GRAMS * m["mass"] / run.multiplicity)] if run.multiplicity > 1 else []
            lines.append([body if part == "whole" else "", part, *model,
                          *(number(BODY_COLUMNS[column][1] * m[column]) for column in carried)])
        self.page.table(head, lines, strong=strong, text_columns=(0, 1))
        self.page.definitions(measures.definitions(analysis.has_debris))
        self.metrics |= {
            "time": time, "axis": geo.axis_name(), "impact_speed": geo.impact_speed, "projectile": geo.projectile,
            "residual_velocity": residual, "cloud": analysis.final,
            "bodies": [{"body": body, "part": part, **m} for body, part, m in analysis.bodies]}

    def _curves(self):
        run = self.run
        if "time" not in run.history:
            self.page.note("The run has no history.csv: no curves.")
            return
        self.page.heading("Phases")
        phases = curves.phase_figure(run)
        if phases is None:
            only = curves.only_phase(run)
            self.page.paragraph(f"All material is {only} at all times." if only else "The run wrote no masses of phases.")
        self._add_figure("phases.png", "Mass of each phase over time, as fractions of the mass of the body; of more than four "
                         "bodies those of the largest mass.", phases)
        self.page.heading("Energy and momentum")
        self._add_figure("energy.png", "Energies, and the errors of the balances over the energy and the momentum that the run "
                         "exchanged.",
                         curves.energy_figure(run))
        self.page.heading("Time step and extreme states")
        self._add_figure("step.png", "Time step, largest pressure and temperature of any particle.",
                         curves.step_figure(run))

    def _dissipation(self):
        history, scale = self.run.history, self.run.multiplicity
        rows = [[column["taken_by"], number(scale * history.last(column["name"]), 4), column["taken_to"]]
                for column in self.run.columns if "taken_by" in column and history.last(column["name"])]
        if not rows:
            return
        self.page.heading("Where the energy went")
        self.page.table(["taken by", "energy (J)", "into"], rows, text_columns=(0, 2))
        share = history.last("unresolved_share")
        if share:
            unresolved, most = history.last("unresolved_energy"), float(history["kinetic_energy"].max())
            at_rest = history.last("kinetic_energy") < NEARLY_AT_REST * most
            text = (f"Unresolved motion: {number(scale * unresolved, 4)} J, "
                    + (f"{units.percent(unresolved / most)} of the largest kinetic energy; the bodies have come to rest."
                       if at_rest else f"{units.percent(share)} of the kinetic energy."))
            if share > FINER_CELLS_ADVISED and not at_rest:
                text += (" Above 5 % the cells are too coarse for the motion of the fragments: finer ones would change "
                         "the result.")
            self.page.note(text)

    def _gauges(self):
        history = gauges.read(self.run)
        figure = gauges.figure(history)
        if figure is not None:
            self.page.heading("Gauges")
            self._add_figure("gauges.png", "State at the gauges and tracers: " +
                            ", ".join(gauges.names(history)) + ".", figure)

    def write(self) -> pathlib.Path:
        """Writes report.html and metrics.json, each as a whole. Returns the path of the page."""
        path = self.output / "report.html"
        write_whole(path, lambda stream: stream.write(encoded(self.page.text())))
        clean = json.loads(json.dumps(self.metrics), parse_constant=lambda _: None)  # JSON knows no NaN
        text = json.dumps(clean, indent=1) + "\n"
        write_whole(self.output / "metrics.json", lambda stream: stream.write(encoded(text)))
        return path
