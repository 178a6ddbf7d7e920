# SPDX-License-Identifier: BSD-3-Clause
"""One style for all figures: the width of a page of a journal, one size of letters, colours that people with deficient
colour vision tell apart (those of web/viewer/colours.js; a test compares them)."""
import matplotlib
import numpy as np
from matplotlib.colors import Colormap, LinearSegmentedColormap, to_rgb
from matplotlib.figure import Figure

WIDTH = 7.2  # inches: two columns of a journal; every figure is drawn at its printed size
NARROW = 4.6  # of a single panel
LETTERS = 8  # points, of all text but ticks
RULES = {"font.size": LETTERS, "axes.titlesize": LETTERS, "axes.labelsize": LETTERS, "legend.fontsize": LETTERS - 1,
         "xtick.labelsize": LETTERS - 1, "ytick.labelsize": LETTERS - 1, "figure.titlesize": LETTERS + 1,
         "axes.linewidth": 0.6, "lines.linewidth": 1.2, "lines.markersize": 2.5, "grid.linewidth": 0.5,
         "xtick.major.width": 0.6, "ytick.major.width": 0.6, "font.family": "DejaVu Sans"}

# Okabe and Ito, Color universal design (2008), and indigo; the order is that of the viewer.
WORDS = ("#56b4e9", "#e69f00", "#d55e00", "#cc79a7", "#009e73", "#0072b2", "#f0e442", "#999999", "#332288")
LINES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#332288", "#56b4e9", "#555555")  # on white

# inferno without its darkest part, in which nothing that is shaded can be seen.
INFERNO_FROM = 0.125


def apply() -> None:
    """Makes the style that of all figures drawn from now on."""
    matplotlib.rcParams.update(RULES)
    matplotlib.rcParams["axes.prop_cycle"] = matplotlib.cycler(color=LINES)


def colour_map(low: float, high: float, unit: str) -> Colormap:
    """Chooses the colours of a scale as the viewer does: diverging for signed fields, inferno for temperatures."""
    if low < 0 < high:
        return matplotlib.colormaps["coolwarm"]
    if unit == "K":
        colours = matplotlib.colormaps["inferno"](np.linspace(INFERNO_FROM, 1.0, 256))
        return LinearSegmentedColormap.from_list("temperature", colours)
    return matplotlib.colormaps["viridis"]


def word_colours(numbers: np.ndarray) -> np.ndarray:
    """Colours items by the number of a word, beyond the last from the first on: one RGB row each."""
    palette = np.array([to_rgb(colour) for colour in WORDS])
    return palette[numbers.astype(int) % len(palette)]


def share_of_page(figure: Figure) -> float:
    """Returns the width of a figure over that of the page, so that letters are as large in all of them."""
    return min(figure.get_figwidth() / WIDTH, 1.0)
