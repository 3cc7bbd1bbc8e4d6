"""All figures of a fit: in two widths for the page, and as files for papers."""
from ..report.figure_files import PageFigures, distinct, file_name, write_paper_figure
from ..report.layout import WIDE
from .field_plot import draw_field
from .matrix_plot import draw_correlation, draw_directions
from .residual_plot import draw_residuals
from .search_plot import draw_search
from .series_plot import draw_series


class Figures(PageFigures):
    """The figures of a fit."""

    def series(self, series):
        return self.both_widths(lambda w: draw_series(series, w))

    def residuals(self, experiment, data):
        return self.both_widths(lambda w: draw_residuals(experiment, data, w))

    def field(self, field):
        return self.both_widths(lambda w: draw_field(field, w))

    def correlation(self, fit):
        return self.both_widths(lambda w: draw_correlation(fit, w))

    def directions(self, fit):
        return self.both_widths(lambda w: draw_directions(fit, w))

    def search(self, fit):
        return self.both_widths(lambda w: draw_search(fit, w))


def _paper_figures(fit):
    """(name, layout) of each figure; the layout is None if there is nothing to draw."""
    for series in fit.series:
        yield f"fit_{series.experiment}_{series.quantity}", draw_series(series, WIDE)
    for experiment, data in fit.single.items():
        yield f"residuals_{experiment}", draw_residuals(experiment, data, WIDE)
    for field in fit.fields:
        yield f"field_{field.name}", draw_field(field, WIDE)
    yield "correlation", draw_correlation(fit, WIDE)
    yield "combinations", draw_directions(fit, WIDE)
    yield "chi_square", draw_search(fit, WIDE)


def write_paper_figures(fit, folder):
    folder.mkdir(parents=True, exist_ok=True)
    taken = set()
    for name, layout in _paper_figures(fit):
        yield from write_paper_figure(layout, folder / distinct(file_name(name), taken))
