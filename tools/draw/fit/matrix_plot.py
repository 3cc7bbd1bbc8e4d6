"""The correlation matrix, and the combinations of parameters from the worst to the best determined."""
import math

from matplotlib.patches import Rectangle

from ..report.layout import LETTER, WIDE, PixelLayout, shortened, styled
from ..report.scale import error_tick, limits, set_log
from ..report.theme import LIGHT
from .numbers import minus

ROW = 30
NUMBER = 28  # px: narrowest cell that has a number
DARK = 0.62  # absolute value from which the number in a cell is light
WELL, NOTHING = 0.1, 1  # deviations of a coordinate up to which it is well, and poorly, determined


def cell(axes, x, y, value):
    """A cell with a colour for a value from -1 to 1: orange, white, blue. Grey if it is unknown."""
    known = math.isfinite(value)
    colour = LIGHT["band"] if not known else LIGHT["c1"] if value > 0 else LIGHT["c2"]
    strength = min(abs(value), 1.0) if known else 1.0
    axes.add_patch(Rectangle((x - 0.48, y - 0.46), 0.96, 0.92, facecolor=LIGHT["rule"], edgecolor="none", alpha=0.35))
    axes.add_patch(Rectangle((x - 0.48, y - 0.46), 0.96, 0.92, facecolor=colour, edgecolor="none",
                             alpha=round(strength, 3)))


def _number(axes, x, y, value, size):
    light = math.isfinite(value) and abs(value) > DARK
    words = minus(f"{value:.2f}") if math.isfinite(value) else "–"
    axes.text(x, y, words, ha="center", va="center", fontsize=size, color=LIGHT["paper" if light else "ink"])


def _cells(axes, rows, width):
    """Draws a matrix whose cells are `width` px wide."""
    count = len(rows[0])
    axes.grid(False)
    axes.spines["bottom"].set_visible(False)
    axes.set_xlim(-0.5, count - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    for y, row in enumerate(rows):
        for x, value in enumerate(row):
            cell(axes, x, y, value)
            if width >= NUMBER:
                _number(axes, x, y, value, 12 if width >= 44 else 10 if width >= 34 else 9)


def _names(fit, letters):
    return [shortened(p.name, letters) for p in fit.parameters]


class _Columns:
    """The names of the parameters above the columns of a matrix: upright if they do not fit side by side."""

    def __init__(self, names, width):
        longest = max(map(len, names))
        self.names, self.upright = names, LETTER * longest > width - 6
        self.height = 12 + LETTER * longest if self.upright else 24

    def draw(self, axes):
        axes.xaxis.tick_top()
        axes.set_xticks(range(len(self.names)), self.names, rotation=90 if self.upright else 0)


def _cell_width(room, count, most=64):
    return min(most, room / count)


@styled
def draw_correlation(fit, width):
    """The layout; None for a single parameter."""
    count = len(fit.parameters)
    if count < 2:
        return None
    names = _names(fit, 12 if width < WIDE else 24)
    left = 12 + LETTER * max(map(len, names))
    across = _cell_width(width - left - 8, count)
    columns = _Columns(names, across)
    top = 28 + columns.height
    layout = PixelLayout(width, top + ROW * count + 8)
    axes = layout.axes(left, top, across * count, ROW * count)
    _cells(axes, fit.correlation, across)
    columns.draw(axes)
    axes.set_yticks(range(count), names)
    layout.text(0, 14, "Correlation of the parameters", weight="bold")
    pairs = [(abs(fit.correlation[i][j]), i, j) for i in range(count) for j in range(i)
             if math.isfinite(fit.correlation[i][j])]
    layout.description = "Correlation of the parameters."
    if pairs:
        _, i, j = max(pairs)
        layout.description += (f" The largest is {fit.correlation[i][j]:.2f}, of {fit.parameters[j].name} and "
                               f"{fit.parameters[i].name}.")
    return layout


def _bars(axes, directions, narrow):
    finite = [d.deviation for d in directions if math.isfinite(d.deviation)]
    low, high = limits(finite + [WELL, NOTHING], pad=0.1)
    set_log(axes, "x", low, high, error_tick, 4 if narrow else 5)
    axes.set_ylim(len(directions) - 0.5, -0.5)
    for limit in (WELL, NOTHING):
        axes.axvline(limit, color=LIGHT["muted"], lw=0.9, ls=(0, (3, 3)), zorder=1)
    for k, direction in enumerate(directions):
        known = math.isfinite(direction.deviation)
        end = direction.deviation if known else high
        axes.add_patch(Rectangle((low, k - 0.26), end - low, 0.52, lw=0, zorder=2,
                                 facecolor=LIGHT["c1"] if known else LIGHT["c2"]))
        words = minus(f"{direction.deviation:.2g}") if known else "the data say nothing"
        inside = math.log(end / low) > 0.6 * math.log(high / low)
        axes.annotate(words, (end, k), xytext=(-5 if inside else 5, 0), textcoords="offset points", va="center",
                      ha="right" if inside else "left", fontsize=11, color=LIGHT["paper" if inside else "ink"], zorder=3)


@styled
def draw_directions(fit, width):
    """The layout; None for a single parameter. On narrow pages the bars are below the matrix of weights."""
    count = len(fit.parameters)
    if count < 2 or not fit.directions:
        return None
    narrow, rows = width < WIDE, len(fit.directions)
    names = _names(fit, 12 if narrow else 16)
    left = 28
    across = _cell_width(width - left - 8 if narrow else 0.58 * (width - left), count, 56)
    columns = _Columns(names, across)
    top, height = 28 + columns.height, ROW * rows
    layout = PixelLayout(width, top + height + 52 + (height + 40 if narrow else 0))
    weights = layout.axes(left, top, across * count, height)
    _cells(weights, [d.weights for d in fit.directions], across)
    columns.draw(weights)
    labels = [str(k + 1) for k in range(rows)]
    weights.set_yticks(range(rows), labels)
    beside = left + across * count + 24
    box = (left, top + height + 40, width - left - 12, height) if narrow else (beside, top, width - beside - 12, height)
    bars = layout.axes(*box)
    _bars(bars, fit.directions, narrow)
    bars.set_yticks(range(rows), labels if narrow else [])
    bars.grid(False, axis="y")
    layout.text(0, 14, "Combinations of parameters, worst first: weights" + ("" if narrow else " and standard deviations"),
                weight="bold")
    if narrow:
        layout.text(0, top + height + 22, "Their standard deviations", weight="bold")
    layout.text(box[0] + box[2] / 2, box[1] + height + 36, "Standard deviation", ha="center")
    layout.description = "Standard deviations of combinations, worst first: " + ", ".join(
        f"{d.deviation:.2g}" for d in fit.directions)
    return layout
