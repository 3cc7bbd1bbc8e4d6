"""Error against control (tolerance or step), with observed orders."""
import numpy as np

from . import measures, formatting
from .runs import (LANE_GAP, add_failures, draw_runs, draw_unresolved, end_fraction, label_runs, lane_height,
                   say_nothing_finished)
from .layout import LABEL, WIDE, PixelLayout, legend_columns, legend_height, shortened, side_margin, styled
from .scale import error_tick, limits, positive, seconds_tick, set_log
from .theme import LIGHT
from .work_precision import error_limits, title_of, unresolved_words

KINDS = {"rtol": ("Relative tolerance asked for", error_tick), "step": ("Step size", seconds_tick),
         "safety": ("Share of the critical step", lambda x: f"{x:g}")}


def kinds_of(comparison, problem):
    """The kinds of control of a problem's runs, tolerances first."""
    found = {p.control.kind for p in comparison.points_of(problem) if positive([p.control.value]).size}
    return sorted(found, key=lambda kind: (list(KINDS).index(kind) if kind in KINDS else 9, kind))


def _runs(comparison, problem, kind, measure):
    """{method index: [(control, error, point)]} of finished runs."""
    found = {k: [(p.control.value, p.error(measure), p) for p in comparison.finished(problem, m.id)
                 if p.control.kind == kind] for k, m in enumerate(comparison.methods)}
    found = {k: [run for run in runs if positive(run[:2]).size == 2] for k, runs in found.items()}
    return {k: runs for k, runs in found.items() if runs}


def _failing(comparison, problem, kind):
    found = {k: [p for p in comparison.failed(problem, m.id) if p.control.kind == kind]
             for k, m in enumerate(comparison.methods)}
    return {k: points for k, points in found.items() if points}


def _entries(comparison, problem, measure, indices):
    """Labels of the methods, with the observed slopes: (index, words, muted)."""
    entries = []
    for k in indices:
        method = comparison.methods[k]
        slope = comparison.slope(problem, method.id, measure)
        note = f", slope {slope:.2f}" if formatting.known(slope) else ""
        entries.append((k, shortened(method.label, LABEL) + note, False))
    return entries


def guide_orders(kind, comparison, problem, measure, indices):
    """Slopes of the guide lines: 1 for a tolerance, the nearest whole orders for a step."""
    if kind == "rtol":
        return [1]
    slopes = [comparison.slope(problem, comparison.methods[k].id, measure) for k in indices]
    near = sorted({int(round(s)) for s in slopes if formatting.known(s) and 0.5 <= s < 6.5})
    return near[:3] or [2]


def _draw_guides(axes, orders, runs, kind):
    """Draws dashed lines of the given slopes below the runs; for a tolerance the line 'error = rtol', if within the
    axes."""
    points = np.array([(x, y) for found in runs.values() for x, y, _ in found])
    first, last = points[:, 0].min(), points[:, 0].max()
    low, high = axes.get_ylim()
    for order in orders:
        promise = kind == "rtol" and low < first and last < high
        factor = 1.0 if promise else 0.25 * (points[:, 1] / points[:, 0] ** order).min()
        start = max(first, (1.3 * low / factor) ** (1 / order))
        end = min(last, (0.8 * high / factor) ** (1 / order))
        if not start < end:
            continue
        axes.plot([start, end], factor * np.array([start, end]) ** order, color=LIGHT["muted"], lw=1,
                  ls=(0, (4, 3)), zorder=1)
        at = start * (end / start) ** (0.7 if promise else 1.0)
        axes.annotate("error = rtol" if promise else f"slope {order}", (at, factor * at ** order),
                      xytext=(10, -10) if promise else (0, -8), textcoords="offset points",
                      ha="left" if promise else "right", va="top", fontsize=11, color=LIGHT["muted"], zorder=2,
                      bbox={"fc": LIGHT["paper"], "ec": "none", "pad": 1.5})


def _panel(layout, box, rows, comparison, problem, measure, kind, first):
    """Draws the panel of one kind of control: axes, lane, runs and guides. Returns the axes and the runs."""
    left, top, width, height = box
    runs, failing = _runs(comparison, problem, kind, measure), _failing(comparison, problem, kind)
    axes = layout.axes(*box)
    bound = problem.reference.reach(measure)
    controls = [p.control.value for p in comparison.points_of(problem) if p.control.kind == kind]
    label, tick = KINDS.get(kind, (kind, error_tick))
    set_log(axes, "x", *limits(controls), tick, max(3, int(width / 50)))
    errors = [p.error(measure) for p in comparison.finished(problem)]
    set_log(axes, "y", *error_limits(errors, bound), error_tick)
    draw_unresolved(axes, bound, unresolved_words(problem, measure, width < 450) if first else "", "right")
    if runs:
        _draw_guides(axes, guide_orders(kind, comparison, problem, measure, runs), runs, kind)
    for k, found in runs.items():
        draw_runs(axes, k, found, {p.index for _, _, p in found if comparison.is_near_reference(p, measure)})
    add_failures(layout, axes, box, failing, rows, lambda p: p.control.value, first)
    layout.text(left + width / 2, top + height + 40, label, ha="center")
    if not first:
        axes.tick_params(labelleft=False)
    return axes, runs


def _boxes(width, kinds, lanes, margin, flat):
    """(left, top, width, height) of each kind's panel. Panels are side by side, or stacked on narrow pages."""
    narrow = width < WIDE
    left, right, height = (46, 20, 250) if narrow else (54, margin, 340)
    height = 90 if flat else height
    top = 40 + (lanes + LANE_GAP if lanes else 0)
    if narrow:
        return [(left, top + k * (height + 66 + lanes + LANE_GAP), width - left - right, height)
                for k in range(len(kinds))]
    each = (width - left - right - 40 * (len(kinds) - 1)) / len(kinds)
    return [(left + k * (each + 40), top, each, height) for k in range(len(kinds))]


@styled
def draw_error_against_control(comparison, problem, measure, width):
    kinds = kinds_of(comparison, problem) or ["rtol"]
    runs = [_runs(comparison, problem, kind, measure) for kind in kinds]
    drawn = sorted({k for found in runs for k in found})
    entries = _entries(comparison, problem, measure, drawn)
    lanes = max(lane_height(_failing(comparison, problem, kind)) for kind in kinds)
    columns = legend_columns(entries)
    boxes = _boxes(width, kinds, lanes, side_margin(entries, most=0.44 * WIDE), not drawn)
    bottom = boxes[-1][1] + boxes[-1][3] + 62
    layout = PixelLayout(width, bottom + (legend_height(entries, columns) if width < WIDE else 0),
                  _description(problem, measure, entries))
    layout.text(0, 16, title_of(measure), weight="bold")
    panels = [_panel(layout, box, lanes, comparison, problem, measure, kind, k == 0 or layout.narrow)
              for k, (kind, box) in enumerate(zip(kinds, boxes))]
    if not drawn:
        for (axes, _), box in zip(panels, boxes):
            say_nothing_finished(layout, axes, box)
    ends = {k: end_fraction(axes, found[k][0][1]) for axes, found in panels for k in found}
    label_runs(layout, boxes[-1], entries, [ends[k] for k in drawn], columns)
    return layout


def _description(problem, measure, entries):
    return (f"Error against tolerance or step for {problem.label}, {measures.label(measure)}: "
            f"{'; '.join(words for _, words, _ in entries) or 'no finished run'}.")
