"""Draws figures: for the page in two widths and several variants, for papers as files."""
import re

import matplotlib

from . import measures
from .cost import draw_cost_breakdown
from .drift import draw_energy_drift
from .front import draw_front
from .layout import NARROW, WIDE
from .markup import Html, tag
from .scale import positive
from .svg import Styles, page_svg
from .tolerance import draw_error_against_control
from .work_precision import draw_work_precision

PAPER_DPI = 220
PAPER = {"bbox_inches": "tight", "pad_inches": 0.08, "facecolor": "white"}
CLOCKS = {"wall": "wall time", "cpu": "CPU time"}


def both_widths(draw, styles, salt):
    """`draw(width)` as a wide and a narrow SVG, of which the page shows one; None where nothing is drawn."""
    parts = []
    for name, width in (("wide", WIDE), ("narrow", NARROW)):
        layout = draw(width)
        if layout is None:
            return None
        parts.append(tag("div", Html(page_svg(layout, salt + name[0], styles)), class_=name))
    return Html("".join(parts))


class Figures:
    """Figures of one comparison; every SVG gets ids of its own."""

    def __init__(self, comparison):
        self.comparison = comparison
        self.primary = measures.primary(comparison)
        self.styles = Styles()
        self._drawn = 0

    def both_widths(self, draw):
        self._drawn += 1
        return both_widths(draw, self.styles, f"f{self._drawn}")

    def front(self, front, measure=None, clock="cpu"):
        measure = measure or self.primary
        return self.both_widths(lambda w: draw_front(self.comparison, front, measure, clock, w))

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
        """(measure, clock) that runs have, the first ones first; the very first is shown without asking."""
        found = measures.present(self.comparison.points) or [self.primary]
        found.sort(key=lambda m: m != self.primary)
        clocks = [c for c in CLOCKS if c == "wall" or positive(p.seconds(c) for p in self.comparison.points).size]
        clocks.sort(key=lambda c: c != self.comparison.clock)
        pairs = [(m, clocks[0]) for m in found] + [(m, c) for m in found for c in clocks[1:]]
        return sorted(pairs, key=lambda pair: pair[0] != self.primary)

    def variants(self, room):
        """{(figure, problem id): templates} of all choices but the first, as far as `room` characters allow;
        and the choices that are in it."""
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
        """The templates of one choice for all problems; tolerances do not depend on the clock."""
        group = {}
        for front in self.comparison.fronts:
            group["front", front.id] = tag("template", self.front(front, measure, clock), data_measure=measure,
                                           data_clock=clock)
        for problem in self.comparison.problems:
            if not self.comparison.fronts:
                group["wp", problem.id] = tag("template", self.work_precision(problem, measure, clock),
                                              data_measure=measure, data_clock=clock)
            if clock == self.comparison.clock:
                group["tol", problem.id] = tag("template", self.tolerance(problem, measure), data_measure=measure)
        return group


def _paper_figures(comparison, problem):
    """(name, function that draws it)."""
    measure = measures.primary(comparison)
    return (*((("work_precision", lambda: draw_work_precision(comparison, problem, measure, "wall", WIDE)),)
              if not comparison.fronts else ()),
            ("error_against_control", lambda: draw_error_against_control(comparison, problem, measure, WIDE)),
            ("drift_against_control",
             lambda: draw_error_against_control(comparison, problem, measures.DRIFT + "energy", WIDE)),
            ("cost_breakdown", lambda: draw_cost_breakdown(comparison, problem, WIDE)),
            ("energy_drift", lambda: draw_energy_drift(comparison, problem, WIDE)))


def _named(items):
    """Problems or fronts, with their ids as parts of file names."""
    taken = set()
    for item in items:
        name = re.sub(r"[^\w.-]+", "_", item.id).strip("._") or "problem"
        while name in taken:
            name += "_"
        taken.add(name)
        yield item, name


def write_paper_figures(comparison, folder):
    """Writes FIGURE_PROBLEM.svg and .png; yields their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    for front, name in _named(comparison.fronts):
        yield from _written(draw_front(comparison, front, measures.primary(comparison), "cpu", WIDE),
                            folder / f"front_{name}")
    for problem, name in _named(comparison.problems):
        for figure, draw in _paper_figures(comparison, problem):
            yield from _written(draw(), folder / f"{figure}_{name}")


def _written(layout, stem):
    """Writes STEM.svg and STEM.png, of a figure that there is."""
    if layout is None:
        return
    svg, png = (stem.with_name(f"{stem.name}.{kind}") for kind in ("svg", "png"))
    with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": svg.stem}):
        layout.figure.savefig(svg, metadata={"Date": None}, **PAPER)
    layout.figure.savefig(png, dpi=PAPER_DPI, **PAPER)
    yield svg
    yield png
