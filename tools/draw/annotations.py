"""Axis triad, scale bar and colour bar around a body. Positions are in inches on the page."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.patches import Rectangle

from .colouring import CATEGORIES, NOT_A_NUMBER
from .style import FAINT
from .units import length_label, round_length

AXIS_COLOURS = ("#c0392b", "#2e8b57", "#2f5fb3")  # x red, y green, z blue


def page(figure):
    """Axes over the whole figure, in inches."""
    width, height = figure.get_size_inches()
    axes = figure.add_axes([0, 0, 1, 1], xlim=(0, width), ylim=(0, height), zorder=5)
    axes.axis("off")
    return axes


def triad(axes, camera, x, y, length=0.30):
    """Draws the coordinate axes as arrows from (x, y), the farthest first."""
    for i in np.argsort(camera.toward):
        direction = np.array([camera.right[i], camera.up[i]])
        tip = np.array([x, y]) + length * direction
        axes.annotate("", tip, (x, y), arrowprops={"arrowstyle": "-|>,head_width=0.13,head_length=0.26", "lw": 1.3,
                                                   "color": AXIS_COLOURS[i], "shrinkA": 0, "shrinkB": 0})
        size = np.linalg.norm(direction)
        if size < 0.15:
            axes.plot(x, y, "o", ms=4.5, color=AXIS_COLOURS[i], mew=0)
        name = tip + 0.10 * (direction / size if size > 0.15 else np.array([0.7, 0.7]))
        axes.text(*name, "xyz"[i], color=AXIS_COLOURS[i], ha="center", va="center", fontsize=8, weight="bold")


def scale_bar(axes, x, y, metres_per_inch, longest=1.1):
    length = round_length(longest * metres_per_inch)
    width = length / metres_per_inch
    axes.plot([x, x, x, x + width, x + width, x + width], [y - .04, y + .04, y, y, y - .04, y + .04],
              color=matplotlib.rcParams["text.color"], lw=1.1, solid_joinstyle="miter")
    axes.text(x + width / 2, y + 0.09, length_label(length), ha="center", va="bottom", fontsize=8)


def _categories(axes, colouring, right, y):
    names = [str(c) for c in colouring.categories]
    x = right - 0.42 * len(names) - 0.02
    axes.text(x - 0.12, y + 0.07, colouring.label, ha="right", va="center", fontsize=9)
    for k, (category, name) in enumerate(zip(colouring.categories, names)):
        colour = CATEGORIES[category % len(CATEGORIES)]
        axes.add_patch(Rectangle((x + 0.42 * k, y), 0.15, 0.15, facecolor=colour, edgecolor="none"))
        axes.text(x + 0.42 * k + 0.20, y + 0.07, name, va="center", fontsize=8)


def colour_bar(axes, colouring, right, y, width):
    """Draws a horizontal bar that ends at `right`, with its label above."""
    if colouring.categories is not None:
        return _categories(axes, colouring, right, y)
    figure = axes.figure
    page_width, page_height = figure.get_size_inches()
    box = figure.add_axes([(right - width) / page_width, y / page_height, width / page_width, 0.13 / page_height])
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[colouring.below, colouring.above]
    bar = figure.colorbar(ScalarMappable(colouring.norm, colouring.map), cax=box, orientation="horizontal",
                          extend=extend, extendfrac=0.04)
    bar.outline.set_visible(False)
    bar.locator = matplotlib.ticker.MaxNLocator(5 if width > 2.4 else 4, steps=[1, 2, 2.5, 5, 10])
    bar.update_ticks()
    box.tick_params(length=2.5, width=0.6, labelsize=8, pad=2)
    axes.text(right - width, y + 0.19, colouring.label, ha="left", va="bottom", fontsize=9)
    if colouring.has_nan:
        axes.text(right, y + 0.19, "■ not a number", color=NOT_A_NUMBER, ha="right", va="bottom", fontsize=8)


def time_label(axes, x, y, text, note=""):
    axes.text(x, y, text, ha="left", va="baseline", fontsize=10.5, weight="bold")
    if note:
        axes.text(axes.get_xlim()[1] - x, y, note, ha="right", va="baseline", fontsize=8, color=FAINT)
