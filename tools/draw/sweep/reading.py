"""sweep.json -> Sweep; what is wrong in the file becomes one line."""
import json
import math
from dataclasses import dataclass

from ..errors import DrawError
from ..report import formatting
from ..series import result_folder
from . import FILE

FORMAT = 1
NOISE = 1e-12  # of the largest value of a figure


@dataclass(frozen=True)
class Variable:
    name: str
    path: str  # of the key in the scene, '' for names of the sweep
    unit: str
    numeric: bool
    log: bool

    @property
    def heading(self):
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    def plain(self, value):
        """'30', 'coarse'."""
        return f"{value:.4g}".replace("-", "−") if self.numeric else str(value)

    def words(self, value):
        """'30 deg', 'coarse'."""
        return self.plain(value) + (f" {self.unit}" if self.unit and self.numeric else "")


@dataclass(frozen=True)
class Figure:
    """A wanted figure; `factor` is one of its unit in SI."""
    name: str
    title: str
    unit: str
    factor: float
    log: bool
    closed_form: str
    fails_at_one: bool = False  # an exposure to failure

    @property
    def heading(self):
        return f"{self.title} [{self.unit}]" if self.unit else self.title

    @property
    def failure(self):
        """The value from which on the material fails, in the figure's unit; nan for what is no exposure."""
        return 1 / self.factor if self.fails_at_one else math.nan

    def value(self, point):
        return _scaled(point["figures"].get(self.name), self.factor)

    def mesh_error(self, point):
        """The share by which the mesh makes it too high, estimated; nan where it has no error of its own."""
        error = (point.get("figure_errors") or {}).get(self.name)
        return math.nan if error is None else error

    def without_mesh_error(self, point):
        """The value as it would be with a fine mesh, by that estimate; nan where there is none."""
        error = self.mesh_error(point)
        return self.value(point) / (1 + error) if error > -1 else math.nan

    def shown(self, point, digits=4):
        """The value with as many digits as its error lets be known, at most `digits`."""
        return formatting.general(self.value(point), digits, self.mesh_error(point))

    def closed(self, point):
        return _scaled(point["closed_forms"].get(self.name), self.factor)

    def difference(self, point):
        """Relative to the closed form; nan where there is none."""
        value, closed = self.value(point), self.closed(point)
        return value / closed - 1 if closed and math.isfinite(closed) else math.nan


def _scaled(x, factor):
    return math.nan if x is None else x / factor


@dataclass(frozen=True)
class Sweep:
    title: str
    description: str
    combine: str
    variables: list
    figures: list
    plots: list
    frames: dict
    points: list
    about: dict  # the rest, for the details

    def variable(self, name):
        return next(v for v in self.variables if v.name == name)

    def levels(self, variable):
        """Values of a variable, numbers ascending, others in the order of the points."""
        found = dict.fromkeys(p["values"][variable.name] for p in self.points)
        return sorted(found) if variable.numeric else list(found)

    @property
    def done(self):
        return [p for p in self.points if p["status"] == "completed"]

    @property
    def failed(self):
        return [p for p in self.points if p["status"] == "failed"]


def read_sweep(result):
    path = result_folder(result) / FILE
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise DrawError(f"{path}: missing; `orthodyn sweep SWEEP.yaml` writes it") from None
    except json.JSONDecodeError as error:
        raise DrawError(f"{path}: not readable as JSON (line {error.lineno}); is it cut off?") from None
    if not isinstance(found, dict) or "orthodyn_sweep" not in found:
        raise DrawError(f"{path}: no sweep, the key orthodyn_sweep is missing")
    if found["orthodyn_sweep"] != FORMAT:
        raise DrawError(f"{path}: written in format {found['orthodyn_sweep']}, readable is format {FORMAT}")
    try:
        return _sweep(found)
    except (KeyError, TypeError) as error:
        raise DrawError(f"{path}: {error} is missing or no such thing; `orthodyn sweep` writes the file anew") from None


def _without_noise(points, figures):
    """Values of a figure that are round-off beside its largest become 0."""
    for figure in figures:
        values = [p["figures"].get(figure.name) for p in points]
        floor = NOISE * max((abs(v) for v in values if v is not None), default=0.0)
        for p, v in zip(points, values):
            if v is not None and abs(v) < floor:
                p["figures"] = {**p["figures"], figure.name: 0.0}
    return points


def _sweep(found):
    variables = [Variable(v["name"], v.get("path", ""), v["unit"], v["numeric"], v["scale"] == "log")
                 for v in found["variables"]]
    figures = [Figure(f["name"], f["title"], f["unit"], f["factor"], f["scale"] == "log", f["closed_form"],
                      f.get("fails_at_one", False))
               for f in found["figures"]]
    points = _without_noise([{**p, "index": k} for k, p in enumerate(found["points"])], figures)
    return Sweep(found["title"], found["description"], found["combine"], variables, figures, found["plots"],
                 found["frames"], points, {"ranks": found.get("ranks", 1),
                                             **{k: found[k] for k in ("file", "scene", "written", "machine", "versions",
                                                                      "definitions", "missing")}})
