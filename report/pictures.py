# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the cloud from the side, coloured by body, phase, failure or the scale of a field."""
import pathlib
from collections.abc import Iterator

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import PIL.Image
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from report import units
from report.analysis import Analysis
from report.files import write_whole
from report.run import Run
from report.views import PHASES, Picture, Views

PHASE_COLOURS = ("#5f7f9f", "#f4b942", "#d7402b", "#8e5bc9")
BODY_COLOURS = ("#c8762f", "#8fa3b5", "#5aa469", "#b5547a", "#6d6fc4", "#c9b037", "#4aa5b5", "#8c6d5a")
BACKGROUND = np.array([0.985, 0.985, 0.99])


def paint(picture: Picture, colours: np.ndarray) -> np.ndarray:
    """Makes the RGB image (8 bit) of a picture; `colours` has one RGB row per item."""
    image = np.broadcast_to(BACKGROUND, (*picture.seen.shape, 3)).copy()
    hit = picture.seen >= 0
    image[hit] = np.clip(colours[picture.seen[hit]] * picture.light[hit][:, None] * 1.12, 0, 1)
    return np.round(255 * image).astype(np.uint8)


def class_colours(numbers: np.ndarray, colours: tuple[str, ...]) -> np.ndarray:
    """Colours items by the number of a class, those beyond the last as the last: one RGB row each."""
    palette = np.array([matplotlib.colors.to_rgb(colour) for colour in colours])
    return palette[np.minimum(numbers.astype(int), len(palette) - 1)]


def body_colours(bodies: np.ndarray) -> np.ndarray:
    """Colours items by body: one RGB row each."""
    return class_colours(bodies.astype(int) % len(BODY_COLOURS), BODY_COLOURS)


def scale_colours(values: np.ndarray, norm: Normalize, name: str) -> np.ndarray:
    """Colours values by a scale of matplotlib: one RGB row each."""
    return matplotlib.colormaps[name](norm(values))[:, :3]


