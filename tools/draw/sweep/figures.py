"""All figures of a sweep: for the page in two widths, for papers as files."""
import re

import matplotlib

from ..report.figures import PAPER, PAPER_DPI, both_widths
from ..report.layout import WIDE
from ..report.svg import Styles
from .curves import draw_curves, draw_differences
from .dot_plot import draw_dot_plot
from .heat_map import draw_heat_map
from .plan import has_map, plans


def drawings(plan, sweep):
    """Functions of the width that draw a figure, or None where there is nothing to draw."""
    if not plan.x.numeric:
        return [lambda w: draw_dot_plot(plan, sweep, w)]
    found = [lambda w: draw_curves(plan, sweep, w), lambda w: draw_differences(plan, sweep, w)]
    return found + [lambda w: draw_heat_map(plan, sweep, w)] if has_map(plan, sweep) else found


class Figures:
    """SVGs of one page, each with ids of its own."""

    def __init__(self, sweep):
        self.sweep, self.styles, self.drawn = sweep, Styles(), 0

    def of(self, plan):
        """Pictures of a plan, both widths of each."""
        found = []
        for draw in drawings(plan, self.sweep):
            picture = both_widths(draw, self.styles, f"f{self.drawn}")
            self.drawn += 1
            if picture:
                found.append(picture)
        return found


def write_paper_figures(sweep, folder):
    folder.mkdir(parents=True, exist_ok=True)
    taken = set()
    for plan in plans(sweep):
        for kind, draw in zip(("", "_difference", "_map"), drawings(plan, sweep)):
            layout = draw(WIDE)
            if layout is None:
                continue
            name = re.sub(r"[^\w.-]+", "_", f"{plan.figure.name}_over_{plan.x.name}_{plan.title}".rstrip("_") + kind)
            while name in taken:
                name += "_"
            taken.add(name)
            svg, png = (folder / f"{name}.{ending}" for ending in ("svg", "png"))
            with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": svg.stem}):
                layout.figure.savefig(svg, metadata={"Date": None}, **PAPER)
            layout.figure.savefig(png, dpi=PAPER_DPI, **PAPER)
            yield svg
            yield png
