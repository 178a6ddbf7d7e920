# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the cloud from the side: every particle a lit sphere, every element its lit faces."""
import pathlib
from collections.abc import Iterator

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import PIL.Image
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from report import render as rendering
from report import units
from report.analysis import AXES, Analysis, Geometry
from report.files import write_whole
from report.run import Run
from report.snapshot import PHASES, Snapshot

PHASE_COLOURS = ("#5f7f9f", "#f4b942", "#d7402b", "#8e5bc9")
BODY_COLOURS = ("#c8762f", "#8fa3b5", "#5aa469", "#b5547a", "#6d6fc4", "#c9b037", "#4aa5b5", "#8c6d5a")
BACKGROUND = np.array([0.985, 0.985, 0.99])
PANEL_WIDTH = 6.6        # inches of the rendered image: at least that of the widest of several panels
SHOWN_MASS = 0.9995      # limits of the pictures hold this share of the mass
MOVING = 0.05            # of the impact speed: what is faster sets the scales


def quantile(values: np.ndarray, weights: np.ndarray, share: float) -> float:
    """Finds the value below which `share` of the weight lies; NaN of nothing."""
    if len(values) == 0:
        return np.nan
    order = np.argsort(values)
    cumulative = np.cumsum(weights[order])
    return float(values[order[min(np.searchsorted(cumulative, share * cumulative[-1]), len(values) - 1)]])


