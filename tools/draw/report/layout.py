"""A figure laid out in pixels from its top left corner, with common labels and legends.

Interactive marks carry a gid: `pt-INDEX-METHOD` for a run, `me-METHOD` for parts of a method.
"""
import matplotlib
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from . import theme
from .theme import LIGHT

PIXELS_PER_INCH = 72  # a point is a pixel of the page
WIDE, NARROW = 780, 350
LETTER = 7.0  # px: average width of a letter of size 12
LABEL = 32  # most letters of a method's name in a figure, enough for "generalized_alpha, fixed step"
CONTROL = 14  # most letters of the control after the name: ", step 200 µs"

STYLE = {
    "font.family": "DejaVu Sans", "font.size": 12, "text.color": LIGHT["ink"], "text.parse_math": False,
    "axes.labelcolor": LIGHT["ink"], "axes.edgecolor": LIGHT["muted"], "axes.linewidth": 0.8,
    "axes.facecolor": "none", "figure.facecolor": "none", "axes.unicode_minus": True, "axes.axisbelow": True,
    "grid.color": LIGHT["rule"], "grid.linewidth": 1, "xtick.color": LIGHT["muted"], "ytick.color": LIGHT["muted"],
    "xtick.labelcolor": LIGHT["ink"], "ytick.labelcolor": LIGHT["ink"], "xtick.labelsize": 12,
    "ytick.labelsize": 12, "lines.solid_capstyle": "round", "lines.solid_joinstyle": "round", "path.simplify": True,
}


def styled(draw):
    """Decorator: applies the matplotlib style while `draw` runs."""
    def wrapped(*arguments, **options):
        with matplotlib.rc_context(STYLE):
            return draw(*arguments, **options)
    return wrapped


class PixelLayout:
    """A figure, and its text alternative `description`."""

    def __init__(self, width, height, description=""):
        self.width, self.height, self.description = width, height, description
        self.figure = Figure(figsize=(width / PIXELS_PER_INCH, height / PIXELS_PER_INCH), dpi=PIXELS_PER_INCH)

    @property
    def narrow(self):
        return self.width < 500

    def axes(self, left, top, width, height, **options):
        box = [left / self.width, 1 - (top + height) / self.height, width / self.width, height / self.height]
        axes = self.figure.add_axes(box, **options)
        axes.spines[["top", "right", "left"]].set_visible(False)
        axes.tick_params(length=0, which="both", pad=6)
        axes.grid(True, which="major")
        return axes

    def text(self, x, y, words, **options):
        options = {"va": "center", "ha": "left", **options}
        return self.figure.text(x / self.width, 1 - y / self.height, words, **options)

    def line(self, x, y, **options):
        """A line or marker in pixels."""
        line = Line2D([v / self.width for v in x], [1 - v / self.height for v in y],
                      transform=self.figure.transFigure, **options)
        self.figure.add_artist(line)

    def method_label(self, x, y, index, words, failed=False, plain=False):
        """Draws a method's line, marker (unless `plain`) and name; a cross and a pale name if all its runs failed."""
        colour, gid = theme.colour(index), f"me-{index}"
        if failed:
            self.line([x + 9], [y], color=colour, gid=gid, **theme.FAILURE)
        else:
            self.line([x, x + 18], [y, y], color=colour, lw=1.6, ls=theme.dashes(index), gid=gid)
            if not plain:
                self.line([x + 9], [y], color=colour, marker=theme.marker(index), gid=gid,
                          ms=theme.marker_size(index, 8), mec=LIGHT["paper"], mew=0.8, ls="none")
        self.text(x + 25, y, words, gid=gid, color=LIGHT["muted" if failed else "ink"])

    def legend(self, top, entries, columns=1, left=2, plain=False):
        """Draws the labels of methods (index, words, failed) in rows below `top`."""
        step = (self.width - 2 * left) / columns
        for k, (index, words, failed) in enumerate(entries):
            self.method_label(left + step * (k % columns), top + 10 + 20 * (k // columns), index, words, failed,
                              plain)


def shortened(words, letters):
    return words if len(words) <= letters else words[:letters - 1] + "…"


def side_margin(entries, most=0.36 * WIDE):
    """Width (px) that labels to the right of the axes need."""
    longest = max((len(words) for _, words, _ in entries), default=0)
    return min(50 + LETTER * longest, most)


def legend_columns(entries, width=NARROW):
    longest = max((len(words) for _, words, _ in entries), default=0)
    return 2 if 34 + LETTER * longest < (width - 16) / 2 else 1


def legend_height(entries, columns):
    return 20 * -(-len(entries) // columns) + 8 if entries else 0
