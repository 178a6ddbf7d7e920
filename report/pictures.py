# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the cloud from the side, coloured by body, phase, failure or the scale of a field."""
import io
import pathlib
from collections.abc import Iterator

import matplotlib.pyplot as plt
import numpy as np
import PIL.Image
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from report import style, units
from report.analysis import Analysis
from report.files import write_whole
from report.run import Run
from report.views import PHASES, Picture, Views

BACKGROUND = 255  # white, as the paper of a journal
# Of the light, what colours of a scale take: they must be read, not admired.
SHADING_OF_SCALES = 0.55
SMALL_END = 0.05  # of the other end of a scale: a sign that is no part of the picture
RESOLUTION_OF_PAGE = 1440  # pixels across the page
COLOURS_OF_PAGE = 256
ABSORBS = 0.998  # a transmission below is that of material
LEAST_PIXELS = 20  # of a cloud whose radiograph has a scale of its own


def paint(picture: Picture, colours: np.ndarray, shading: float = 1.0) -> np.ndarray:
    """Makes the RGB image (8 bit) of a picture; `colours` has one RGB row per item."""
    image = np.full((*picture.seen.shape, 3), BACKGROUND, np.uint8)
    hit = picture.seen >= 0
    light = 1 - shading * (1 - np.clip(1.12 * picture.light[hit], 0, 1))
    image[hit] = np.rint(255 * (colours[picture.seen[hit]] * light[:, None]))
    return image


def scale_colours(values: np.ndarray, norm: Normalize, colours: Colormap) -> np.ndarray:
    """Colours values by a scale of matplotlib: one RGB row each."""
    return colours(norm(values))[:, :3]


def scale_of(ends: tuple[float, float]) -> Normalize:
    """Makes the scale between two ends; about zero if they have different signs, from zero if one of them is small."""
    low, high = ends
    if low < 0 < high and min(-low, high) < SMALL_END * max(-low, high):
        low, high = (0.0, high) if high > -low else (low, 0.0)
    if low < 0 < high:
        most = max(-low, high)
        return Normalize(-most, most)
    return Normalize(low, max(high, low + 1e-3 * max(abs(low), 1e-3)))


