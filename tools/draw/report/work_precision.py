"""The work-precision diagram: error against time, both logarithmic, one line per method."""
import numpy as np

from . import measures, formatting
from .runs import (LANE_GAP, add_failures, draw_runs, draw_unresolved, end_fraction, label_runs, lane_height,
                   say_nothing_finished)
from .layout import LABEL, WIDE, PixelLayout, legend_columns, legend_height, shortened, side_margin, styled
from .scale import error_tick, limits, positive, seconds_tick, set_log
from .theme import colour

SHOW_BAND_WITHIN = 30.0  # the band of unresolved errors is shown if its bound is above the smallest error / 30


def runs_of(comparison, problem, method, measure, clock):
    """(seconds, error, point) of the finished runs whose values are positive and finite."""
    found = [(p.seconds(clock), p.error(measure), p) for p in comparison.finished(problem, method.id)]
    return [run for run in found if positive(run[:2]).size == 2]


def failing_methods(comparison, problem):
    """{method index: failed points}, without methods that never failed."""
    found = {k: comparison.failed(problem, m.id) for k, m in enumerate(comparison.methods)}
    return {k: points for k, points in found.items() if points}


def error_limits(errors, bound):
    """Limits of the error axis. They include the band of unresolved errors if it is near the errors."""
    errors = positive(errors)
    low, high = limits(errors)
    if errors.size and bound > errors.min() / SHOW_BAND_WITHIN:
        low = min(low, bound / 6)
    return low, high


def unresolved_words(problem, measure, narrow):
    if problem.reference.has_own_mesh:
        return "not resolved: below " + formatting.exponent(problem.reference.reach(measure))
    own = formatting.exponent(problem.reference.errors.get(measure, np.nan))
    return "not resolved: below 10 × " + (own if narrow else f"the reference's own error ({own})")


def title_of(measure):
    return f"Error: {measures.label(measure)}" + (" [rad]" if measure == "phase" else "")


def _entries(comparison, problem, runs):
    """Labels of the methods that ran: (index, words, whether all its runs failed)."""
    ran = {p.method for p in comparison.points_of(problem)}
    return [(k, shortened(m.label, LABEL), not runs[k]) for k, m in enumerate(comparison.methods) if m.id in ran]


def _description(problem, measure, runs, comparison):
    best = [f"{comparison.methods[k].label} {formatting.exponent(min(e for _, e, _ in r))} in at most "
            f"{formatting.seconds(max(t for t, _, _ in r))}" for k, r in runs.items() if r]
    return (f"Work-precision diagram of {problem.label}, {measures.label(measure)}. Smallest error: "
            f"{'; '.join(best) or 'no finished run'}.")


def _whiskers(axes, index, runs, clock):
    """Draws thin lines from the fastest to the slowest repeat."""
    spans = [(p.clocks[clock].min, p.clocks[clock].max, error) for _, error, p in runs]
    spans = [s for s in spans if positive(s[:2]).size == 2 and s[1] > 1.05 * s[0]]
    if spans:
        axes.plot([x for low, high, _ in spans for x in (low, high, np.nan)],
                  [y for *_, y in spans for y in (y, y, np.nan)], color=colour(index), lw=1, alpha=0.55,
                  gid=f"me-{index}", zorder=2)


def _layout(width, entries, failing):
    """The layout, the box of the axes (left, top, width, height; flat if no run has finished), the height of the lane,
    and the number of columns of the legend."""
    narrow = width < WIDE
    lane = lane_height(failing)
    left, right = (46, 20) if narrow else (54, side_margin(entries))
    columns = legend_columns(entries)
    top, height = 40 + (lane + LANE_GAP if lane else 0), (290 if narrow else 400)
    height = max(90, 20 * len(entries)) if all(failed for *_, failed in entries) else height
    below = 62 + (legend_height(entries, columns) if narrow else 0)
    layout = PixelLayout(width, top + height + below)
    return layout, (left, top, width - left - right, height), lane, columns


@styled
def draw_work_precision(comparison, problem, measure, clock, width):
    runs = {k: runs_of(comparison, problem, m, measure, clock) for k, m in enumerate(comparison.methods)}
    failing, entries = failing_methods(comparison, problem), _entries(comparison, problem, runs)
    layout, box, lane, columns = _layout(width, entries, failing)
    layout.description = _description(problem, measure, runs, comparison)
    bound = problem.reference.reach(measure)
    axes = layout.axes(*box)
    times = [t for r in runs.values() for t, _, _ in r] + [p.seconds(clock) for f in failing.values() for p in f]
    set_log(axes, "x", *limits(times), seconds_tick, 4 if layout.narrow else 8)
    set_log(axes, "y", *error_limits([e for r in runs.values() for _, e, _ in r], bound), error_tick)
    draw_unresolved(axes, bound, unresolved_words(problem, measure, layout.narrow))
    for k, found in runs.items():
        if found:
            hollow = {p.index for _, _, p in found if comparison.is_near_reference(p, measure)}
            _whiskers(axes, k, found, clock)
            draw_runs(axes, k, found, hollow)
    annotate(layout, axes, box, measure, clock)
    add_failures(layout, axes, box, failing, lane, lambda p: p.seconds(clock))
    ends = [end_fraction(axes, runs[k][-1][1]) if runs[k] else 0.0 for k, _, _ in entries]
    label_runs(layout, box, entries, ends, columns)
    return layout


def annotate(layout, axes, box, measure, clock):
    """Labels the axes, or writes that no run has finished."""
    left, top, width, height = box
    layout.text(0, 16, title_of(measure), weight="bold")
    name = "Wall time" if clock == "wall" else "CPU time"
    hint = "" if layout.narrow else "   (left and down is better)"
    layout.text(left + width / 2, top + height + 40, f"{name}, median of repeats{hint}", ha="center")
    if not axes.lines:
        say_nothing_finished(layout, axes, box)
