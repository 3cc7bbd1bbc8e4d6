"""Building blocks of curves over time: stacked panels, lines labelled at their ends."""
import numpy as np

from .style import FAINT, pyplot
from .units import prefix

COLOURS = ("#2f5fb3", "#d1622b", "#2e8b57", "#8e44ad", "#b8860b", "#c0392b", "#3aa0b5", "#6b7280")


def panels(heights, width=8.0, right=1.35, sharex=True):
    """A figure and its axes, one above the other, which share the time axis by default. `heights` in inches."""
    gap = 0.34 if sharex else 0.75
    height = sum(heights) + 0.62 + gap * len(heights)
    figure, axes = pyplot.subplots(len(heights), 1, sharex=sharex, squeeze=False, figsize=(width, height),
                                   gridspec_kw={"height_ratios": heights})
    figure.subplots_adjust(left=0.80 / width, right=1 - right / width, bottom=0.56 / height,
                           top=1 - 0.34 / height, hspace=gap * len(heights) / sum(heights))
    return figure, list(axes[:, 0])


def time_axis(axes, times, unit, name="t", start=None):
    """Sets the label and the limits of a time axis, which starts at `start` or the first time. Returns the times, or
    load factors, in the unit of the axis."""
    factor, unit = prefix(unit, np.nanmax(np.abs(times)))
    scaled = times / factor
    label = "time" if name == "t" else name.replace("_", " ")
    axes.set_xlabel(f"{label} [{unit}]" if unit else label)
    first = scaled[0] if start is None else start / factor
    axes.set_xlim(first, scaled[-1] if scaled[-1] > first else first + 1)
    return scaled


def title(axes, text, note=""):
    axes.set_title(text, loc="left", fontsize=9.5, weight="bold", pad=7)
    if note:
        axes.set_title(note, loc="right", fontsize=8, color=FAINT, pad=7)


def spread(heights, gap):
    """Positions at least `gap` apart, in the order of `heights` and as close to them as possible."""
    order = np.argsort(heights, kind="stable")
    groups = []  # [sum over the members of (height - rank * gap), number of members]
    for k, height in enumerate(np.asarray(heights, float)[order]):
        groups.append([height - k * gap, 1])
        while len(groups) > 1 and groups[-2][0] / groups[-2][1] > groups[-1][0] / groups[-1][1]:
            total, members = groups.pop()
            groups[-1][0] += total
            groups[-1][1] += members
    placed = np.concatenate([np.full(members, total / members) for total, members in groups])
    result = np.empty(len(heights))
    result[order] = placed + gap * np.arange(len(heights))
    return result


def label_ends(axes, curves):
    """Writes the names of curves to the right of the axes, moved apart where they would overlap. `curves`: (last value,
    name, colour); curves without a name get no label."""
    curves = [curve for curve in curves if curve[1]]
    if not curves:
        return
    low, high = axes.get_ylim()
    inches = axes.figure.get_size_inches()[1] * axes.get_position().height
    fractions = [float(np.nan_to_num((value - low) / (high - low))) for value, _, _ in curves]
    for place, fraction, (_, name, colour) in zip(spread(fractions, 0.165 / inches), fractions, curves):
        axes.annotate(name, (1, fraction), xytext=(1.03, place), xycoords="axes fraction", textcoords="axes fraction",
                      color=colour, fontsize=8.5, va="center", ha="left", annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "lw": 0.6, "color": colour, "shrinkA": 1, "shrinkB": 1,
                                  "relpos": (0, 0.5)})


def draw_lines(axes, times, columns, styles=None, name=lambda column: column.name):
    """Draws columns of the same unit into one panel, with a common SI prefix. Returns the text of the unit."""
    largest = max((np.nanmax(np.abs(c.values), initial=0.0) for c in columns), default=0.0)
    factor, unit = prefix(columns[0].unit, largest)
    ends = []
    for k, column in enumerate(columns):
        style = {"color": COLOURS[k % len(COLOURS)], "lw": 1.5, **(styles or {}).get(column.name, {})}
        axes.plot(times, column.values / factor, **style)
        finite = column.values[np.isfinite(column.values)]
        ends.append((finite[-1] / factor if finite.size else 0.0, name(column), style["color"]))
    axes.margins(y=0.06)
    label_ends(axes, ends)
    return unit
