"""The finite element model of a scene, M q'' = f(t, q, v), on its free coordinates q (m)."""
from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from .draw.digits import known_digits

if TYPE_CHECKING:
    from collections.abc import Sequence

    import scipy.sparse


@dataclass(frozen=True, repr=False)
class Modes:
    """Natural modes: `frequencies` (k,), Hz; `shapes` (k, n) on the free coordinates, M-orthonormal; `mesh_errors` (k,), the
    estimated relative excess of each frequency due to the mesh, 0 for rigid modes. By path of the parameter, per its SI unit,
    with NaN where there is no derivative: `frequency_sensitivities` (k,) and `shape_sensitivities` (k, n)."""
    frequencies: np.ndarray
    shapes: np.ndarray
    mesh_errors: np.ndarray
    frequency_sensitivities: dict[str, np.ndarray] = field(default_factory=dict)
    shape_sensitivities: dict[str, np.ndarray] = field(default_factory=dict)

    def __repr__(self) -> str:
        """Frequencies with the digits justified by the mesh errors."""
        frequencies = _listed([known_digits(f, e, 5) for f, e in zip(self.frequencies, self.mesh_errors)])
        errors = _listed([known_digits(100 * e, 1.0) if e else "0" for e in self.mesh_errors])
        return f"Modes({frequencies} Hz, mesh errors {errors} %)"


def _listed(words: list[str]) -> str:
    """All words, or the first and last three if there are many."""
    shown = words if len(words) <= MOST_LISTED else [*words[:3], "...", *words[-3:]]
    return f"[{' '.join(shown)}]"


