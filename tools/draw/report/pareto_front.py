"""Diagram of a Pareto front: total error against time on all meshes of a scene.

Colours distinguish meshes, markers distinguish methods.
"""
import math

from . import formatting, measures, theme
from .layout import WIDE, PixelLayout, legend_columns, legend_height, shortened, side_margin, styled
from .runs import LANE_GAP, add_failures, draw_runs, draw_unresolved, end_fraction, label_runs, lane_height
from .scale import error_tick, limits, seconds_tick, set_log
from .theme import LIGHT
from .work_precision import annotate, error_limits, runs_of


def pareto_front_of(comparison, front, measure, clock):
    """The Pareto-optimal points as (seconds, error, point), fastest first. Unresolved errors count as equal. Empty if
    the comparison found no front."""
    if not front.points:
        return []
    reach = comparison.problem(front.problems[0]).reference.reach(measure)
    found, best = [], math.inf
    runs = [run for p in front.problems for m in comparison.methods
            for run in runs_of(comparison, comparison.problem(p), m, measure, clock)]
    for seconds, error, point in sorted(runs, key=lambda run: run[:2]):
        told = max(error, reach) if math.isfinite(reach) else error
        if told < best:
            best = told
            found.append((seconds, error, point))
    return found


def _lines(comparison, front, measure, clock):
    """{(mesh index, method index): runs}."""
    found = {(k, m): runs_of(comparison, comparison.problem(p), method, measure, clock)
             for k, p in enumerate(front.problems) for m, method in enumerate(comparison.methods)}
    return {key: runs for key, runs in found.items() if runs}


def _failing(comparison, front):
    found = {k: comparison.failed(comparison.problem(p)) for k, p in enumerate(front.problems)}
    return {k: points for k, points in found.items() if points}


def _unresolved_words(problem, measure, narrow):
    reach = formatting.exponent(problem.reference.reach(measure))
    return f"not resolved: below {reach}" + ("" if narrow else ", within reach of the reference's own error")


def _method_legend(layout, comparison, top):
    """Draws the legend of the methods and the front in one row or two."""
    x, y = 4.0, top
    for name, mark in [(m.label, theme.marker(k)) for k, m in enumerate(comparison.methods)] + [("front", None)]:
        if x + 30 + 7 * len(name) > layout.width and x > 4:
            x, y = 4.0, y + 20
        if mark:
            layout.line([x + 9], [y], color=LIGHT["muted"], marker=mark, ms=8, ls="none")
        else:
            layout.line([x, x + 18], [y, y], color=LIGHT["ink"], lw=5, alpha=0.25)
        layout.text(x + 25, y, name)
        x += 45 + 7.0 * len(name)


def _description(front, measure, best):
    ends = [f"{formatting.exponent(error)} in {formatting.seconds(t)}" for t, error, _ in (best[:1] + best[-1:])]
    return (f"Front of {front.label}, {measures.label(measure)}, against time: "
            f"{' to '.join(ends) or 'no finished run'}.")


@styled
def draw_pareto_front(comparison, front, measure, clock, width):
    lines, failing = _lines(comparison, front, measure, clock), _failing(comparison, front)
    drawn = {k for k, _ in lines}
    meshes = [comparison.problem(p).mesh for p in front.problems]
    entries = [(k, shortened(words, 30), k not in drawn) for k, words in enumerate(meshes)
               if k in drawn or k in failing]
    narrow, lane = width < WIDE, lane_height(failing)
    left, right = (46, 20) if narrow else (54, side_margin(entries))
    top, height = 40 + (lane + LANE_GAP if lane else 0), 330 if narrow else 440
    columns = legend_columns(entries)
    box = (left, top, width - left - right, height)
    layout = PixelLayout(width, top + height + (112 + legend_height(entries, columns) if narrow else 92))
    best = pareto_front_of(comparison, front, measure, clock)
    layout.description = _description(front, measure, best)
    axes, problem = layout.axes(*box), comparison.problem(front.problems[0])
    reach = problem.reference.reach(measure)
    times = [t for runs in lines.values() for t, _, _ in runs] + [p.seconds(clock) for f in failing.values() for p in f]
    set_log(axes, "x", *limits(times), seconds_tick, 4 if narrow else 8)
    set_log(axes, "y", *error_limits([e for runs in lines.values() for _, e, _ in runs], reach), error_tick)
    draw_unresolved(axes, reach, _unresolved_words(problem, measure, narrow))
    axes.plot([t for t, _, _ in best], [e for _, e, _ in best], color=LIGHT["ink"], lw=9, alpha=0.16, zorder=1.5)
    for (k, m), runs in lines.items():
        hollow = {p.index for _, _, p in runs if comparison.is_near_reference(p, measure)}
        draw_runs(axes, k, runs, hollow, mark=m)
    annotate(layout, axes, box, measure, clock)
    add_failures(layout, axes, box, failing, lane, lambda p: p.seconds(clock))
    _method_legend(layout, comparison, top + height + 70)
    ends = [end_fraction(axes, min(e for (k, _), runs in lines.items() if k == entry[0] for _, e, _ in runs))
            if entry[0] in drawn else 0.0 for entry in entries]
    label_runs(layout, box, entries, ends, columns, below=92, plain=True)
    return layout