class View:
    """The projection of all pictures: limits common to all times, so that the growth is seen."""

    def __init__(self, geo: Geometry, snapshots: list[Snapshot], dots_per_inch: int):
        self.geo = geo
        self.mirrored = geo.mirrored
        self.depth_copies = 2 if geo.depth in geo.planes else 1
        self._label_axes()
        edge = (1 - SHOWN_MASS) / 2
        lower, upper, reach_up, reach_down = np.inf, -np.inf, 0.0, 0.0
        for s in snapshots:
            if len(s) == 0:
                continue
            axial, up, _ = self.coordinates(s.position)
            lower = min(lower, quantile(axial, s.mass, edge))
            upper = max(upper, quantile(axial, s.mass, 1 - edge))
            reach_up = max(reach_up, quantile(up, s.mass, 1 - edge))
            reach_down = min(reach_down, quantile(up, s.mass, edge))
        if not np.isfinite(lower):
            lower, upper, reach_up = 0.0, 1.0, 1.0
        pad = 0.04 * max(upper - lower, 1e-12)
        if self.mirrored:
            reach_up = max(abs(reach_up), abs(reach_down))
            reach_down = -reach_up
        self.limits = (lower - pad, upper + pad, reach_down - pad, reach_up + pad)  # m
        width = round(PANEL_WIDTH * dots_per_inch)
        self.pixel = (self.limits[1] - self.limits[0]) / width
        self.shape = (int(np.ceil((self.limits[3] - self.limits[2]) / self.pixel)), width)

    def coordinates(self, position: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Computes the coordinates along the axis of flight, upward, toward the viewer (m, from the axis)."""
        offset = position - self.geo.centre
        return self.geo.sign * offset[:, self.geo.axis], offset[:, self.geo.up], -offset[:, self.geo.depth]

    def _label_axes(self):
        across, up = self.geo.axis_name(), AXES[self.geo.up]
        self.labels = ((f"{across} (mm)", f"{up} (mm)") if self.geo.oblique else
                       (f"along the flight, {across} (mm)", f"across, {up} (mm)"))

    def extent(self, limits: tuple) -> list[float]:
        """Converts limits from the axis (m) in coordinates of the model, mm."""
        middle = self.geo.centre[self.geo.up]
        return [units.MILLIMETRES * (limit + offset) for limit, offset in zip(limits, (0.0, 0.0, middle, middle))]

    def aspect(self) -> float:
        """Computes height over width of a picture."""
        return self.shape[0] / self.shape[1]


def radii(snapshot: Snapshot, geo: Geometry) -> np.ndarray:
    """Computes half the size of a particle's material; 0 if the density was not written."""
    if snapshot.density is None:
        return np.zeros(len(snapshot))
    return 0.5 * geo.edges(snapshot.mass / np.maximum(snapshot.density, 1e-3), snapshot.position)


def render(snapshot: Snapshot, view: View, outside: bool) -> tuple[np.ndarray, np.ndarray]:
    """Finds the number of the particle or element seen in each pixel of the completed side view, and the light.
    `outside` looks at the cloud from outside; otherwise it is cut along the plane of sight through its axis."""
    axial, up, toward = view.coordinates(snapshot.position)
    shown = np.full(len(snapshot), True) if outside or view.geo.planar else toward <= 0
    canvas = rendering.Canvas(view.shape)
    particles = np.flatnonzero(shown[:snapshot.particles])
    elements = np.flatnonzero(shown[snapshot.particles:])
    owner, corners = rendering.surface_faces(snapshot.connectivity[elements])
    labels = snapshot.particles + elements[owner]
    nodes = np.stack(view.coordinates(snapshot.nodes), axis=1)
    radius = radii(snapshot, view.geo)[particles] / view.pixel
    for side in (1, -1) if view.mirrored else (1,):
        def place(axial, up, toward):
            if outside and view.depth_copies == 2:
                toward = np.abs(toward)
            return np.stack([(axial - view.limits[0]) / view.pixel, (side * up - view.limits[2]) / view.pixel,
                             toward / view.pixel], axis=-1)
        canvas.quadrilaterals(place(*nodes.T)[corners], labels)
        x, y, z = place(axial[particles], up[particles], toward[particles]).T
        canvas.spheres(x, y, z, radius, particles)
    return canvas.picture()


def paint(rendered: tuple[np.ndarray, np.ndarray], colours: np.ndarray) -> np.ndarray:
    """Makes the RGB image (8 bit) of a rendered view; `colours` has one RGB row per particle."""
    seen, light = rendered
    image = np.broadcast_to(BACKGROUND, (*seen.shape, 3)).copy()
    hit = seen >= 0
    image[hit] = np.clip(colours[seen[hit]] * light[hit][:, None] * 1.12, 0, 1)
    return np.round(255 * image).astype(np.uint8)


def phase_colours(snapshot: Snapshot) -> np.ndarray:
    """Colours particles by phase: one RGB row each."""
    palette = np.array([matplotlib.colors.to_rgb(c) for c in PHASE_COLOURS])
    return palette[np.minimum(snapshot.phase, len(palette) - 1)]


def body_colours(snapshot: Snapshot) -> np.ndarray:
    """Colours particles by body: one RGB row each."""
    palette = np.array([matplotlib.colors.to_rgb(c) for c in BODY_COLOURS])
    return palette[snapshot.body.astype(int) % len(palette)]


def scale_colours(values: np.ndarray, norm: Normalize, name: str) -> np.ndarray:
    """Colours values by a scale of matplotlib: one RGB row each."""
    return matplotlib.colormaps[name](norm(values))[:, :3]


def panels(view: View, images: list[np.ndarray], times: list[float], title: str, legend: list[Patch] | None = None,
           bar: tuple | None = None, interpolation: str = "antialiased") -> Figure:
    """Draws one image per time, with axes in mm, and a legend or a colour bar (mappable, label)."""
    columns = min(2 if view.aspect() < 0.75 else 3, len(images))
    rows = -(-len(images) // columns)
    width = {1: 8.0, 2: 11.0, 3: 13.0}[columns]
    panel = (width - 0.9) / columns * view.aspect()
    figure, axes = plt.subplots(rows, columns, figsize=(width, rows * (panel + 0.35) + 1.1), squeeze=False,
                                sharex=True, sharey=True, layout="constrained")
    limits = view.extent(view.limits)
    for ax in axes.flat[len(images):]:
        ax.set_visible(False)
    for ax, image, time in zip(axes.flat, images, times):
        ax.imshow(image, origin="lower", extent=limits, interpolation=interpolation, aspect="equal")
        ax.set_title(f"t = {units.time(time)}", fontsize=10, loc="left")
        for side in ax.spines.values():
            side.set_color("#b0b4ba")
        ax.tick_params(colors="#444", labelsize=8)
    for ax in axes[-1, :]:
        ax.set_xlabel(view.labels[0], fontsize=9)
    for ax in axes[:, 0]:
        ax.set_ylabel(view.labels[1], fontsize=9)
    figure.suptitle(title, fontsize=12, fontweight="bold")
    if legend:
        legend_below(figure, legend, [patch.get_label() for patch in legend])
    if bar:
        mappable, label = bar
        figure.colorbar(mappable, ax=axes, location="bottom", shrink=0.6, aspect=45, pad=0.03, label=label)
    return figure


def save(figure: Figure, path: pathlib.Path, dots_per_inch: int) -> None:
    """Draws once and writes the PNG (`savefig` draws a constrained layout twice)."""
    figure.set_dpi(dots_per_inch)
    figure.canvas.draw()
    image = PIL.Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    write_whole(path, lambda stream: image.save(stream, format="PNG"))
    plt.close(figure)


def legend_below(figure: Figure, handles: list, labels: list[str]) -> None:
    """Adds a legend in a row below all panels."""
    room = 0.4 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, room, 1, 1 - room))
    figure.legend(handles, labels, loc="lower center", ncols=len(labels), frameon=False, fontsize=10)


