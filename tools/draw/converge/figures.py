"""Errors of a figure against CPU time and against the number of unknowns, one line for each order of elements."""
import math
import re

import matplotlib

from ..report import theme
from ..report.figures import PAPER, PAPER_DPI, both_widths
from ..report.layout import WIDE, PixelLayout, legend_height, side_margin, styled
from ..report.runs import draw_runs, draw_unresolved, end_fraction, label_right, say_nothing_finished
from ..report.scale import error_tick, limits, positive, seconds_tick, set_log
from ..report.svg import Styles
from ..report.theme import LIGHT

def words(order):
    return "linear" if order == 1 else "quadratic"


def _count(x):
    return f"{x:g}" if x < 1e4 else error_tick(x)


AXES = {"cpu": ("CPU time", seconds_tick, lambda m, f: m.cpu_seconds.get(f.name, math.nan)),
        "unknowns": ("Unknowns", _count, lambda m, f: m.unknowns)}


def runs_of(study, figure, order, place):
    """(x, error, mesh) of the meshes that a logarithmic diagram can show."""
    found = [(place(m, figure), m.errors.get(figure.name, math.nan), m) for m in study.of_order(order)]
    return [run for run in found if positive(run[:2]).size == 2]


def _estimates(axes, study, figure, place):
    """Short strokes at what the recovered stresses say of each mesh."""
    for k, order in enumerate(study.orders):
        rows = [(place(m, figure), m.mesh_errors.get(figure.name, math.nan)) for m in study.of_order(order)]
        rows = [r for r in rows if positive(r).size == 2]
        axes.plot([x for x, _ in rows], [y for _, y in rows], ls="none", marker="_", ms=13, mew=1.6,
                  color=theme.colour(k), alpha=0.75, gid=f"me-{k}")


@styled
def draw_errors(study, figure, against, width):
    title, tick, place = AXES[against]
    runs = {k: runs_of(study, figure, order, place) for k, order in enumerate(study.orders)}
    entries = [(k, words(order), not runs[k]) for k, order in enumerate(study.orders)]
    narrow = width < WIDE
    height, left = (250 if narrow else 320), (48 if narrow else 58)
    right = 16 if narrow else side_margin(entries)
    layout = PixelLayout(width, 40 + height + 58 + (legend_height(entries, 2) if narrow else 0))
    box = (left, 40, width - left - right, height)
    axes = layout.axes(*box)
    estimates = [m.mesh_errors.get(figure.name, math.nan) for m in study.meshes]
    set_log(axes, "x", *limits([x for r in runs.values() for x, _, _ in r]), tick, 4 if narrow else 8)
    low, high = limits([e for r in runs.values() for _, e, _ in r] + estimates)
    set_log(axes, "y", low, high, error_tick)
    if math.isfinite(figure.resolution):
        draw_unresolved(axes, figure.resolution, "within the uncertainty of the limit")
    _estimates(axes, study, figure, place)
    for k, found in runs.items():
        if found:
            draw_runs(axes, k, found, {m.index for _, e, m in found if e < figure.resolution})
    axes.axhline(study.target, color=LIGHT["muted"], lw=0.8, ls=(0, (3, 3)), zorder=1)
    layout.text(0, 16, f"Error of {figure.name}, relative to its limit", weight="bold")
    layout.text(box[0] + box[2] / 2, box[1] + height + 38, title, ha="center")
    if not any(runs.values()):
        say_nothing_finished(layout, axes, box)
    if narrow:
        layout.legend(box[1] + height + 54, entries, 2)
    else:
        label_right(layout, box, entries, [end_fraction(axes, runs[k][-1][1]) if runs[k] else 0.0 for k, *_ in entries])
    best = [f"{words(o)} down to {min(e for _, e, _ in runs[k]):.1e}" for k, o in enumerate(study.orders) if runs[k]]
    layout.description = f"Error of {figure.name} against {title}: {'; '.join(best) or 'no finished mesh'}."
    return layout


class Figures:
    """SVGs of one page, each with ids of its own."""

    def __init__(self, study):
        self.study, self.styles, self.drawn = study, Styles(), 0

    def of(self, figure):
        """Over the CPU time; write_paper_figures() has the others."""
        self.drawn += 1
        return both_widths(lambda w: draw_errors(self.study, figure, "cpu", w), self.styles, f"f{self.drawn - 1}")


def write_paper_figures(study, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for figure in study.figures:
        for against in AXES:
            layout = draw_errors(study, figure, against, WIDE)
            name = re.sub(r"[^\w.-]+", "_", f"{figure.name}_over_{against}")
            svg, png = (folder / f"{name}.{ending}" for ending in ("svg", "png"))
            with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": svg.stem}):
                layout.figure.savefig(svg, metadata={"Date": None}, **PAPER)
            layout.figure.savefig(png, dpi=PAPER_DPI, **PAPER)
            yield svg
            yield png
