"""Curves of a metric against a variable: points as marks, the closed form as a line, and the difference of the two."""
import math

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ..report import theme
from ..report.runs import label_runs
from ..report.scale import error_tick, limits, positive, set_log
from ..report.layout import (WIDE, PixelLayout, legend_columns, legend_height, shortened, side_margin, styled)
from ..report.theme import LIGHT


def _entries(plan, sweep):
    if not plan.lines:
        return []
    return [(k, shortened(plan.line_words(level), 26), False) for k, level in enumerate(plan.line_levels(sweep))]


def _layout(width, entries, height):
    narrow = width < WIDE
    left = 54 if narrow else 64
    right = 16 if narrow or not entries else side_margin(entries)
    columns = legend_columns(entries)
    below = 52 + (legend_height(entries, columns) + 8 if narrow else 0)
    layout = PixelLayout(width, 40 + height + below)
    return layout, (left, 40, width - left - right, height), columns


def power_tick(x):
    """The label of a tick: 1, 10, 1000, but 10⁻⁴ and 10⁶."""
    return f"{x:g}" if 0.99e-3 < x < 2e4 else error_tick(x)


def with_ends(axes, which, values, log, most):
    """Adds ticks at both ends of the values, and removes ticks too close to them."""
    finite = [v for v in values if math.isfinite(v)]
    if not finite or min(finite) == max(finite):
        return
    low, high = min(finite), max(finite)
    place = math.log10 if log and low > 0 else float
    room = 0.55 * (place(high) - place(low)) / max(most - 1, 1)
    axis = getattr(axes, f"{which}axis")
    words = power_tick if place is math.log10 else lambda x: f"{x:.6g}".replace("-", "−")
    inner = [x for x in axis.get_majorticklocs() if low < x < high and
             min(place(x) - place(low), place(high) - place(x)) > room]
    getattr(axes, f"set_{which}ticks")([low, *inner, high], [words(x) for x in (low, *inner, high)])


def scaled(axes, which, values, log=False, most=7):
    """Scales an axis to round limits around the values; logarithmic if wanted and possible."""
    finite = [v for v in values if math.isfinite(v)]
    if log and len(positive(finite)) == len(finite) and finite:
        return set_log(axes, which, *limits(finite, pad=0.05, least=0.3), power_tick, most)
    axis = getattr(axes, f"{which}axis")
    axis.set_major_locator(MaxNLocator(most, steps=[1, 2, 2.5, 3, 5, 10]))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.6g}".replace("-", "−")))
    if finite and max(finite) > min(finite) and which == "y":
        ticks = axis.get_major_locator().tick_values(min(finite), max(finite))
        axes.set_ylim(ticks[0], ticks[-1])
    elif finite and (max(finite) > min(finite) or which == "x"):
        pad = 0.04 * (max(finite) - min(finite)) or 0.5
        getattr(axes, f"set_{which}lim")(min(finite) - pad, max(finite) + pad)
    elif finite:
        pad = 0.1 * abs(finite[0]) or 1
        getattr(axes, f"set_{which}lim")(finite[0] - pad, finite[0] + pad)


def _marks(axes, index, rows, with_line):
    """Draws marks. `rows`: (x, y, point)."""
    colour = theme.colour(index)
    rows = [r for r in rows if math.isfinite(r[1])]
    if with_line and rows:
        axes.plot([r[0] for r in rows], [r[1] for r in rows], color=colour, lw=1.6, ls=theme.dashes(index),
                  gid=f"me-{index}")
    for x, y, point in rows:
        axes.plot([x], [y], marker=theme.marker(index), ms=theme.marker_size(index, 7), ls="none", mfc=colour,
                  mec=LIGHT["paper"], mew=0.8, clip_on=False, gid=f"pt-{point['index']}-{index}", zorder=4)


def _same(curves):
    """Whether all closed forms are the same line."""
    first = curves[0]
    return len(curves) > 1 and all(len(c) == len(first) and np.allclose(c, first, rtol=1e-12, atol=0, equal_nan=True)
                                   for c in curves)


def _closed_forms(axes, curves):
    shared = _same([np.array(rows, float).reshape(-1, 2) for rows in curves.values()])
    for index, rows in list(curves.items())[:1 if shared else None]:
        colour, gid = (LIGHT["muted"], "cf") if shared else (theme.colour(index), f"me-{index}")
        axes.plot([x for x, _ in rows], [y for _, y in rows], color=colour, lw=1.5, gid=gid, zorder=2)


