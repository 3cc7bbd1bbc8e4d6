"""convergence.json -> Study; what is wrong in the file becomes one line."""
import json
import math
from dataclasses import dataclass

from ..errors import DrawError
from ..series import result_folder
from . import FILE

FORMAT = 1


def _number(x):
    return math.nan if x is None else float(x)


@dataclass(frozen=True)
class Mesh:
    """A row: one mesh. Values, errors, observed orders, estimates of the error and CPU seconds by figure."""
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
class Figure:
    name: str
    unit: str
    limit: float
    uncertainty: float
    from_order: int
    cost_of_target: dict  # CPU seconds by order of the elements
    at_most: frozenset    # of these the orders whose coarsest mesh is good enough already
    answer: str = ""      # in a sentence

    @property
    def heading(self):
        return f"{self.name} [{self.unit}]" if self.unit else self.name

    @property
    def resolution(self):
        """Errors below it are those of the limit itself."""
        return abs(self.uncertainty / self.limit) if self.limit else math.nan


@dataclass(frozen=True)
class Study:
    name: str
    figures: list
    meshes: list
    orders: list
    target: float
    about: dict

    def of_order(self, order):
        return [m for m in self.meshes if m.order == order]

    def known_error(self, figure, mesh):
        """The share by which a mesh's value is off its limit, and the limit itself; where there is none, as the mesh estimates
        it; nan where nothing is known."""
        error = abs(mesh.errors.get(figure.name, math.nan))
        if not math.isfinite(error):
            return mesh.mesh_errors.get(figure.name, math.nan)
        return max(error, figure.resolution) if math.isfinite(figure.resolution) else error

    @property
    def failed(self):
        return [m for m in self.meshes if m.status == "failed"]


def read_convergence(result):
    path = result_folder(result) / FILE
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise DrawError(f"{path}: missing; `orthodyn converge SCENE.yaml` writes it") from None
    except json.JSONDecodeError as error:
        raise DrawError(f"{path}: not readable as JSON (line {error.lineno}); is it cut off?") from None
    if not isinstance(found, dict) or found.get("orthodyn_convergence") != FORMAT:
        raise DrawError(f"{path}: no convergence study of format {FORMAT}")
    try:
        return _study(found)
    except (KeyError, TypeError, AttributeError) as error:
        raise DrawError(f"{path}: {error} is missing or no such thing; `orthodyn converge` writes the file anew") from None


def _mesh(index, row):
    of = {key: {name: _number(f[key]) for name, f in row["figures"].items()} 
          for key in ("value", "error", "order", "mesh_error", "cpu_seconds")}
    return Mesh(index, row["order"], row["level"], _number(row["unknowns"]), _number(row["elements"]), row["status"],
                row["reason"], row["message"], *of.values())


def _figure(f):
    return Figure(f["name"], f["unit"], _number(f["limit"]), _number(f.get("uncertainty")), f.get("from_order", 0),
                  {c["order"]: _number(c["cpu_seconds"]) for c in f["cost_of_target"]},
                  frozenset(c["order"] for c in f["cost_of_target"] if c["at_most"]), f.get("answer", ""))


def _study(found):
    return Study(found["name"], [_figure(f) for f in found["figures"]],
                 [_mesh(k, row) for k, row in enumerate(found["rows"])], found["orders"], found["target"],
                 {"ranks": found.get("ranks", 1),
                  **{key: found[key] for key in ("file", "set", "written", "machine", "versions", "ratio")}})
