"""sweep.json as a Sweep."""
import math
from dataclasses import dataclass

from ..report import formatting
from ..study_json import StudyKind, about, checked, number, read_study, with_unit

KIND = StudyKind("sweep.json", "orthodyn sweep", ("orthodyn_sweep", 1), (("figures", "metrics"),))
NOISE = 1e-12  # round-off, relative to the largest value of a metric


@dataclass(frozen=True)
class Variable:
    name: str
    path: str  # of the key in the scene; '' for named sets of keys and for names used in formulas
    unit: str
    numeric: bool
    log: bool

    @property
    def heading(self):
        return with_unit(self.name, self.unit)

    def plain(self, value):
        """The value as text, without unit: '30', 'coarse'."""
        return f"{value:.4g}".replace("-", "−") if self.numeric else str(value)

    def words(self, value):
        """The value as text, with unit: '30 deg', 'coarse'."""
        return self.plain(value) + (f" {self.unit}" if self.unit and self.numeric else "")


@dataclass(frozen=True)
class Metric:
    """A metric. `factor`: SI value of its unit, for example 1e-3 for mm."""
    name: str
    title: str
    unit: str
    factor: float
    log: bool
    closed_form: str
    fails_at_one: bool = False  # whether it is a failure index, so that the material fails at 1

    @property
    def heading(self):
        return with_unit(self.title, self.unit)

    @property
    def failure(self):
        """The value at which the material fails, in the metric's unit; nan unless it is a failure index."""
        return 1 / self.factor if self.fails_at_one else math.nan

    def value(self, point):
        return number(point["metrics"].get(self.name)) / self.factor

    def mesh_error(self, point):
        """Estimated relative mesh error, positive if too high; nan without an estimate."""
        return number((point.get("metric_errors") or {}).get(self.name))

    def without_mesh_error(self, point):
        """The value corrected by the estimated mesh error; nan without an estimate."""
        error = self.mesh_error(point)
        return self.value(point) / (1 + error) if error > -1 else math.nan

    def shown(self, point, digits=4):
        """The value with the digits that exceed its mesh error, at most `digits`."""
        return formatting.general(self.value(point), digits, self.mesh_error(point))

    def closed(self, point):
        return number(point["closed_forms"].get(self.name)) / self.factor

    def difference(self, point):
        """The difference from the closed form, relative to it; nan without a closed form."""
        value, closed = self.value(point), self.closed(point)
        return value / closed - 1 if closed and math.isfinite(closed) else math.nan


@dataclass(frozen=True)
class Sweep:
    title: str
    description: str
    combine: str
    variables: list
    metrics: list
    plots: list
    frames: dict
    points: list
    about: dict  # what the page's details say about the study

    def variable(self, name):
        return next(v for v in self.variables if v.name == name)

    def levels(self, variable):
        """The values of a variable: numbers in ascending order, others in the order of the points."""
        found = dict.fromkeys(p["values"][variable.name] for p in self.points)
        return sorted(found) if variable.numeric else list(found)

    @property
    def done(self):
        return [p for p in self.points if p["status"] == "completed"]

    @property
    def failed(self):
        return [p for p in self.points if p["status"] == "failed"]


def read_sweep(result):
    return checked(read_study(result, KIND), _sweep)


def _without_noise(points, metrics):
    """Replaces by 0 the values of a metric that are only round-off, relative to its largest value."""
    for metric in metrics:
        values = [p["metrics"].get(metric.name) for p in points]
        floor = NOISE * max((abs(v) for v in values if v is not None), default=0.0)
        for p, v in zip(points, values):
            if v is not None and abs(v) < floor:
                p["metrics"] = {**p["metrics"], metric.name: 0.0}
    return points


def _sweep(found):
    variables = [Variable(v["name"], v.get("path", ""), v["unit"], v["numeric"], v["scale"] == "log")
                 for v in found["variables"]]
    metrics = [Metric(f["name"], f["title"], f["unit"], f["factor"], f["scale"] == "log", f["closed_form"],
                      f.get("fails_at_one", False))
               for f in found["metrics"]]
    points = _without_noise([{**p, "index": k} for k, p in enumerate(found["points"])], metrics)
    return Sweep(found["title"], found["description"], found["combine"], variables, metrics, found["plots"],
                 found["frames"], points, about(found, ("file", "scene", "written", "machine", "versions", "definitions", "missing")))
