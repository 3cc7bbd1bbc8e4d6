"""Dot plot for a variable with names: a row for each name, a mark for each line, a stroke for the closed form."""
import math

from ..report import theme
from ..report.layout import LETTER, WIDE, PixelLayout, legend_columns, legend_height, shortened, styled
from ..report.scale import limits, positive, set_log
from ..report.theme import LIGHT
from .curves import power_tick, scaled

ROW = 26


@styled
def draw_dot_plot(plan, sweep, width):
    names = sweep.levels(plan.x)
    narrow = width < WIDE
    labels = [shortened(str(n), 14 if narrow else 26) for n in names]
    entries = [(k, shortened(plan.line_words(level), 26), False)
               for k, level in enumerate(plan.line_levels(sweep))] if plan.lines else []
    columns = legend_columns(entries, width)
    left, top = 12 + LETTER * max(map(len, labels)), 36 + (legend_height(entries, columns) if entries else 0)
    height = ROW * len(names)
    layout = PixelLayout(width, top + height + 44, f"{plan.metric.heading} of {', '.join(map(str, names))}")
    layout.text(0, 16, plan.metric.heading + (f"   ({plan.title})" if plan.title else ""), weight="bold")
    layout.legend(30, entries, columns)
    axes = layout.axes(left, top, width - left - 24, height)
    rows = [(k, p) for k, level in enumerate(plan.line_levels(sweep)) for p in plan.of_line(sweep, level)]
    ends = (plan.metric.value, plan.metric.closed, plan.metric.without_mesh_error)
    values = [v for _, p in rows for end in ends if math.isfinite(v := end(p))]
    most = 4 if narrow else 7
    if values and len(positive(values)) == len(values) and max(values) > 8 * min(values):
        set_log(axes, "x", *limits(values, least=0.5), power_tick, most)
    else:
        scaled(axes, "x", values + [0], False, most)
    if axes.get_xlim()[0] <= plan.metric.failure <= axes.get_xlim()[1]:
        axes.axvline(plan.metric.failure, color=LIGHT["muted"], lw=0.8, zorder=1)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_yticks(range(len(names)), labels)
    for k, p in rows:
        _row(axes, plan, k, names.index(p["values"][plan.x.name]), p)
    return layout


def _row(axes, plan, k, y, point):
    value, closed, colour = plan.metric.value(point), plan.metric.closed(point), theme.colour(k)
    if math.isfinite(closed):
        axes.plot([closed, closed], [y - 0.36, y + 0.36], color=LIGHT["muted"], lw=1.6, zorder=2)
    without = plan.metric.without_mesh_error(point)
    if math.isfinite(value) and math.isfinite(without):
        axes.plot([value, without], [y, y], color=colour, lw=1.0, alpha=0.6, zorder=3)
    if math.isfinite(value):
        axes.plot([value], [y], marker=theme.marker(k), ms=theme.marker_size(k, 8.5), ls="none", mfc=colour,
                  mec=LIGHT["paper"], mew=0.8, gid=f"pt-{point['index']}-{k}", zorder=4, clip_on=False)