def speed(snapshot: Snapshot) -> np.ndarray:
    """Computes the magnitude of the velocity, km/s."""
    return units.KM_PER_SECOND * np.linalg.norm(snapshot.velocity, axis=1)


FAILURE_COLOURS = ("#8fa3b5", "#d7402b", "#c9b037", "#b5547a", "#6d6fc4", "#c8762f", "#8c6d5a", "#5aa469",
                   "#2f4b7c")
FAILURE_NAMES = ("intact", "tension", "plastic strain", "principal stress", "principal strain", "ductile damage",
                 "fragmentation", "growth of voids", "accumulated tension")


def failure_colours(snapshot: Snapshot) -> np.ndarray:
    """Colours particles by what they failed by: one RGB row each."""
    palette = np.array([matplotlib.colors.to_rgb(c) for c in FAILURE_COLOURS])
    return palette[np.minimum(snapshot.failed.astype(int), len(palette) - 1)]


def moving(snapshot: Snapshot, least: float) -> np.ndarray:
    """Selects the particles faster than a speed (m/s), all where there is none: cold walls at rest set no scale."""
    chosen = np.linalg.norm(snapshot.velocity, axis=1) > least
    return chosen if chosen.any() else np.full(len(snapshot), True)


def _range(snapshots, values_of, low, high, least_speed):
    """Quantiles over the mass that moves, in all snapshots but the first, which is before the impact."""
    chosen = [(values_of(s)[m], s.mass[m]) for s in snapshots[1:] or snapshots if len(s)
              for m in [moving(s, least_speed)]]
    values = np.concatenate([v for v, _ in chosen] or [np.zeros(1)])
    weights = np.concatenate([w for _, w in chosen] or [np.ones(1)])
    return quantile(values, weights, low), quantile(values, weights, high)


# Fields that are shown by a scale: name of the file, meaning, unit, colours, values of a snapshot.
SCALED = (("temperature", "temperature", " (K)", "inferno", lambda s: s.temperature),
          ("pressure", "pressure", " (GPa)", "magma", 
           lambda s: None if s.pressure is None else units.GIGAPASCALS * s.pressure),
          ("speed", "speed", " (km/s)", "cividis", speed),
          ("plastic_strain", "plastic strain", "", "viridis", lambda s: s.plastic_strain),
          ("damage", "damage", "", "viridis", lambda s: s.damage))


