"""Cost breakdown: a stacked bar for each method, of a run with about the same error."""
import numpy as np

from . import measures, theme, formatting
from .comparable import representatives, target_of
from .comparison import PARTS
from .layout import LABEL, LETTER, PixelLayout, shortened, styled
from .theme import LIGHT

NAMES = {"force": "force", "tangent": "tangent", "factorization": "factorisation", "solve": "solve", "rest": "rest"}
COLOURS = dict(zip(NAMES, ("k1", "k2", "k3", "k4", "k5")))
BAR = 20


def parts_of(point):
    """{part: seconds}; `rest`: wall time minus the other parts, at least 0."""
    parts = {part: np.nan_to_num(point.work[part].seconds) for part in PARTS}
    parts["rest"] = max(0.0, np.nan_to_num(point.seconds()) - sum(parts.values()))
    return parts


def _note(point, reached, measure, narrow, cut):
    """The text to the right of a bar. `cut`: whether the bar is truncated."""
    total = formatting.seconds(point.seconds())
    error = f"error {formatting.exponent(point.error(measure))}"
    if not reached:
        end = "; bar cut off" if cut else ""
        return f"{total} ({error}{end})" if narrow else f"{total}, {error}: target not reached{end}"
    return f"{total} ({error})" if narrow else f"{total}, {error}, {formatting.control(point.control)}"


def _bar(axes, point, index, faint):
    start, sizes = 0.0, parts_of(point)
    for part, size in sizes.items():
        if size > 0:
            axes.barh(0, size, left=start, height=1, color=LIGHT[COLOURS[part]], alpha=0.45 if faint else 1,
                      linewidth=0)[0].set_gid(f"pt-{point.index}-{index}")
        start += size
    return start


def _key(layout, top):
    """Draws the legend of the parts' colours."""
    left = 0
    for part, name in NAMES.items():
        if left + 24 + LETTER * len(name) > layout.width:
            left, top = 0, top + 20
        layout.line([left + 6], [top], marker="s", ms=10, ls="none", color=LIGHT[COLOURS[part]], mew=0)
        layout.text(left + 16, top, name)
        left += 38 + 6.6 * len(name)


@styled
def draw_cost_breakdown(comparison, problem, width):
    """The layout; None if no run has finished."""
    found = representatives(comparison, problem)
    if not found:
        return None
    measure, narrow = measures.primary(comparison), width < 500
    largest = _scale(found)
    notes = [_note(point, reached, measure, narrow, sum(parts_of(point).values()) > largest)
             for point, reached in found]
    labels = [shortened(_method(comparison, point).label, LABEL) for point, _ in found]
    left = 2 if narrow else 36 + LETTER * max(map(len, labels))
    across = width - left - LETTER * max(map(len, notes)) - 10
    pitch, top = (46, 94) if narrow else (32, 62)
    layout = PixelLayout(width, top + pitch * len(found) + 8, _description(comparison, problem, found))
    heading = f"Wall time for an error below {formatting.exponent(target_of(comparison, problem))}"
    layout.text(0, 16, heading if narrow else f"{heading}, {measures.label(measure)}", weight="bold")
    _key(layout, 44)
    for row, ((point, reached), label, note) in enumerate(zip(found, labels, notes)):
        y = top + pitch * row + (20 if narrow else 0)
        axes = layout.axes(left, y, across, BAR, xlim=(0, largest), ylim=(-0.5, 0.5))
        axes.set_axis_off()
        index = comparison.method_index(point.method)
        total = min(largest, _bar(axes, point, index, not reached))
        layout.text(left + across * total / largest + 8, y + BAR / 2, note, color=LIGHT["ink" if reached else "muted"])
        _name(layout, 0, y - 10 if narrow else y + BAR / 2, index, label)
    return layout


def _scale(found):
    """Time (s) shown by the full width: that of the slowest run that reached the target. Longer bars are truncated."""
    totals = [(sum(parts_of(point).values()), reached) for point, reached in found]
    return max([t for t, reached in totals if reached] or [t for t, _ in totals]) or 1.0


def _method(comparison, point):
    return comparison.methods[comparison.method_index(point.method)]


def _name(layout, x, y, index, label):
    layout.line([x + 6], [y], marker=theme.marker(index), ms=theme.marker_size(index, 8), ls="none",
               color=theme.colour(index), mec=LIGHT["paper"], mew=0.8)
    layout.text(x + 18, y, label)


def _description(comparison, problem, found):
    rows = []
    for point, _ in found:
        parts = ", ".join(f"{NAMES[k]} {formatting.seconds(s)}" for k, s in parts_of(point).items())
        rows.append(f"{_method(comparison, point).label} {formatting.seconds(point.seconds())} ({parts})")
    return f"Cost breakdown for {problem.label}: {'; '.join(rows)}."
