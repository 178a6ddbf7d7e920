# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the cloud from the side: every particle a lit sphere, the nearest in front."""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import PIL.Image
from matplotlib.colors import Normalize
from matplotlib.patches import Patch

from report_data import PHASES
from report_metrics import quantile

PHASE_COLOURS = ("#5f7f9f", "#f4b942", "#d7402b", "#8e5bc9")
BODY_COLOURS = ("#c8762f", "#8fa3b5", "#5aa469", "#b5547a", "#6d6fc4", "#c9b037", "#4aa5b5", "#8c6d5a")
BACKGROUND = np.array([0.985, 0.985, 0.99])
PANEL_PIXELS = 900       # along the axis of flight
SHOWN_MASS = 0.9995      # limits of the pictures hold this share of the mass


class View:
    """The projection of all pictures: limits common to all times, so that the growth is seen."""

    def __init__(self, run, geo, snapshots):
        self.geo = geo
        self.mirrored = geo.up in run.symmetry_planes
        self.depth_copies = 2 if geo.depth in run.symmetry_planes else 1
        edge = (1 - SHOWN_MASS) / 2
        lower, upper, reach_up, reach_down = np.inf, -np.inf, 0.0, 0.0
        for s in snapshots:
            if len(s) == 0:
                continue
            axial, up, _ = self.coordinates(s)
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
        self.pixel = (self.limits[1] - self.limits[0]) / PANEL_PIXELS
        self.shape = (int(np.ceil((self.limits[3] - self.limits[2]) / self.pixel)), PANEL_PIXELS)

    def coordinates(self, snapshot):
        """Along the axis of flight, upward, toward the viewer of the section (m, from the axis)."""
        offset = snapshot.position - self.geo.centre
        return self.geo.sign * offset[:, self.geo.axis], offset[:, self.geo.up], -offset[:, self.geo.depth]

    def aspect(self):
        return self.shape[0] / self.shape[1]


def radii(snapshot):
    """Half the size of the cube of a particle's matter; 0 if the density was not written."""
    if snapshot.density is None:
        return np.zeros(len(snapshot))
    return 0.5 * np.cbrt(snapshot.mass / np.maximum(snapshot.density, 1e-3))


def draw_spheres(x, y, z, radius, shape):
    """Which sphere is seen in each pixel (-1: none) and how much light it sends. x, y, radius in pixels, z toward
    the viewer in pixels. Spheres are drawn offset by offset of their outline; the nearest surface wins."""
    height, width = shape
    seen = np.full(height * width, -1, np.int64)
    surface = np.full(height * width, -np.inf)
    light = np.zeros(height * width)
    last = np.empty(height * width, np.int64)  # read only where it was just written
    classes = np.clip(np.round(radius), 1, 12).astype(int)
    direction = np.array([-0.4, 0.55, 0.73])  # of the light, from the upper left in front
    order = np.argsort(z)  # of several in one pixel the last that is assigned is the nearest
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    for r in np.unique(classes):
        mine = order[classes[order] == r]
        reach = r + 0.35  # rounds the outline of small spheres
        for dy in range(-r, r + 1):
            for dx in range(-r, r + 1):
                inside = reach**2 - dx**2 - dy**2
                if inside < 0:
                    continue
                normal = np.array([dx, dy, np.sqrt(inside)]) / reach
                c, w = column[mine] + dx, row[mine] + dy
                valid = (c >= 0) & (c < width) & (w >= 0) & (w < height)
                index, pixel = mine[valid], w[valid] * width + c[valid]
                last[pixel] = index
                depth = z[index] + np.sqrt(inside)
                nearer = (last[pixel] == index) & (depth > surface[pixel])
                pixel = pixel[nearer]
                seen[pixel] = index[nearer]
                surface[pixel] = depth[nearer]
                light[pixel] = 0.42 + 0.58 * max(0.0, float(normal @ direction))
    return seen.reshape(shape), light.reshape(shape)


def render(snapshot, view, outside):
    """Index of the particle seen in each pixel of the completed side view, and the light.
    `outside` looks at the cloud from outside; otherwise it is cut along the plane of sight through its axis."""
    axial, up, toward = view.coordinates(snapshot)
    index = np.arange(len(snapshot))
    if outside:
        toward = np.abs(toward) if view.depth_copies == 2 else toward
    else:
        behind = toward <= 0
        axial, up, toward, index = axial[behind], up[behind], toward[behind], index[behind]
    if view.mirrored:
        axial, up = np.concatenate([axial, axial]), np.concatenate([up, -up])
        toward, index = np.concatenate([toward, toward]), np.concatenate([index, index])
    x = (axial - view.limits[0]) / view.pixel
    y = (up - view.limits[2]) / view.pixel
    radius = radii(snapshot)[index] / view.pixel
    seen, light = draw_spheres(x, y, toward / view.pixel, radius, view.shape)
    return np.where(seen >= 0, index[np.maximum(seen, 0)] if len(index) else -1, -1), light


def paint(rendered, colours):
    """RGB image (8 bit) of a rendered view; `colours` has one RGB row per particle."""
    seen, light = rendered
    image = np.broadcast_to(BACKGROUND, (*seen.shape, 3)).copy()
    hit = seen >= 0
    image[hit] = np.clip(colours[seen[hit]] * light[hit][:, None] * 1.12, 0, 1)
    return np.round(255 * image).astype(np.uint8)


def phase_colours(snapshot):
    palette = np.array([matplotlib.colors.to_rgb(c) for c in PHASE_COLOURS])
    return palette[np.minimum(snapshot.phase, len(palette) - 1)]


def body_colours(snapshot):
    palette = np.array([matplotlib.colors.to_rgb(c) for c in BODY_COLOURS])
    return palette[snapshot.body.astype(int) % len(palette)]


