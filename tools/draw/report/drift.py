"""Energy drift over time, one line per method, of runs at the same tolerance."""
import math
from collections import Counter

import numpy as np

from . import formatting
from .comparable import USUAL, representatives
from .layout import CONTROL, LABEL, WIDE, PixelLayout, legend_columns, legend_height, shortened, side_margin, styled
from .runs import end_fraction, label_runs
from .scale import error_tick, limits, positive, set_log
from .theme import LIGHT, colour, dashes

MOST_SAMPLES = 200
FLOOR = 1e-18  # smaller drifts are round-off


def _usable(point):
    return positive(np.abs(point.drift_energy)).size > 0


def _tolerance(p):
    return p.control.value if p.control.kind == "rtol" and p.control.value > 0 else math.nan


def shared_tolerance(comparison, problem):
    """The tolerance at which most methods have a history; among several such tolerances, the nearest to 1e-3. nan if
    there is none."""
    counts = Counter(_tolerance(p) for p in comparison.finished(problem) if _usable(p) and _tolerance(p) > 0)
    return min(counts, key=lambda rtol: (-counts[rtol], abs(math.log10(rtol / USUAL)), rtol), default=math.nan)


def drift_runs(comparison, problem):
    """For each method, a run with a history: the one nearest to the shared tolerance. For methods without a tolerance:
    the representative, or the run of the nearest cost."""
    found, shared = [], shared_tolerance(comparison, problem)
    for point, _ in representatives(comparison, problem):
        runs = [p for p in comparison.finished(problem, point.method) if _usable(p)]
        asked = [p for p in runs if _tolerance(p) > 0]
        if asked:
            found.append(min(asked, key=lambda p: abs(math.log(_tolerance(p) / shared))))
        elif runs:
            found.append(min(runs, key=lambda p: (p is not point, abs(p.seconds() - point.seconds()))))
    return sorted(found, key=lambda p: comparison.method_index(p.method))


def _name(comparison, point, shared):
    """A method's label, with its control if it is not the shared tolerance."""
    label = comparison.methods[comparison.method_index(point.method)].label
    return label if _tolerance(point) == shared else f"{label}, {formatting.control(point.control)}"


def _history(point):
    """Times and |drift|. Zeros become gaps, because the axis is logarithmic."""
    every = max(1, len(point.drift_times) // MOST_SAMPLES)
    size = np.abs(point.drift_energy[::every])
    return point.drift_times[::every], np.where(size > FLOOR, size, np.nan)


def _draw_histories(axes, indices, histories):
    """Draws |drift|; returns the end of each line, for its label."""
    # The drift starts at zero. Its first values must not extend the logarithmic axis by many decades.
    values = np.concatenate([size[np.isfinite(size)] for _, size in histories])
    set_log(axes, "y", *limits(values[values >= np.quantile(values, 0.02)] if values.size else values), error_tick)
    ends = []
    for k, (times, size) in zip(indices, histories):
        axes.plot(times, size, color=colour(k), ls=dashes(k), lw=1.5, gid=f"me-{k}")
        last = size[np.isfinite(size)]
        ends.append(end_fraction(axes, last[-1] if last.size else np.nan))
    return ends


@styled
def draw_energy_drift(comparison, problem, width):
    """The layout; None if no run has a history."""
    found = drift_runs(comparison, problem)
    if not found:
        return None
    indices = [comparison.method_index(p.method) for p in found]
    shared = shared_tolerance(comparison, problem)
    entries = [(k, shortened(_name(comparison, p, shared), LABEL + CONTROL), False) for k, p in zip(indices, found)]
    columns, narrow = legend_columns(entries), width < WIDE
    left, right, height = (50, 20, 230) if narrow else (54, side_margin(entries, most=0.44 * WIDE), 270)
    box = (left, 40, width - left - right, height)
    layout = PixelLayout(width, 40 + height + 62 + (legend_height(entries, columns) if narrow else 0),
                  _description(comparison, problem, found))
    axes = layout.axes(*box)
    ends = _draw_histories(axes, indices, [_history(point) for point in found])
    axes.margins(x=0.0)
    if problem.end > problem.start:
        axes.set_xlim(problem.start, problem.end)
    axes.locator_params(axis="x", nbins=4 if narrow else 8)
    at = f" at rtol {formatting.exponent(shared, 3)}" if shared > 0 else ""
    layout.text(0, 16, f"Energy drift{at}, |change| / largest energy", weight="bold")
    layout.text(left + box[2] / 2, 40 + height + 40, "Time in the scene [s]", ha="center", color=LIGHT["ink"])
    label_runs(layout, box, entries, ends, columns)
    return layout


def _description(comparison, problem, found):
    rows = [f"{comparison.methods[comparison.method_index(p.method)].label} "
            f"{formatting.exponent(p.drift.get('energy', np.nan))} ({formatting.control(p.control)})" for p in found]
    return f"Energy drift over time for {problem.label}; largest: {'; '.join(rows)}."
