"""The figures of a comparison: variants for the page, and files for papers."""
from . import measures
from .cost import draw_cost_breakdown
from .drift import draw_energy_drift
from .pareto_front import draw_pareto_front
from .figure_files import PageFigures, distinct, file_name, write_paper_figure
from .layout import WIDE
from .markup import tag
from .scale import positive
from .tolerance import draw_error_against_control
from .work_precision import draw_work_precision

CLOCKS = {"wall": "wall time", "cpu": "CPU time"}


class Figures(PageFigures):
    """The figures of a comparison."""

    def __init__(self, comparison):
        super().__init__()
        self.comparison = comparison
        self.primary = measures.primary(comparison)

    def pareto_front(self, front, measure=None, clock="cpu"):
        measure = measure or self.primary
        return self.both_widths(lambda w: draw_pareto_front(self.comparison, front, measure, clock, w))

    def work_precision(self, problem, measure=None, clock="wall"):
        measure = measure or self.primary
        return self.both_widths(lambda w: draw_work_precision(self.comparison, problem, measure, clock, w))

    def tolerance(self, problem, measure=None):
        measure = measure or self.primary
        return self.both_widths(lambda w: draw_error_against_control(self.comparison, problem, measure, w))

    def cost(self, problem):
        return self.both_widths(lambda w: draw_cost_breakdown(self.comparison, problem, w))

    def drift(self, problem):
        return self.both_widths(lambda w: draw_energy_drift(self.comparison, problem, w))

    def choices(self):
        """The available pairs (measure, clock). The page first shows the first of them."""
        found = measures.present(self.comparison.points) or [self.primary]
        found.sort(key=lambda m: m != self.primary)
        clocks = [c for c in CLOCKS if c == "wall" or positive(p.seconds(c) for p in self.comparison.points).size]
        clocks.sort(key=lambda c: c != self.comparison.clock)
        pairs = [(m, clocks[0]) for m in found] + [(m, c) for m in found for c in clocks[1:]]
        return sorted(pairs, key=lambda pair: pair[0] != self.primary)

    def variants(self, room):
        """{(figure, problem id): templates} for choices other than the first, and the list of choices included. Choices
        are left out when the templates would exceed `room` characters."""
        first, *others = self.choices()
        found, offered = {}, [first]
        for measure, clock in others:
            group = self._group(measure, clock)
            room -= sum(map(len, group.values()))
            if room < 0:
                break
            offered.append((measure, clock))
            for key, template in group.items():
                found.setdefault(key, []).append(template)
        return found, offered

    def _group(self, measure, clock):
        """The templates of one choice for all problems. Figures of error against tolerance do not depend on the
        clock."""
        group = {}
        for front in self.comparison.pareto_fronts:
            group["front", front.id] = tag("template", self.pareto_front(front, measure, clock), data_measure=measure,
                                           data_clock=clock)
        for problem in self.comparison.problems:
            if not self.comparison.pareto_fronts:
                group["wp", problem.id] = tag("template", self.work_precision(problem, measure, clock),
                                              data_measure=measure, data_clock=clock)
            if clock == self.comparison.clock:
                group["tol", problem.id] = tag("template", self.tolerance(problem, measure), data_measure=measure)
        return group


def _paper_figures(comparison, problem):
    """(name, function that draws the figure) for each figure of a problem."""
    measure = measures.primary(comparison)
    return (*((("work_precision", lambda: draw_work_precision(comparison, problem, measure, "wall", WIDE)),)
              if not comparison.pareto_fronts else ()),
            ("error_against_control", lambda: draw_error_against_control(comparison, problem, measure, WIDE)),
            ("drift_against_control",
             lambda: draw_error_against_control(comparison, problem, measures.DRIFT + "energy", WIDE)),
            ("cost_breakdown", lambda: draw_cost_breakdown(comparison, problem, WIDE)),
            ("energy_drift", lambda: draw_energy_drift(comparison, problem, WIDE)))


def _named(items):
    """Pairs of a problem or Pareto front and an id that can be used in file names."""
    taken = set()
    for item in items:
        yield item, distinct(file_name(item.id).strip("._") or "problem", taken)


def write_paper_figures(comparison, folder):
    """Writes FIGURE_PROBLEM.svg and .png; yields their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    for front, name in _named(comparison.pareto_fronts):
        yield from write_paper_figure(draw_pareto_front(comparison, front, measures.primary(comparison), "cpu", WIDE),
                                      folder / f"front_{name}")
    for problem, name in _named(comparison.problems):
        for figure, draw in _paper_figures(comparison, problem):
            yield from write_paper_figure(draw(), folder / f"{figure}_{name}")