def scale_colours(values, norm, name):
    return matplotlib.colormaps[name](norm(values))[:, :3]


def panels(view, images, times, title, legend=None, bar=None, interpolation="antialiased"):
    """A figure of one image per time, with axes in mm, and a legend or a colour bar (mappable, label)."""
    columns = min(2 if view.aspect() < 0.75 else 3, len(images))
    rows = -(-len(images) // columns)
    width = {1: 8.0, 2: 11.0, 3: 13.0}[columns]
    panel = (width - 0.9) / columns * view.aspect()
    figure, axes = plt.subplots(rows, columns, figsize=(width, rows * (panel + 0.35) + 1.1), squeeze=False,
                                sharex=True, sharey=True, layout="constrained")
    limits = [1e3 * v for v in view.limits]
    for ax in axes.flat[len(images):]:
        ax.set_visible(False)
    for ax, image, time in zip(axes.flat, images, times):
        ax.imshow(image, origin="lower", extent=limits, interpolation=interpolation, aspect="equal")
        ax.set_title(f"t = {1e6 * time:.4g} µs", fontsize=10, loc="left")
        for side in ax.spines.values():
            side.set_color("#b0b4ba")
        ax.tick_params(colors="#444", labelsize=8)
    for ax in axes[-1, :]:
        ax.set_xlabel("along the axis of flight (mm)", fontsize=9)
    for ax in axes[:, 0]:
        ax.set_ylabel("across (mm)", fontsize=9)
    figure.suptitle(title, fontsize=12, fontweight="bold")
    if legend:
        legend_below(figure, legend, [patch.get_label() for patch in legend])
    if bar:
        mappable, label = bar
        figure.colorbar(mappable, ax=axes, location="bottom", shrink=0.6, aspect=45, pad=0.03, label=label)
    return figure


def save(figure, path):
    """Draws once and writes the PNG (`savefig` draws a constrained layout twice)."""
    figure.set_dpi(130)
    figure.canvas.draw()
    PIL.Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB").save(path)
    plt.close(figure)


def legend_below(figure, handles, labels):
    """A legend in a row below all panels."""
    room = 0.4 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, room, 1, 1 - room))
    figure.legend(handles, labels, loc="lower center", ncols=len(labels), frameon=False, fontsize=10)


def _range(snapshots, field, low, high):
    values = np.concatenate([getattr(s, field) for s in snapshots if len(s)] or [np.zeros(1)])
    weights = np.concatenate([s.mass for s in snapshots if len(s)] or [np.ones(1)])
    return quantile(values, weights, low), quantile(values, weights, high)


def cloud_figures(run, geo, snapshots):
    """(file name, caption, figure) of every picture that the fields of the snapshots allow."""
    view = View(run, geo, snapshots)
    times = [s.time for s in snapshots]
    cuts = [render(s, view, outside=False) for s in snapshots]
    complete = " The model is completed at its symmetry planes." if run.symmetry_planes else ""
    cut_text = "Section through the axis, particles behind the cut, the nearest in front." + complete
    if all(s.body is not None for s in snapshots):
        names = run.body_names(snapshots[0])
        legend = [Patch(color=BODY_COLOURS[i % len(BODY_COLOURS)], label=name) for i, name in enumerate(names)]
        images = [paint(render(s, view, outside=True), body_colours(s)) for s in snapshots]
        yield ("cloud_outside.png", "Side view from outside, coloured by body." + complete,
               panels(view, images, times, "Debris cloud from outside", legend=legend))
        yield ("cloud_body.png", cut_text + " Coloured by body.",
               panels(view, [paint(c, body_colours(s)) for c, s in zip(cuts, snapshots)], times,
                      "Section, by body", legend=legend))
    if all(s.phase is not None for s in snapshots):
        legend = [Patch(color=c, label=name) for c, name in zip(PHASE_COLOURS, PHASES)]
        yield ("cloud_phase.png", cut_text + " Coloured by phase.",
               panels(view, [paint(c, phase_colours(s)) for c, s in zip(cuts, snapshots)], times,
                      "Section, by phase", legend=legend))
    if all(s.temperature is not None for s in snapshots):
        low, high = _range(snapshots, "temperature", 0.002, 0.998)
        norm = Normalize(low, max(high, low + 1.0))
        images = [paint(c, scale_colours(s.temperature, norm, "inferno") if len(s) else np.zeros((0, 3)))
                  for c, s in zip(cuts, snapshots)]
        yield ("cloud_temperature.png", cut_text + " Coloured by temperature; the ends of the scale hold the 0.2 % "
               "of the mass beyond.",
               panels(view, images, times, "Section, by temperature",
                      bar=(plt.cm.ScalarMappable(norm, "inferno"), "temperature (K)")))


def radiograph_figure(analysis):
    """Areal density as grey, the transmission of the absorbers that the analysis was told."""
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
        ax.imshow(picture.transmission, origin="lower", extent=[1e3 * v for v in picture.extent], cmap="gray", norm=norm,
                  interpolation="bilinear", aspect="equal")
        ax.set_title(f"t = {1e6 * picture.time:.4g} µs", fontsize=10, loc="left")
        ax.tick_params(colors="#444", labelsize=8)
    for ax in axes[-1, :]:
        ax.set_xlabel("along the axis of flight (mm)", fontsize=9)
    for ax in axes[:, 0]:
        ax.set_ylabel("across (mm)", fontsize=9)
    figure.suptitle("Synthetic radiograph", fontsize=12, fontweight="bold")
    figure.colorbar(plt.cm.ScalarMappable(norm, "gray"), ax=axes, location="bottom", shrink=0.6, aspect=45, pad=0.03,
                    label="transmission")
    return figure