def panels(views: Views, images: list[np.ndarray], times: list[float], title: str, legend: list[Patch] | None = None,
           bar: tuple | None = None, interpolation: str = "antialiased") -> Figure:
    """Draws one image per time, with axes in mm, and a legend or a colour bar (mappable, label)."""
    columns = min(2 if views.aspect() < 0.75 else 3, len(images))
    rows = -(-len(images) // columns)
    width = {1: 8.0, 2: 11.0, 3: 13.0}[columns]
    panel = (width - 0.9) / columns * views.aspect()
    figure, axes = plt.subplots(rows, columns, figsize=(width, rows * (panel + 0.35) + 1.1), squeeze=False,
                                sharex=True, sharey=True, layout="constrained")
    geo = views.geo
    limits = geo.extent(views.limits)
    for ax in axes.flat[len(images):]:
        ax.set_visible(False)
    for ax, image, time in zip(axes.flat, images, times):
        ax.imshow(image, origin="lower", extent=limits, interpolation=interpolation, aspect="equal")
        ax.set_title(f"t = {units.time(time)}", fontsize=10, loc="left")
        for side in ax.spines.values():
            side.set_color("#b0b4ba")
        ax.tick_params(colors="#444", labelsize=8)
    for ax in axes[-1, :]:
        ax.set_xlabel(geo.labels[0], fontsize=9)
    for ax in axes[:, 0]:
        ax.set_ylabel(geo.labels[1], fontsize=9)
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


FAILURE_COLOURS = ("#8fa3b5", "#d7402b", "#c9b037", "#b5547a", "#6d6fc4", "#c8762f", "#8c6d5a", "#5aa469",
                   "#2f4b7c")
FAILURE_NAMES = ("intact", "tension", "plastic strain", "principal stress", "principal strain", "ductile damage",
                 "fragmentation", "growth of voids", "accumulated tension")


# Fields that are shown by a scale: meaning, factor and unit, colours.
SCALED = {"temperature": ("temperature", 1.0, " (K)", "inferno"),
          "pressure": ("pressure", units.GIGAPASCALS, " (GPa)", "magma"),
          "speed": ("speed", units.KM_PER_SECOND, " (km/s)", "cividis"),
          "plastic_strain": ("plastic strain", 1.0, "", "viridis"),
          "damage": ("damage", 1.0, "", "viridis")}


def cloud_figures(run: Run, views: Views) -> Iterator[tuple[str, str, Figure]]:
    """Yields (file name, caption, figure) of every picture that the fields of the snapshots allow."""
    times = [view.time for view in views.times]
    sections = [view.section for view in views.times]
    complete = " The model is completed at its symmetry planes." if run.symmetry_planes else ""
    cut_text = ("Section through the axis: particles are rings." if views.geo.dimension == "axisymmetric" else
                "Section." if views.geo.planar else
                "Section through the axis, particles and elements behind the cut, the nearest in front.") + complete

    def written(name):
        return all(name in section.fields for section in sections)

    def figure(pictures, colours, title, **others):
        return panels(views, [paint(picture, colours(picture)) for picture in pictures], times, title, **others)

    names = run.body_names(views.highest_body() + 1)
    legend = [Patch(color=BODY_COLOURS[i % len(BODY_COLOURS)], label=name) for i, name in enumerate(names)]
    if not views.geo.planar:
        yield ("cloud_outside.png", "Side view from outside, coloured by body." + complete,
               figure([view.outside for view in views.times], lambda p: body_colours(p.fields["body"]), "From outside",
                      legend=legend))
    yield ("cloud_body.png", cut_text + " Coloured by body.",
           figure(sections, lambda p: body_colours(p.fields["body"]), "Section, by body", legend=legend))
    if written("phase"):
        legend = [Patch(color=c, label=name) for c, name in zip(PHASE_COLOURS, PHASES)]
        yield ("cloud_phase.png", cut_text + " Coloured by phase.",
               figure(sections, lambda p: class_colours(p.fields["phase"], PHASE_COLOURS), "Section, by phase",
                      legend=legend))
    if written("failed") and any(section.fields["failed"].any() for section in sections):
        seen = sorted({int(code) for section in sections for code in np.unique(section.fields["failed"])})
        legend = [Patch(color=FAILURE_COLOURS[code], label=FAILURE_NAMES[code]) for code in seen
                  if code < len(FAILURE_NAMES)]
        yield ("cloud_failed.png", cut_text + " Coloured by the cause of failure.",
               figure(sections, lambda p: class_colours(p.fields["failed"], FAILURE_COLOURS), "Section, by failure",
                      legend=legend))
    for field, (name, factor, unit, palette) in SCALED.items():
        if field not in views.scales or not written(field):
            continue
        low, high = (factor * end for end in views.scales[field])
        norm = Normalize(low, max(high, low + 1e-3 * max(abs(low), 1e-3)))
        yield (f"cloud_{field}.png", f"{cut_text} Coloured by {name}; the scale is that of the mass that moves, "
               "its ends hold the 0.2 % beyond.",
               figure(sections, lambda p: scale_colours(factor * p.fields[field], norm, palette), f"Section, by {name}",
                      bar=(plt.cm.ScalarMappable(norm, palette), name + unit)))


def radiograph_figure(analysis: Analysis) -> Figure:
    """Draws the areal density as grey, the transmission of the absorbers that the analysis was told."""
    pictures, geo = analysis.pictures, analysis.geometry
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
    dark = pictures[-1].transmission[pictures[-1].transmission < 0.998]
    darkest = max(float(np.median(dark))**8, 1e-3) if dark.size else 0.5
    norm = Normalize(darkest, 1.0)
    for ax, picture in zip(axes.flat, pictures):
        ax.imshow(picture.transmission, origin="lower", extent=geo.extent(picture.extent), cmap="gray", norm=norm,
                  interpolation="bilinear", aspect="equal")
        ax.set_title(f"t = {units.time(picture.time)}", fontsize=10, loc="left")
        ax.tick_params(colors="#444", labelsize=8)
    for ax in axes[-1, :]:
        ax.set_xlabel(geo.labels[0], fontsize=9)
    for ax in axes[:, 0]:
        ax.set_ylabel(geo.labels[1], fontsize=9)
    figure.suptitle("Synthetic radiograph", fontsize=12, fontweight="bold")
    figure.colorbar(plt.cm.ScalarMappable(norm, "gray"), ax=axes, location="bottom", shrink=0.6, aspect=45, pad=0.03,
                    label="transmission")
    return figure