def _place(plan, sweep, point):
    value = point["values"][plan.x.name]
    return value if plan.x.numeric else sweep.levels(plan.x).index(value)


def _annotate(layout, axes, box, plan, sweep, title, entries, columns):
    left, top, width, height = box
    layout.text(0, 16, title, weight="bold")
    levels = sweep.levels(plan.x)
    if plan.x.numeric:
        most = 4 if layout.narrow else 8
        scaled(axes, "x", levels, plan.x.log, most)
        with_ends(axes, "x", levels, plan.x.log, most)
    else:
        axes.set_xlim(-0.5, len(levels) - 0.5)
        axes.set_xticks(range(len(levels)), [shortened(str(v), 10) for v in levels])
    layout.text(left + width / 2, top + height + 38, plan.x.heading, ha="center")
    label_runs(layout, box, entries, [0] * len(entries), columns)


def _failure_line(axes, limit):
    """Draws a thin line at the value that means failure, if it is within the axis or near it."""
    low, high = axes.get_ylim()
    if low <= limit <= high:
        axes.axhline(limit, color=LIGHT["muted"], lw=0.8, zorder=1)
        axes.annotate("fails", (1, limit), xycoords=axes.get_yaxis_transform(), xytext=(-2, 2),
                      textcoords="offset points", ha="right", va="bottom", fontsize=10, color=LIGHT["muted"])


def _strokes(axes, index, rows, end):
    """Draws a stroke from each mark to the value corrected by the mesh error."""
    for x, y, point in rows:
        if math.isfinite(y) and math.isfinite(end(point)):
            axes.plot([x, x], [y, end(point)], color=theme.colour(index), lw=1.0, alpha=0.6, zorder=3,
                      gid=f"me-{index}")


def _drawn(plan, sweep, width, height, title, value, log, closed=None, without=None):
    entries = _entries(plan, sweep)
    layout, box, columns = _layout(width, entries, height)
    axes = layout.axes(*box)
    lines = {k: [(_place(plan, sweep, p), value(p), p) for p in plan.of_line(sweep, level)]
             for k, level in enumerate(plan.line_levels(sweep))}
    curves = {k: [(x, closed(p)) for x, _, p in rows] for k, rows in lines.items()} if closed else {}
    values = [y for rows in lines.values() for _, y, _ in rows] + [y for c in curves.values() for _, y in c]
    if without:
        values += [without(p) for rows in lines.values() for _, _, p in rows]
    scaled(axes, "y", values, log, 5 if height < 200 else 7)
    if closed:
        _closed_forms(axes, curves)
    scattered = sweep.combine == "latin_hypercube"
    for k, rows in lines.items():
        if without:
            _strokes(axes, k, rows, without)
        _marks(axes, k, rows, not closed and not scattered)
    _annotate(layout, axes, box, plan, sweep, title, entries, columns)
    return layout, axes, lines


@styled
def draw_curves(plan, sweep, width):
    metric = plan.metric
    title = metric.heading + (f"   ({plan.title})" if plan.title else "")
    closed = metric.closed if metric.closed_form else None
    layout, axes, lines = _drawn(plan, sweep, width, 240 if width < WIDE else 320, title, metric.value, metric.log,
                                 closed, metric.without_mesh_error)
    _failure_line(axes, metric.failure)
    layout.description = _description(plan, sweep, lines)
    return layout


@styled
def draw_differences(plan, sweep, width):
    """The layout with the differences from the closed form; None without a closed form."""
    metric = plan.metric
    if not metric.closed_form or not any(math.isfinite(metric.difference(p)) for p in plan.points(sweep)):
        return None
    title = "Difference from the closed form [%]"
    layout, axes, _ = _drawn(plan, sweep, width, 150, title, lambda p: 100 * metric.difference(p), False)
    axes.axhline(0, color=LIGHT["muted"], lw=0.8, zorder=1)
    layout.description = f"{metric.title}: {title}"
    return layout


def _description(plan, sweep, lines):
    parts = []
    for (_, rows), level in zip(lines.items(), plan.line_levels(sweep)):
        ends = [(y, k) for k, (_, y, _) in enumerate(rows) if math.isfinite(y)]
        if ends:
            name = f"{plan.line_words(level)}: " if plan.lines else ""
            low, high = (plan.metric.shown(rows[end[1]][2]) for end in (min(ends), max(ends)))
            parts.append(f"{name}{low} to {high}")
    return f"{plan.metric.heading} over {plan.x.heading}. {'; '.join(parts) or 'No point has it'}."
