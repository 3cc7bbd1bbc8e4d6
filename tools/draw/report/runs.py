"""Draws runs against control or time: lines, markers, labels, and failed runs in a separate lane."""
import numpy as np

from ..chart import spread
from . import theme
from .scale import positive
from .theme import LIGHT

LANE_ROW = 13
LANE_GAP = 6


def lane_height(failing):
    """Height (px) of the lane, which has a row for each method with failed runs."""
    return max(20, LANE_ROW * len(failing) + 6) if failing else 0


def draw_runs(axes, index, runs, hollow, mark=None):
    """Draws a method's runs (x, y, point) as a line with marks. `hollow`: indices of the points with a hollow mark;
    `mark`: index of the marker, default `index`, which is that of the colour."""
    colour, mark = theme.colour(index), index if mark is None else mark
    axes.plot([x for x, _, _ in runs], [y for _, y, _ in runs], color=colour, lw=1.7, ls=theme.dashes(index),
              gid=f"me-{index}", zorder=3)
    for x, y, point in runs:
        open_ = point.index in hollow
        axes.plot([x], [y], marker=theme.marker(mark), ms=theme.marker_size(mark, 8.5), ls="none",
                  mfc=LIGHT["paper"] if open_ else colour, mec=colour if open_ else LIGHT["paper"],
                  mew=1.3 if open_ else 0.9, clip_on=False, gid=f"pt-{point.index}-{index}", zorder=4)


def draw_lane(lane, failing, place):
    """Draws crosses for failed runs, {method index: points}. `place(point)`: x, or nan if it is unknown."""
    lane.set_facecolor(LIGHT["lane"])
    lane.grid(False)
    lane.spines["bottom"].set_visible(False)
    lane.tick_params(labelbottom=False, labelleft=False)
    lane.set_yticks([])
    lane.set_ylim(len(failing) - 0.5 + 0.15, -0.5 - 0.15)
    low, _ = lane.get_xlim()
    for row, (index, points) in enumerate(failing.items()):
        for point in points:
            x = place(point)
            lane.plot([x if np.isfinite(x) and x > 0 else low], [row], color=theme.colour(index),
                      clip_on=False, gid=f"pt-{point.index}-{index}", **theme.FAILURE)


def label_right(layout, box, entries, ends, plain=False):
    """Writes names to the right of the axes, near the ends of their lines. `ends`: heights of the line ends, from 0 at
    the top to 1 at the bottom; `box`: left, top, width and height of the axes; `plain`: without markers."""
    if not entries:
        return
    left, top, width, height = box
    wanted = np.array([top + height * np.clip(end, 0, 1) for end in ends])
    placed = spread(wanted, 20.0)
    # Spreading may have moved names outside the axes. All names are then shifted back.
    placed = placed + min(0.0, top + height - placed.max())
    placed = placed + max(0.0, top + 4 - placed.min())
    for (index, words, failed), y in zip(entries, placed):
        layout.method_label(left + width + 14, y, index, words, failed, plain)


def label_runs(layout, box, entries, ends, columns, below=52, plain=False):
    """Labels the lines: on narrow pages by a legend, `below` px under the axes; else by names at their right ends."""
    if layout.narrow:
        layout.legend(box[1] + box[3] + below, entries, columns, plain=plain)
    else:
        label_right(layout, box, entries, ends, plain)


def add_failures(layout, axes, box, failing, height, place, labelled=True):
    """Adds a lane, `height` px high, above the axes. It shows the failed runs, {method index: points}, at x =
    place(point)."""
    if not failing:
        return
    left, top = box[0], box[1] - LANE_GAP - height
    draw_lane(layout.axes(left, top, box[2], height, sharex=axes), failing, place)
    if labelled:
        layout.text(left - 8, top + height / 2, "failed", ha="right", fontsize=11, color=LIGHT["muted"])


def say_nothing_finished(layout, axes, box):
    """Writes a text in place of lines, and hides the error axis."""
    left, top, width, height = box
    axes.set_yticks([])
    axes.grid(False)
    layout.text(left + width / 2, top + height / 2, "no finished run", ha="center", color=LIGHT["muted"])


def end_fraction(axes, value):
    """Position of a value on a logarithmic y axis, 0 at the top."""
    low, high = np.log10(axes.get_ylim())
    if not positive([value]).size:
        return 0.0
    return 1 - (np.log10(value) - low) / (high - low)


def draw_unresolved(axes, bound, words, side="left"):
    """Shades the errors below `bound`, which are not resolved. `side`: where the label is, away from the lines."""
    low, high = axes.get_ylim()
    if not bound > low:
        return
    axes.axhspan(low, min(bound, high), color=LIGHT["band"], lw=0, zorder=0)
    at, shift = (0, 6) if side == "left" else (1, -6)
    axes.annotate(words, (at, low), xycoords=("axes fraction", "data"), xytext=(shift, 6),
                  textcoords="offset points", ha=side, va="bottom", fontsize=11, color=LIGHT["muted"], zorder=1)
