"""Which figures a sweep has: what is along the axis, what makes lines, what makes separate figures."""
from dataclasses import dataclass
from itertools import islice, product
from math import prod

MOST_LINES, MOST_PANELS, LEAST_FOR_A_MAP = 8, 8, 4


@dataclass(frozen=True)
class Plan:
    """One figure: points whose other variables have the values `fixed`."""
    figure: object
    x: object
    lines: object  # or None
    fixed: dict

    def points(self, sweep):
        return [p for p in sweep.done if all(p["values"][k] == v for k, v in self.fixed.items())]

    def line_levels(self, sweep):
        return sweep.levels(self.lines) if self.lines else [None]

    def line_words(self, level):
        """'ratio 30', 'coarse'."""
        return f"{self.lines.name} {self.lines.words(level)}" if self.lines.numeric else str(level)

    def of_line(self, sweep, level):
        """Its points, along x."""
        rows = [p for p in self.points(sweep) if not self.lines or p["values"][self.lines.name] == level]
        return sorted(rows, key=lambda p: p["values"][self.x.name]) if self.x.numeric else rows

    @property
    def title(self):
        return ", ".join(f"{name} {value:g}" if isinstance(value, (int, float)) else f"{name} {value}"
                         for name, value in self.fixed.items())


def _by_size(sweep):
    """Numeric variables first, then by how many values they have."""
    return sorted(sweep.variables, key=lambda v: (not v.numeric, -len(sweep.levels(v))))


def _usual_roles(sweep):
    """(x, lines) for every figure that is drawn of a quantity."""
    ordered = _by_size(sweep)
    if sweep.combine == "latin_hypercube":
        return [(v, None) for v in sweep.variables]
    if sweep.combine == "zip":
        return [(ordered[0], None)]
    several = [v for v in ordered[1:] if len(sweep.levels(v)) > 1]
    lines = next((v for v in reversed(several) if len(sweep.levels(v)) <= MOST_LINES), None)
    return [(ordered[0], lines)]


def _others(sweep, x, lines):
    """The remaining variables; where values go side by side there are none."""
    return [v for v in sweep.variables if v not in (x, lines)] if sweep.combine == "cartesian" else []


def _panels(sweep, x, lines):
    """Values of the remaining variables, of the first combinations."""
    others = _others(sweep, x, lines)
    combinations = islice(product(*(sweep.levels(v) for v in others)), MOST_PANELS)
    return [dict(zip((v.name for v in others), values)) for values in combinations]


def _roles(sweep):
    """(figure, x, lines) of all that is drawn."""
    for figure in sweep.figures:
        wished = [(sweep.variable(p["x"]) if p["x"] else None, sweep.variable(p["lines"]) if p["lines"] else None)
                  for p in sweep.plots if p["figure"] == figure.name]
        if sweep.plots and not wished:
            continue
        usual = _usual_roles(sweep)
        for x, lines in wished or usual:
            x, lines = x or usual[0][0], lines or (usual[0][1] if not x else None)
            yield figure, x, lines


def plans(sweep):
    return [Plan(figure, x, lines, fixed) for figure, x, lines in _roles(sweep) for fixed in _panels(sweep, x, lines)]


def left_out(sweep):
    """(figure, how many combinations there are, of which variables) where not all of them are drawn."""
    for figure, x, lines in _roles(sweep):
        others = _others(sweep, x, lines)
        count = prod(len(sweep.levels(v)) for v in others)
        if count > MOST_PANELS:
            yield figure, count, others


def has_map(plan, sweep):
    """Two numbers with some values each are also a surface."""
    return bool(plan.lines and plan.lines.numeric and plan.x.numeric and
                min(len(sweep.levels(plan.x)), len(sweep.levels(plan.lines))) >= LEAST_FOR_A_MAP)
