"""A metric over two numeric variables as colours, one cell per point."""
import math

import matplotlib
from matplotlib.colors import LogNorm, Normalize
from matplotlib.patches import Rectangle

from ..report.layout import WIDE, PixelLayout, styled

MAP = matplotlib.colormaps["viridis"]


def _norm(values, log):
    low, high = min(values), max(values)
    if log and low > 0 and high > low:
        return LogNorm(low, high)
    return Normalize(low, high if high > low else low + 1)


@styled
def draw_heat_map(plan, sweep, width):
    metric, xs, ys = plan.metric, sweep.levels(plan.x), sweep.levels(plan.lines)
    found = [(p, metric.value(p)) for p in plan.points(sweep) if math.isfinite(metric.value(p))]
    if not found:
        return None
    narrow = width < WIDE
    left, right, top, height = 72, 16 if narrow else 110, 40, max(120, min(360, 30 * len(ys)))
    layout = PixelLayout(width, top + height + (104 if narrow else 56),
                  f"{metric.heading} as colours over {plan.x.heading} and {plan.lines.heading}")
    layout.text(0, 16, f"{metric.heading} over {plan.x.name} and {plan.lines.name}"
               + (f"   ({plan.title})" if plan.title else ""), weight="bold")
    across = width - left - right
    axes = layout.axes(left, top, across, height, xlim=(-0.5, len(xs) - 0.5), ylim=(-0.5, len(ys) - 0.5))
    axes.grid(False)
    norm = _norm([v for _, v in found], metric.log)
    for point, value in found:
        x, y = xs.index(point["values"][plan.x.name]), ys.index(point["values"][plan.lines.name])
        axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=MAP(norm(value)), edgecolor="none",
                                 gid=f"pt-{point['index']}-0"))
    _ticks(axes, "x", xs, 4 if narrow else 9)
    _ticks(axes, "y", ys, 9)
    layout.text(left + across / 2, top + height + 38, plan.x.heading, ha="center")
    layout.text(10, top + height / 2, plan.lines.heading, ha="center", rotation=90)
    lying, standing = (left, top + height + 66, across, 12), (left + across + 22, top, 14, height)
    ends = [metric.shown(end(found, key=lambda entry: entry[1])[0]) for end in (min, max)]
    _bar(layout, norm, ends, lying if narrow else standing, narrow)
    return layout


def _ticks(axes, which, values, most):
    every = -(-len(values) // most)
    chosen = range(0, len(values), every)
    getattr(axes, f"set_{which}ticks")(chosen, [f"{values[k]:.4g}".replace("-", "−") for k in chosen])


def _bar(layout, norm, ends, box, lying):
    """Draws a colour bar from the smallest to the largest value. `ends`: their labels; `lying`: whether it is
    horizontal."""
    axes = layout.axes(*box, xlim=(0, 1), ylim=(0, 1))
    axes.grid(False)
    axes.set_xticks([]), axes.set_yticks([])
    count = 48
    for k in range(count):
        place = ((k / count, 0), 1.02 / count, 1) if lying else ((0, k / count), 1, 1.02 / count)
        axes.add_patch(Rectangle(place[0], place[1], place[2], color=MAP((k + 0.5) / count), lw=0.5))
    left, top, width, height = box
    low, high = ends
    if lying:
        layout.text(left, top + height + 12, low)
        layout.text(left + width, top + height + 12, high, ha="right")
    else:
        layout.text(left + width + 8, top + height - 6, low)
        layout.text(left + width + 8, top + 6, high)
