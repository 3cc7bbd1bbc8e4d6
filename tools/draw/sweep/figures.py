"""All figures of a sweep: in two widths for the page, and as files for papers."""
from ..report.figure_files import PageFigures, distinct, file_name, write_paper_figure
from ..report.layout import WIDE
from .curves import draw_curves, draw_differences
from .dot_plot import draw_dot_plot
from .heat_map import draw_heat_map
from .plan import has_map, plans


def drawings(plan, sweep):
    """The functions that draw a plan's figures. They take the width, and return a layout or None if there is nothing to
    draw."""
    if not plan.x.numeric:
        return [lambda w: draw_dot_plot(plan, sweep, w)]
    found = [lambda w: draw_curves(plan, sweep, w), lambda w: draw_differences(plan, sweep, w)]
    return found + [lambda w: draw_heat_map(plan, sweep, w)] if has_map(plan, sweep) else found


class Figures(PageFigures):
    """The figures of a sweep."""

    def of(self, sweep, plan):
        """The figures of a plan, each in both widths."""
        return [picture for draw in drawings(plan, sweep) if (picture := self.both_widths(draw))]


def write_paper_figures(sweep, folder):
    folder.mkdir(parents=True, exist_ok=True)
    taken = set()
    for plan in plans(sweep):
        for kind, draw in zip(("", "_difference", "_map"), drawings(plan, sweep)):
            layout = draw(WIDE)
            if layout is None:
                continue
            name = file_name(f"{plan.metric.name}_over_{plan.x.name}_{plan.title}".rstrip("_") + kind)
            yield from write_paper_figure(layout, folder / distinct(name, taken))