def cloud_figures(run: Run, view: View, snapshots: list[Snapshot]) -> Iterator[tuple[str, str, Figure]]:
    """Yields (file name, caption, figure) of every picture that the fields of the snapshots allow."""
    times = [s.time for s in snapshots]
    cuts = [render(s, view, outside=False) for s in snapshots]
    complete = " The model is completed at its symmetry planes." if run.symmetry_planes else ""
    cut_text = ("Section through the axis: particles are rings." if view.geo.dimension == "axisymmetric" else
                "Section." if view.geo.planar else
                "Section through the axis, particles and elements behind the cut, the nearest in front.") + complete
    if all(s.body is not None for s in snapshots):
        names = run.body_names(snapshots[0])
        legend = [Patch(color=BODY_COLOURS[i % len(BODY_COLOURS)], label=name) for i, name in enumerate(names)]
        if not view.geo.planar:
            images = [paint(render(s, view, outside=True), body_colours(s)) for s in snapshots]
            yield ("cloud_outside.png", "Side view from outside, coloured by body." + complete,
                   panels(view, images, times, "From outside", legend=legend))
        yield ("cloud_body.png", cut_text + " Coloured by body.",
               panels(view, [paint(c, body_colours(s)) for c, s in zip(cuts, snapshots)], times,
                      "Section, by body", legend=legend))
    if all(s.phase is not None for s in snapshots):
        legend = [Patch(color=c, label=name) for c, name in zip(PHASE_COLOURS, PHASES)]
        yield ("cloud_phase.png", cut_text + " Coloured by phase.",
               panels(view, [paint(c, phase_colours(s)) for c, s in zip(cuts, snapshots)], times,
                      "Section, by phase", legend=legend))
    if all(s.failed is not None for s in snapshots) and any(s.failed.any() for s in snapshots):
        seen = sorted({int(code) for s in snapshots for code in np.unique(s.failed)})
        legend = [Patch(color=FAILURE_COLOURS[code], label=FAILURE_NAMES[code]) for code in seen
                  if code < len(FAILURE_NAMES)]
        yield ("cloud_failed.png", cut_text + " Coloured by what the matter failed by.",
               panels(view, [paint(c, failure_colours(s)) for c, s in zip(cuts, snapshots)], times,
                      "Section, by failure", legend=legend))
    for field, name, unit, palette, values_of in SCALED:
        if any(values_of(s) is None for s in snapshots) or not any(values_of(s).any() for s in snapshots):
            continue
        low, high = _range(snapshots, values_of, 0.002, 0.998, MOVING * view.geo.impact_speed)
        norm = Normalize(low, max(high, low + 1e-3 * max(abs(low), 1e-3)))
        images = [paint(c, scale_colours(values_of(s), norm, palette)) for c, s in zip(cuts, snapshots)]
        yield (f"cloud_{field}.png", f"{cut_text} Coloured by {name}; the scale is that of the mass that moves, "
               "its ends hold the 0.2 % beyond.",
               panels(view, images, times, f"Section, by {name}",
                      bar=(plt.cm.ScalarMappable(norm, palette), name + unit)))


def radiograph_figure(analysis: Analysis, view: View) -> Figure:
    """Draws the areal density as grey, the transmission of the absorbers that the analysis was told."""
    pictures = analysis.pictures
    left, right, below, above = pictures[0].extent
    aspect = (above - below) / (right - left)
    columns = min(2 if aspect < 0.75 else 3, len(pictures))
    rows = -(-len(pictures) // columns)
    width = {1: 8.0, 2: 11.0, 3: 13.0}[columns]
    figure, axes = plt.subplots(rows, columns, figsize=(width, rows * ((width - 0.9) / columns * aspect + 0.35) + 1.1),
                                squeeze=False, sharex=True, sharey=True, layout="constrained")
    for ax in axes.flat[len(pictures):]:
        ax.set_visible(False)
    # Contrast for the cloud of the last picture: black at eight times the optical depth of its middle pixel.
    matter = pictures[-1].transmission[pictures[-1].transmission < 0.998]
    darkest = max(float(np.median(matter))**8, 1e-3) if matter.size else 0.5
    norm = Normalize(darkest, 1.0)
    for ax, picture in zip(axes.flat, pictures):
        ax.imshow(picture.transmission, origin="lower", extent=view.extent(picture.extent), cmap="gray", norm=norm,
                  interpolation="bilinear", aspect="equal")
        ax.set_title(f"t = {units.time(picture.time)}", fontsize=10, loc="left")
        ax.tick_params(colors="#444", labelsize=8)
    for ax in axes[-1, :]:
        ax.set_xlabel(view.labels[0], fontsize=9)
    for ax in axes[:, 0]:
        ax.set_ylabel(view.labels[1], fontsize=9)
    figure.suptitle("Synthetic radiograph", fontsize=12, fontweight="bold")
    figure.colorbar(plt.cm.ScalarMappable(norm, "gray"), ax=axes, location="bottom", shrink=0.6, aspect=45, pad=0.03,
                    label="transmission")
    return figure
