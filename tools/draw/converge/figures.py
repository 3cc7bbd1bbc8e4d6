"""Errors of a metric against CPU time and against the number of unknowns, with a line for each element order."""
import math

from ..report import theme
from ..report.figure_files import PageFigures, file_name, write_paper_figure
from ..report.layout import WIDE, PixelLayout, legend_height, side_margin, styled
from ..report.runs import draw_runs, draw_unresolved, end_fraction, label_runs, say_nothing_finished
from ..report.scale import error_tick, limits, positive, seconds_tick, set_log
from ..report.theme import LIGHT


def words(order):
    return "linear" if order == 1 else "quadratic"


def _count(x):
    return f"{x:g}" if x < 1e4 else error_tick(x)


AXES = {"cpu": ("CPU time", seconds_tick, lambda m, f: m.cpu_seconds.get(f.name, math.nan)),
        "unknowns": ("Unknowns", _count, lambda m, f: m.unknowns)}


def runs_of(study, metric, order, place):
    """(x, error, mesh) of the meshes whose values are positive and finite."""
    found = [(place(m, metric), m.errors.get(metric.name, math.nan), m) for m in study.of_order(order)]
    return [run for run in found if positive(run[:2]).size == 2]


def _estimates(axes, study, metric, place):
    """Draws a short stroke at the estimated error of each mesh."""
    for k, order in enumerate(study.orders):
        rows = [(place(m, metric), m.mesh_errors.get(metric.name, math.nan)) for m in study.of_order(order)]
        rows = [r for r in rows if positive(r).size == 2]
        axes.plot([x for x, _ in rows], [y for _, y in rows], ls="none", marker="_", ms=13, mew=1.6,
                  color=theme.colour(k), alpha=0.75, gid=f"me-{k}")


@styled
def draw_errors(study, metric, against, width):
    title, tick, place = AXES[against]
    runs = {k: runs_of(study, metric, order, place) for k, order in enumerate(study.orders)}
    entries = [(k, words(order), not runs[k]) for k, order in enumerate(study.orders)]
    narrow = width < WIDE
    height, left = (250 if narrow else 320), (48 if narrow else 58)
    right = 16 if narrow else side_margin(entries)
    layout = PixelLayout(width, 40 + height + 58 + (legend_height(entries, 2) if narrow else 0))
    box = (left, 40, width - left - right, height)
    axes = layout.axes(*box)
    estimates = [m.mesh_errors.get(metric.name, math.nan) for m in study.meshes]
    set_log(axes, "x", *limits([x for r in runs.values() for x, _, _ in r]), tick, 4 if narrow else 8)
    low, high = limits([e for r in runs.values() for _, e, _ in r] + estimates)
    set_log(axes, "y", low, high, error_tick)
    if math.isfinite(metric.resolution):
        draw_unresolved(axes, metric.resolution, "within the uncertainty of the limit")
    _estimates(axes, study, metric, place)
    for k, found in runs.items():
        if found:
            draw_runs(axes, k, found, {m.index for _, e, m in found if e < metric.resolution})
    axes.axhline(study.target, color=LIGHT["muted"], lw=0.8, ls=(0, (3, 3)), zorder=1)
    layout.text(0, 16, f"Error of {metric.name}, relative to its limit", weight="bold")
    layout.text(box[0] + box[2] / 2, box[1] + height + 38, title, ha="center")
    if not any(runs.values()):
        say_nothing_finished(layout, axes, box)
    ends = [end_fraction(axes, runs[k][-1][1]) if runs[k] else 0.0 for k, *_ in entries]
    label_runs(layout, box, entries, ends, 2, below=54)
    best = [f"{words(o)} down to {min(e for _, e, _ in runs[k]):.1e}" for k, o in enumerate(study.orders) if runs[k]]
    layout.description = f"Error of {metric.name} against {title}: {'; '.join(best) or 'no finished mesh'}."
    return layout


class Figures(PageFigures):
    """The figures of a convergence study."""

    def of(self, study, metric):
        """The figure of errors against CPU time. write_paper_figures() also draws errors against unknowns."""
        return self.both_widths(lambda w: draw_errors(study, metric, "cpu", w))


def write_paper_figures(study, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for metric in study.metrics:
        for against in AXES:
            yield from write_paper_figure(draw_errors(study, metric, against, WIDE),
                                          folder / file_name(f"{metric.name}_over_{against}"))
