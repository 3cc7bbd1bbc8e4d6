"""The finite element model of a scene, M q'' = f(t, q, v), on its free coordinates q (m)."""
from __future__ import annotations

import difflib
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from .draw.digits import known_digits

if TYPE_CHECKING:
    import scipy.sparse


@dataclass(frozen=True, repr=False)
class Modes:
    """Natural modes: `frequencies` (k,), Hz; `shapes` (k, n) on the free coordinates, M-orthonormal; `mesh_errors` (k,), the
    share by which the mesh makes each frequency too high, estimated; 0 of rigid modes."""
    frequencies: np.ndarray
    shapes: np.ndarray
    mesh_errors: np.ndarray

    def __repr__(self) -> str:
        """Frequencies with the digits that the mesh lets be known."""
        frequencies = _listed([known_digits(f, e, 5) for f, e in zip(self.frequencies, self.mesh_errors)])
        errors = _listed([known_digits(100 * e, 1.0) if e else "0" for e in self.mesh_errors])
        return f"Modes({frequencies} Hz, by the mesh too high by {errors} %)"


def _listed(words: list[str]) -> str:
    """Of many the first and the last three."""
    shown = words if len(words) <= MOST_LISTED else [*words[:3], "...", *words[-3:]]
    return f"[{' '.join(shown)}]"


class Model:
    """Functions of time t (s), positions q (m) and velocities v (m/s) of the n free coordinates. They hold no state; forces,
    tangents, modes and equilibria let other threads run."""

    def __init__(self, core: _core.SceneModel) -> None:
        self._core = core
        self._column_start, self._row, self._symmetric = core.pattern()

    @property
    def n(self) -> int:
        """The number of free coordinates."""
        return self._core.n

    @property
    def initial(self) -> tuple[float, np.ndarray, np.ndarray]:
        """t, q, v at which the scene begins."""
        return self._core.t0, self._core.q0, self._core.v0

    @property
    def points(self) -> np.ndarray:
        """(nodes, 3), m: the rest shape."""
        return self._core.points()

    @property
    def unknowns(self) -> np.ndarray:
        """(nodes, 3): of each coordinate its number among the free ones, -1 where it is clamped or moved."""
        return self._core.unknowns()

    def nodal(self, q: np.ndarray) -> np.ndarray:
        """(nodes, 3) of free coordinates; zero where they are held."""
        unknowns = self.unknowns
        return np.where(unknowns >= 0, self._own(q, "q")[np.maximum(unknowns, 0)], 0.0)

    def force(self, t: float, q: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
        """f(t, q, v), N. Raises RecoverableError where it cannot be evaluated."""
        return self._core.force(t, self._own(q, "q"), self._still(v))

    def tangent(self, t: float, q: np.ndarray, v: np.ndarray | None = None, *, gauss_newton: bool = False
                ) -> tuple[scipy.sparse.csc_matrix, scipy.sparse.csc_matrix | None]:
        """K = -df/dq (N/m) and D = -df/dv (N s/m), or None without damping. `gauss_newton`: the positive semidefinite
        part."""
        stiffness, damping = self._core.tangent(t, self._own(q, "q"), self._still(v), gauss_newton)
        return self._matrix(stiffness), self._matrix(damping) if damping.size else None

    @property
    def mass(self) -> scipy.sparse.csc_matrix:
        """M, kg."""
        return self._matrix(self._core.mass())

    def solve_mass(self, x: np.ndarray) -> np.ndarray:
        """M^-1 x."""
        return self._core.solve_mass(self._own(x, "x"))

    def acceleration(self, t: float, q: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
        """M^-1 f, m/s^2."""
        return self._core.solve_mass(self.force(t, q, v))

    def modes(self, count: int, *, about_equilibrium: bool = False) -> Modes:
        """The lowest `count` natural modes, rigid ones included, about rest or about the equilibrium under the loads."""
        if count < 1:
            raise ValueError(f"count: {count}, expected at least 1")
        return Modes(*self._core.modes(count, about_equilibrium))

    def equilibrium(self) -> np.ndarray:
        """q at rest under all loads as they are at the end of the scene's time. Raises ConfigError for a body that is not
        held, RunError where none is found."""
        return self._core.equilibrium()

    @property
    def outputs(self) -> dict[str, str]:
        """What `evaluate` knows: names, and what they are."""
        return {name: f"{sentence} [{unit}]" for name, _, _, unit, sentence in self._core.outputs()}

    @property
    def fields(self) -> list[str]:
        """The outputs that have values at nodes or elements."""
        return [name for name, place, *_ in self._core.outputs() if place != GLOBAL]

    def evaluate(self, name: str, t: float, q: np.ndarray, v: np.ndarray | None = None) -> np.ndarray:
        """An output at a state: (nodes or elements, components), or (components,) of one for the whole body."""
        known = {output: (place, components) for output, place, components, _, _ in self._core.outputs()}
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise KeyError(f"no output '{name}'; " + (f"did you mean '{near[0]}'? " if near else "") + f"There are {', '.join(known)}")
        place, components = known[name]
        values = self._core.evaluate(name, t, self._own(q, "q"), self._still(v))
        return values if place == GLOBAL else values.reshape(-1, components)

    def _still(self, v: np.ndarray | None) -> np.ndarray:
        return np.zeros(self.n) if v is None else self._own(v, "v")

    def _own(self, x: np.ndarray, name: str) -> np.ndarray:
        """A vector of the free coordinates, or a word on what it should be."""
        array = np.asarray(x)
        if array.shape != (self.n,):
            raise ValueError(f"{name}: has the shape {array.shape}, expected ({self.n},): one number for each free coordinate, "
                             "as Model.unknowns numbers them")
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


GLOBAL = 2  # as lib/ode/output.h has it
MOST_LISTED = 20