def beyond(values: list[np.ndarray], norm: Normalize) -> str:
    """Tells at which ends values lie beyond a scale, in the words of matplotlib."""
    under = any((v < norm.vmin).any() for v in values)
    over = any((v > norm.vmax).any() for v in values)
    return {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[under, over]


def grid_of(count: int, aspect: float) -> tuple[Figure, np.ndarray]:
    """Makes a figure of so many panels of a height over width, as wide as a page, with axes in common."""
    columns = min(2 if aspect < 0.75 else 3, count)
    rows = -(-count // columns)
    panel = (style.WIDTH - 0.5) / columns * aspect
    figure, axes = plt.subplots(rows, columns, figsize=(style.WIDTH, rows * (panel + 0.22) + 0.75), squeeze=False,
                                sharex=True, sharey=True, layout="constrained")
    for ax in axes.flat[count:]:
        ax.set_visible(False)
    return figure, axes


def label_axes(figure: Figure, axes: np.ndarray, geo, titles: list[str], title: str) -> None:
    """Labels the panels of a figure with positions in mm."""
    for ax, text in zip(axes.flat, titles):
        ax.set_title(text, loc="left")
        ax.tick_params(colors="#444")
        for side in ax.spines.values():
            side.set_color("#b0b4ba")
    for ax in axes[-1, :]:
        ax.set_xlabel(geo.labels[0])
    for ax in axes[:, 0]:
        ax.set_ylabel(geo.labels[1])
    figure.suptitle(title, fontweight="bold")


def colour_bar(figure: Figure, axes: np.ndarray, norm: Normalize, colours: Colormap | str, label: str,
               extend: str = "neither") -> None:
    """Adds a colour bar below all panels; arrows where values lie beyond it."""
    figure.colorbar(plt.cm.ScalarMappable(norm, colours), ax=axes, location="bottom", shrink=0.6, aspect=45, pad=0.03,
                    label=label, extend=extend)


def panels(geo, limits: list[tuple], images: list[np.ndarray], titles: list[str], title: str,
           legend: list[Patch] | None = None, bar: tuple | None = None) -> Figure:
    """Draws one image per title within its limits (m from the axis), with axes in mm, and a legend or a colour bar
    (norm, colours, label, extend)."""
    whole = tuple(pick(each) for pick, each in zip((min, max, min, max), zip(*limits)))
    figure, axes = grid_of(len(images), (whole[3] - whole[2]) / (whole[1] - whole[0]))
    left, right, below, above = geo.extent(whole)
    for ax, image, own in zip(axes.flat, images, limits):
        ax.imshow(image, origin="lower", extent=geo.extent(own), interpolation="antialiased", aspect="equal")
        ax.set(xlim=(left, right), ylim=(below, above))
    label_axes(figure, axes, geo, titles, title)
    if legend:
        legend_below(figure, legend, [patch.get_label() for patch in legend])
    if bar:
        colour_bar(figure, axes, *bar)
    return figure


def save(figure: Figure, path: pathlib.Path, dots_per_inch: int) -> None:
    """Draws once and writes the PNG (`savefig` draws a constrained layout twice)."""
    figure.set_dpi(dots_per_inch)
    figure.canvas.draw()
    image = PIL.Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    write_whole(path, lambda stream: image.save(stream, format="PNG"))
    plt.close(figure)


def small_copy(path: pathlib.Path) -> bytes:
    """Returns a PNG file for the page: at most as many pixels across as the page shows, 256 colours."""
    image = PIL.Image.open(path).convert("RGB")
    if image.width > RESOLUTION_OF_PAGE:
        height = round(image.height * RESOLUTION_OF_PAGE / image.width)
        image = image.resize((RESOLUTION_OF_PAGE, height), PIL.Image.Resampling.LANCZOS)
    stream = io.BytesIO()
    # Of the methods the one with the least of the largest errors: rare colours stay.
    method = PIL.Image.Quantize.MAXCOVERAGE
    image.quantize(COLOURS_OF_PAGE, method=method, dither=PIL.Image.Dither.NONE).save(stream, format="PNG", optimize=True)
    return stream.getvalue()


def legend_below(figure: Figure, handles: list, labels: list[str]) -> None:
    """Adds a legend in a row below all panels."""
    room = 0.27 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, room, 1, 1 - room))
    figure.legend(handles, labels, loc="lower center", ncols=min(len(labels), 6), frameon=False)


FAILURE_NAMES = ("intact", "tension", "plastic strain", "principal stress", "principal strain", "ductile damage",
                 "fragmentation", "growth of voids", "accumulated tension")


# Fields that are shown by a scale: meaning, factor and unit.
SCALED = {"pressure": ("pressure", units.GIGAPASCALS, "GPa"), "speed": ("speed", units.KM_PER_SECOND, "km/s"),
          "damage": ("damage", 1.0, ""), "temperature": ("temperature", 1.0, "K"),
          "plastic_strain": ("plastic strain", 1.0, ""), "burn_fraction": ("burn fraction", 1.0, "")}
# Those whose scale does not depend on the values of the run.
WHOLE = {"burn_fraction": (0.0, 1.0)}
# Fields that are shown by words.
WORDED = {"phase": ("phase", PHASES), "failed": ("cause of failure", FAILURE_NAMES)}
SPHERES = (" Spheres of debris reach to their neighbours while these are nearer than five diameters: rings and rows that "
           "remain where it is thinner are those of the initial lattice of particles, not of the material. Light falls "
           "off with the depth.")


def legend_of(names: list[str] | tuple[str, ...], codes: list[int]) -> list[Patch]:
    """Makes the legend of the words that occur."""
    return [Patch(color=style.WORDS[code % len(style.WORDS)], label=names[code]) for code in codes if code < len(names)]


def scaled_picture(section: Picture, field: str, norm: Normalize) -> tuple[np.ndarray, tuple]:
    """Paints a section by a field on a scale. Returns the image and the colour bar (norm, colours, label)."""
    name, factor, unit = SCALED[field]
    colours = style.colour_map(norm.vmin, norm.vmax, unit)
    image = paint(section, scale_colours(factor * section.fields[field], norm, colours), SHADING_OF_SCALES)
    return image, (norm, colours, f"{name} ({unit})" if unit else name)