class Model:
    """Functions of time t (s), displacements q (m) and velocities v (m/s) of the n free coordinates. The model keeps no
    state. It computes forces, tangents, modes and equilibria without holding the interpreter's lock."""

    def __init__(self, core: _core.SceneModel) -> None:
        self._core = core
        self._column_start, self._row, self._symmetric = core.pattern()

    @property
    def n(self) -> int:
        """The number of free coordinates."""
        return self._core.n

    @property
    def initial(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Initial t, q, v of the scene."""
        return self._core.t0, self._core.q0, self._core.v0

    @property
    def points(self) -> np.ndarray:
        """Rest positions (nodes, 3), m."""
        return self._core.points()

    @property
    def unknowns(self) -> np.ndarray:
        """(nodes, 3): the number of each coordinate among the free ones, -1 if it is prescribed."""
        return self._core.unknowns()

    def nodal(self, q: np.ndarray) -> np.ndarray:
        """Free coordinates as an array (nodes, 3), with zeros for prescribed coordinates."""
        unknowns = self.unknowns
        return np.where(unknowns >= 0, self._checked(q, "q")[np.maximum(unknowns, 0)], 0.0)

    def force(self, t: float, q: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
        """f(t, q, v), N. Raises RecoverableError if f cannot be evaluated at this state. Viscoelastic materials are at
        equilibrium (relaxed), here and in all other functions of the model."""
        return self._core.force(t, self._checked(q, "q"), self._velocity(v))

    def tangent(self, t: float, q: np.ndarray, v: np.ndarray | None = None, *, gauss_newton: bool = False
                ) -> tuple[scipy.sparse.csc_matrix, scipy.sparse.csc_matrix | None]:
        """K = -df/dq (N/m) and D = -df/dv (N s/m); D is None without damping. `gauss_newton`: only the positive
        semidefinite part of K."""
        stiffness, damping = self._core.tangent(t, self._checked(q, "q"), self._velocity(v), gauss_newton)
        return self._matrix(stiffness), self._matrix(damping) if damping.size else None

    @property
    def mass(self) -> scipy.sparse.csc_matrix:
        """M, kg."""
        return self._matrix(self._core.mass())

    def solve_mass(self, x: np.ndarray) -> np.ndarray:
        """M^-1 x."""
        return self._core.solve_mass(self._checked(x, "x"))

    def acceleration(self, t: float, q: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
        """M^-1 f, m/s^2."""
        return self._core.solve_mass(self.force(t, q, v))

    def modes(self, count: int, *, about_equilibrium: bool = False, sensitivities: Sequence[str] = (),
              shape_sensitivities: bool = False) -> Modes:
        """The lowest `count` natural modes including rigid ones, about the rest shape or about the static equilibrium.
        `sensitivities`: paths of numbers of the scene ("materials.wood.young.0") for derivatives of the frequencies about the
        rest shape and, with `shape_sensitivities`, of the shapes. Shapes of equal frequencies and rigid ones have none."""
        if count < 1:
            raise ValueError(f"count: {count}, expected at least 1")
        paths = [sensitivities] if isinstance(sensitivities, str) else list(sensitivities)
        if about_equilibrium and paths:
            raise ValueError("sensitivities: available for modes about rest only, without about_equilibrium")
        if shape_sensitivities and not paths:
            raise ValueError("shape_sensitivities: need a number of the scene, sensitivities=[path]")
        *found, frequencies, shapes = self._core.modes(count, about_equilibrium, paths, shape_sensitivities)
        return Modes(*found, dict(zip(paths, frequencies)), dict(zip(paths, shapes)))

    def gradient(self, quantity: str, by: str | Sequence[str], at: float | None = None) -> tuple[float, dict[str, float]]:
        """A probe's displacement or velocity component ("tip.displacement.z") at full load or at the time `at` (s; default the
        end), and its derivatives with respect to numbers of the scene, by path, per SI unit. They are computed by adjoint
        equations, whose cost hardly depends on the number of parameters; the path of a region's `stiffness_factors` stands for
        all of them. Raises ConfigError for scenes, quantities and numbers without such derivatives."""
        value, names, derivatives = self._core.gradient(quantity, at, [by] if isinstance(by, str) else list(by))
        return value, dict(zip(names, derivatives.tolist()))

    def equilibrium(self) -> np.ndarray:
        """Static q under the loads at the end of the scene's time. Raises ConfigError for an unsupported body, RunError if no
        equilibrium is found."""
        return self._core.equilibrium()

    @property
    def outputs(self) -> dict[str, str]:
        """Names and descriptions of all outputs for `evaluate`."""
        return {name: f"{sentence} [{unit}]" for name, _, _, unit, sentence in self._core.outputs()}

    @property
    def fields(self) -> list[str]:
        """Names of the outputs at nodes or elements."""
        return [name for name, place, *_ in self._core.outputs() if place != GLOBAL]

    def evaluate(self, name: str, t: float, q: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
        """An output at a state: (nodes or elements, components), or (components,) for the whole body."""
        known = {output: (place, components) for output, place, components, _, _ in self._core.outputs()}
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise KeyError(f"no output '{name}'; " + (f"did you mean '{near[0]}'? " if near else "") + f"There are {', '.join(known)}")
        place, components = known[name]
        values = self._core.evaluate(name, t, self._checked(q, "q"), self._velocity(v))
        return values if place == GLOBAL else values.reshape(-1, components)

    def _velocity(self, v: np.ndarray | None) -> np.ndarray:
        return np.zeros(self.n) if v is None else self._checked(v, "v")

    def _checked(self, x: np.ndarray, name: str) -> np.ndarray:
        """`x` as a vector of the free coordinates; raises ValueError or TypeError if it is not one."""
        array = np.asarray(x)
        if array.shape != (self.n,):
            raise ValueError(f"{name}: has the shape {array.shape}, expected ({self.n},): one number per free coordinate, "
                             "numbered as in Model.unknowns")
        if array.dtype.kind not in "fiu":
            raise TypeError(f"{name}: expected real numbers, found {array.dtype}")
        return array.astype(float, copy=False)

    def __repr__(self) -> str:
        return f"Model({self.n} free coordinates, {len(self.points)} nodes)"

    def _matrix(self, values: np.ndarray) -> scipy.sparse.csc_matrix:
        import scipy.sparse
        lower = scipy.sparse.csc_matrix((values, self._row, self._column_start), shape=(self.n, self.n))
        if not self._symmetric:
            return lower
        return (lower + scipy.sparse.tril(lower, -1).T).tocsc()


GLOBAL = 2  # Location::global in lib/ode/output.h
MOST_LISTED = 20
