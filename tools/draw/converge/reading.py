"""convergence.json as a Study."""
import math
from dataclasses import dataclass

from ..study_json import StudyKind, about, checked, number, read_study, with_unit

KIND = StudyKind("convergence.json", "orthodyn converge", ("orthodyn_convergence", 1), (("figures", "metrics"),))


@dataclass(frozen=True)
class Mesh:
    """One mesh: values, relative errors, observed orders, estimated mesh errors and CPU times (s), each by metric."""
    index: int
    order: int
    level: int
    unknowns: float
    elements: float
    status: str
    reason: str
    message: str
    values: dict
    errors: dict
    orders: dict
    mesh_errors: dict
    cpu_seconds: dict


@dataclass(frozen=True)
class Metric:
    name: str
    unit: str
    limit: float
    uncertainty: float
    from_order: int
    cost_of_target: dict  # CPU time (s) by element order
    at_most: frozenset  # element orders whose coarsest mesh reaches the target, so that the cost is an upper bound
    answer: str = ""  # a sentence

    @property
    def heading(self):
        return with_unit(self.name, self.unit)

    @property
    def resolution(self):
        """Relative uncertainty of the limit, below which errors are unknown."""
        return abs(self.uncertainty / self.limit) if self.limit else math.nan


@dataclass(frozen=True)
class Study:
    name: str
    metrics: list
    meshes: list
    orders: list
    target: float
    about: dict

    def of_order(self, order):
        return [m for m in self.meshes if m.order == order]

    def known_error(self, metric, mesh):
        """Relative error of a mesh's value: its distance from the limit, but at least the limit's uncertainty; without
        a limit the estimated mesh error; nan if neither is known."""
        error = abs(mesh.errors.get(metric.name, math.nan))
        if not math.isfinite(error):
            return mesh.mesh_errors.get(metric.name, math.nan)
        return max(error, metric.resolution) if math.isfinite(metric.resolution) else error

    @property
    def failed(self):
        return [m for m in self.meshes if m.status == "failed"]


def read_convergence(result):
    return checked(read_study(result, KIND), _study)


def _mesh(index, row):
    of = {key: {name: number(f[key]) for name, f in row["metrics"].items()}
          for key in ("value", "error", "order", "mesh_error", "cpu_seconds")}
    return Mesh(index, row["order"], row["level"], number(row["unknowns"]), number(row["elements"]), row["status"],
                row["reason"], row["message"], *of.values())


def _metric(f):
    return Metric(f["name"], f["unit"], number(f["limit"]), number(f.get("uncertainty")), f.get("from_order", 0),
                  {c["order"]: number(c["cpu_seconds"]) for c in f["cost_of_target"]},
                  frozenset(c["order"] for c in f["cost_of_target"] if c["at_most"]), f.get("answer", ""))


def _study(found):
    return Study(found["name"], [_metric(f) for f in found["metrics"]],
                 [_mesh(k, row) for k, row in enumerate(found["rows"])], found["orders"], found["target"],
                 about(found, ("file", "set", "written", "machine", "versions", "ratio")))