def cloud_figures(run: Run, views: Views) -> Iterator[tuple[str, str, Figure]]:
    """Yields (file name, caption, figure) of every picture that the fields of the snapshots allow."""
    times = [f"t = {units.time(view.time)}" for view in views.times]
    sections = [view.section for view in views.times]
    limits = [views.limits] * len(times)
    complete = " The model is completed at its symmetry planes." if run.symmetry_planes else ""
    cut_text = ("Section through the axis: particles are rings." if views.geo.dimension == "axisymmetric" else
                "Section." if views.geo.planar else
                "Section through the axis, particles and elements behind the cut, the nearest in front.") + complete

    def worded(pictures, field, names, title):
        seen = sorted({int(code) for picture in pictures for code in np.unique(picture.fields[field])})
        return panels(views.geo, limits, [paint(p, style.word_colours(p.fields[field])) for p in pictures], times,
                      title, legend=legend_of(names, seen))

    names = run.body_names(views.highest_body() + 1)
    if not views.geo.planar:
        yield ("cloud_outside.png", "Side view from outside, coloured by body." + complete + SPHERES,
               worded([view.outside for view in views.times], "body", names, "From outside"))
    yield ("cloud_body.png", cut_text + " Coloured by body." + (SPHERES if views.geo.planar else ""),
           worded(sections, "body", names, "Section, by body"))
    for field, (name, factor, unit) in SCALED.items():
        if field not in views.scales or not all(field in section.fields for section in sections):
            continue
        norm = scale_of(tuple(factor * end for end in WHOLE.get(field, views.scales[field])))
        painted = [scaled_picture(section, field, norm) for section in sections]
        extend = beyond([factor * section.fields[field] for section in sections], norm)
        what = "" if field in WHOLE else " The scale holds 96 % of the mass that moves at each of these times; arrows: values beyond it."
        yield (f"cloud_{field}.png", f"{cut_text} Coloured by {name}.{what}",
               panels(views.geo, limits, [image for image, _ in painted], times, f"Section, by {name}",
                      bar=(*painted[0][1], extend)))
    for field, (name, words) in WORDED.items():
        # A picture of a single word tells nothing.
        if all(field in section.fields for section in sections) and len(
                {code for section in sections for code in np.unique(section.fields[field])}) > 1:
            yield (f"cloud_{field}.png", f"{cut_text} Coloured by {name}.",
                   worded(sections, field, words, f"Section, by {name}"))


def darkest_of_cloud(pictures: list) -> float:
    """Returns the transmission that is black in radiographs: that of the densest hundredth of the cloud in the last one.
    The cloud is what attenuates where nothing was in the first: walls, which hold most of the mass, would leave it pale."""
    last, first = pictures[-1], pictures[0]
    dark = last.transmission < ABSORBS
    new = dark
    if len(pictures) > 1 and first.transmission.shape == last.transmission.shape:
        new = dark & (first.transmission >= ABSORBS)
    if new.sum() < LEAST_PIXELS:
        new = dark
    if not new.any():
        return 0.5
    return float(np.clip(np.quantile(last.transmission[new], 0.01), 1e-3, 0.99))


def radiograph_figure(analysis: Analysis) -> Figure:
    """Draws the transmission of the absorbers that the analysis was told."""
    pictures, geo = analysis.pictures, analysis.geometry
    left, right, below, above = pictures[0].extent
    figure, axes = grid_of(len(pictures), (above - below) / (right - left))
    norm = Normalize(darkest_of_cloud(pictures), 1.0)
    for ax, picture in zip(axes.flat, pictures):
        ax.imshow(picture.transmission, origin="lower", extent=geo.extent(picture.extent), cmap="gray", norm=norm,
                  interpolation="bilinear", aspect="equal")
    label_axes(figure, axes, geo, [f"t = {units.time(picture.time)}" for picture in pictures], "Synthetic radiograph")
    colour_bar(figure, axes, norm, "gray", "transmission", beyond([p.transmission for p in pictures], norm))
    return figure
