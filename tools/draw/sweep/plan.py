"""Plans the figures of a sweep: which variable is the x axis, which makes lines, and which make separate figures."""
from dataclasses import dataclass
from itertools import islice, product
from math import prod

MOST_LINES, MOST_PANELS, LEAST_FOR_A_MAP = 8, 8, 4


@dataclass(frozen=True)
class Plan:
    """One figure of a metric. It shows the points at which the other variables have the values `fixed`."""
    metric: object
    x: object
    lines: object  # the variable with a line for each value, or None
    fixed: dict

    def points(self, sweep):
        return [p for p in sweep.done if all(p["values"][k] == v for k, v in self.fixed.items())]

    def line_levels(self, sweep):
        return sweep.levels(self.lines) if self.lines else [None]

    def line_words(self, level):
        """The label of a line: 'ratio 30', 'coarse'."""
        return f"{self.lines.name} {self.lines.words(level)}" if self.lines.numeric else str(level)

    def of_line(self, sweep, level):
        """The points of a line, along x."""
        rows = [p for p in self.points(sweep) if not self.lines or p["values"][self.lines.name] == level]
        return sorted(rows, key=lambda p: p["values"][self.x.name]) if self.x.numeric else rows

    @property
    def title(self):
        return ", ".join(f"{name} {value:g}" if isinstance(value, (int, float)) else f"{name} {value}"
                         for name, value in self.fixed.items())


def _by_size(sweep):
    """The variables sorted: numeric ones first, and among equals those with the most values."""
    return sorted(sweep.variables, key=lambda v: (not v.numeric, -len(sweep.levels(v))))


def _usual_roles(sweep):
    """The default pairs (x, lines) for the figures of a metric."""
    ordered = _by_size(sweep)
    if sweep.combine == "latin_hypercube":
        return [(v, None) for v in sweep.variables]
    if sweep.combine == "zip":
        return [(ordered[0], None)]
    several = [v for v in ordered[1:] if len(sweep.levels(v)) > 1]
    lines = next((v for v in reversed(several) if len(sweep.levels(v)) <= MOST_LINES), None)
    return [(ordered[0], lines)]


def _others(sweep, x, lines):
    """The variables other than x and lines; none unless the sweep is cartesian."""
    return [v for v in sweep.variables if v not in (x, lines)] if sweep.combine == "cartesian" else []


def _panels(sweep, x, lines):
    """The combinations of values of the other variables, at most MOST_PANELS."""
    others = _others(sweep, x, lines)
    combinations = islice(product(*(sweep.levels(v) for v in others)), MOST_PANELS)
    return [dict(zip((v.name for v in others), values)) for values in combinations]


def _roles(sweep):
    """(metric, x, lines) of all figures."""
    for metric in sweep.metrics:
        wished = [(sweep.variable(p["x"]) if p["x"] else None, sweep.variable(p["lines"]) if p["lines"] else None)
                  for p in sweep.plots if p["metric"] == metric.name]
        if sweep.plots and not wished:
            continue
        usual = _usual_roles(sweep)
        for x, lines in wished or usual:
            x, lines = x or usual[0][0], lines or (usual[0][1] if not x else None)
            yield metric, x, lines


def plans(sweep):
    return [Plan(metric, x, lines, fixed) for metric, x, lines in _roles(sweep) for fixed in _panels(sweep, x, lines)]


def left_out(sweep):
    """(metric, number of combinations, variables) of figures for which only the first MOST_PANELS combinations are
    drawn."""
    for metric, x, lines in _roles(sweep):
        others = _others(sweep, x, lines)
        count = prod(len(sweep.levels(v)) for v in others)
        if count > MOST_PANELS:
            yield metric, count, others


def has_map(plan, sweep):
    """Whether to draw a heat map, which needs two numeric variables with several values each."""
    return bool(plan.lines and plan.lines.numeric and plan.x.numeric and
                min(len(sweep.levels(plan.x)), len(sweep.levels(plan.lines))) >= LEAST_FOR_A_MAP)
