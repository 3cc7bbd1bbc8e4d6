"""User-defined models M q'' = f(t, q, v) for the integrators of the library."""
from __future__ import annotations

import numbers
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from .scene import as_yaml

Matrix = Any  # numpy array or scipy.sparse matrix
StateFunction = Callable[[float, np.ndarray, np.ndarray], Any]
EPS = np.finfo(float).eps


@dataclass(frozen=True, repr=False)
class Solution:
    """`t` (k,), `q` and `v` (k, n) at the start and the requested times; `statistics` and `decisions` of the integrator."""
    t: np.ndarray
    q: np.ndarray
    v: np.ndarray
    statistics: dict[str, Any]
    decisions: dict[str, str]

    def __repr__(self) -> str:
        return f"Solution({len(self.t)} times to t = {self.t[-1]:g}, {self.q.shape[1]} coordinates, {self.statistics['steps']} steps)"


class Problem:
    """M q'' = f(t, q, v) with a diagonal mass.

    mass       (n,), all positive
    force      f(t, q, v) -> (n,)
    stiffness  K = -df/dq: a matrix or a function (t, q, v) -> matrix, dense or scipy.sparse. Without it, methods that
               need K and D use difference quotients, each time with 2 n + 1 calls of the force
    damping    D = -df/dv, given like `stiffness` and only together with it
    symmetric  whether K and D are symmetric; then only their lower triangles are read
    linear     whether f(t, q, v) = f(t, 0, 0) - K q - D v with constant K and D
    time_dependent
               whether f depends on t

    A force that raises RecoverableError requests a smaller step. The entries that sparse matrices store at the start,
    including zeros, are the sparsity pattern; later entries outside of the pattern are ignored.
    """

    def __init__(self, mass: Sequence[float], force: StateFunction, stiffness: Matrix | StateFunction | None = None,
                 damping: Matrix | StateFunction | None = None, *, symmetric: bool = False, linear: bool = False,
                 time_dependent: bool = True) -> None:
        self.mass = np.array(mass, float)
        if self.mass.ndim != 1 or not self.mass.size:
            raise ValueError(f"mass: has the shape {self.mass.shape}, expected the diagonal (n,); for another mass matrix M give "
                             "ones as mass and M^-1 f as force")
        if not (self.mass > 0).all():
            raise ValueError("mass: expected positive numbers")
        if not callable(force):
            raise TypeError(f"force: expected a function of (t, q, v), found {force!r}")
        if damping is not None and stiffness is None:
            raise ValueError("damping without stiffness: give both, or neither to use difference quotients")
        self.n, self.force = self.mass.size, force
        self._stiffness, self._damping = (_function(m) for m in (stiffness, damping))
        self._symmetric, self._linear, self._time_dependent = symmetric, linear, time_dependent

    def solve(self, t_span: tuple[float, float], q0: Sequence[float], v0: Sequence[float] | None = None, *,
              integrator: str = "auto", times: Sequence[float] | int = 100, position_scale: float | None = None,
              velocity_scale: float | None = None, **options: Any) -> Solution:
        """The motion from q0, v0 over t_span.

        integrator      a name of `orthodyn list integrators`; `auto` chooses one and reports it in `decisions`. Its options are
                        keyword arguments: rtol=1e-6, step=1e-3, ...
        times           output times, or their number if they are evenly spaced; the end is always included
        position_scale, velocity_scale
                        amplitudes of the motion, to which tolerances are relative; default the largest magnitude in q0
                        and in v0, or if that is 0 an estimate from the other scale
        Raises ConfigError for wrong options, exceptions of the functions, and RunError if the computation fails. The
        RunError's `result` holds what was computed so far.
        """
        start, end = map(float, t_span)
        q, v = np.array(q0, float), np.zeros(self.n) if v0 is None else np.array(v0, float)
        for name, given in (("q0", q), ("v0", v)):
            if given.shape != (self.n,):
                raise ValueError(f"{name}: has the shape {given.shape}, expected ({self.n},), as the mass")
            if not np.isfinite(given).all():
                raise ValueError(f"{name}: has values that are not finite: {given}")
        if not start < end:
            raise ValueError(f"t_span: expected the start before the end, found ({start}, {end})")
        if isinstance(times, numbers.Integral) and times < 1:
            raise ValueError(f"times: {times}, expected at least 1, or ascending times")
        wanted = (np.linspace(start, end, int(times) + 1)[1:] if isinstance(times, numbers.Integral)
                  else np.array(times, float))
        wanted = wanted[wanted > start]
        if not wanted.size or wanted[-1] > end or (np.diff(wanted) <= 0).any():
            raise ValueError("times: expected ascending times within t_span")
        if wanted[-1] < end:
            wanted = np.append(wanted, end)
        known = _core.integrators()
        unsymmetric = self._stiffness is None or not self._symmetric
        if unsymmetric and "linear_solver" in known.get(integrator, ()):
            options.setdefault("linear_solver", "klu")  # the faster solvers need symmetric matrices
        scales = self._scales(start, end, q, v, position_scale, velocity_scale)
        found = self._core(start, q, v, scales).integrate(as_yaml({"type": integrator, **options}), start, q, v,
                                                          wanted.tolist(), *scales)
        solution = Solution(found["t"], found["q"], found["v"], found["statistics"], found["decisions"])
        if found["status"] != "completed":
            error = _core.RunError(found["message"])
            error.result = solution  # type: ignore[attr-defined]
            raise error
        return solution

    def _scales(self, t: float, end: float, q: np.ndarray, v: np.ndarray, position: float | None, velocity: float | None
                ) -> tuple[float, float]:
        found = [given if given is not None else float(np.abs(own).max()) for given, own in ((position, q), (velocity, v))]
        force = _numbers(self.force(t, q.copy(), v.copy()))
        if force.shape != (self.n,):
            raise ValueError(f"the force has the shape {force.shape}, expected ({self.n},)")
        acceleration = float(np.abs(force / self.mass).max())
        if found[0] > 0 and not found[1] > 0:
            found[1] = (acceleration * found[0]) ** 0.5 or found[0]
        if found[1] > 0 and not found[0] > 0:  # distance until the initial force stops the motion, at most v (end - t)
            found[0] = min(found[1] * (end - t), found[1] ** 2 / acceleration if acceleration > 0 else np.inf)
        if not min(found) > 0:
            raise ValueError("position_scale and velocity_scale: cannot be estimated from a start at rest in the origin; give both")
        return found[0], found[1]

    def _core(self, t: float, q: np.ndarray, v: np.ndarray, scales: tuple[float, float]) -> _core.PythonModel:
        import scipy.sparse
        if self._stiffness is None:
            full = scipy.sparse.csc_matrix(np.ones((self.n, self.n)))
            tangent = _differences(self.force, scales)
            return _core.PythonModel(self.mass, self.force, tangent, full.indptr, full.indices, False, True, False,
                                     self._time_dependent)
        first = [self._pattern(name, f(t, q, v)) for name, f in (("stiffness", self._stiffness), ("damping", self._damping))
                 if f is not None]
        pattern = sum(first, scipy.sparse.identity(self.n, format="csc"))
        pattern = (scipy.sparse.tril(pattern) if self._symmetric else pattern).tocsc()
        pattern.sort_indices()
        on_pattern = _PatternValues(pattern)
        stiffness, damping = self._stiffness, self._damping

        def sparse(at: float, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
            return on_pattern(stiffness(at, q, v)), None if damping is None else on_pattern(damping(at, q, v))

        return _core.PythonModel(self.mass, self.force, sparse, pattern.indptr, pattern.indices, self._symmetric,
                                 damping is not None, self._linear, self._time_dependent)

    def _pattern(self, name: str, matrix: Matrix) -> Any:
        """The sparsity pattern of a matrix, with ones as values; full for a dense matrix."""
        import scipy.sparse
        if np.shape(matrix) != (self.n, self.n):
            raise ValueError(f"{name}: has the shape {np.shape(matrix)}, expected ({self.n}, {self.n})")
        if not scipy.sparse.issparse(matrix):
            return scipy.sparse.csc_matrix(np.ones((self.n, self.n)))
        stored = matrix.tocsc().copy()
        stored.data = np.ones(len(stored.data))
        return stored

    def __repr__(self) -> str:
        return f"Problem({self.n} coordinates)"


def _numbers(given: Any) -> np.ndarray:
    try:
        if given is None:
            raise TypeError
        return np.asarray(given, float)
    except (TypeError, ValueError):
        raise TypeError(f"the force is not an array of numbers: {given!r}") from None


class _PatternValues:
    """Extracts the entries of matrices on a sparsity pattern."""

    def __init__(self, pattern: Any) -> None:
        self._row = pattern.indices
        self._column = np.repeat(np.arange(pattern.shape[1]), np.diff(pattern.indptr))

    def __call__(self, matrix: Matrix) -> np.ndarray:
        rows = matrix.tocsr() if hasattr(matrix, "tocsr") else np.asarray(matrix, float)
        return np.asarray(rows[self._row, self._column], float).ravel()


def _function(given: Matrix | StateFunction | None) -> StateFunction | None:
    if given is None or callable(given):
        return given
    return lambda t, q, v: given


def _differences(force: StateFunction, scales: tuple[float, float]) -> StateFunction:
    """The tangent (K, D) by difference quotients, column by column."""
    def tangent(t: float, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        f = np.asarray(force(t, q.copy(), v.copy()), float)
        columns = []
        for x, scale, place in ((q, scales[0], 0), (v, scales[1], 1)):
            matrix = np.empty((len(q), len(q)))
            for j in range(len(q)):
                step = EPS ** 0.5 * max(abs(x[j]), scale)
                moved = [q.copy(), v.copy()]
                moved[place][j] += step
                matrix[j] = (f - np.asarray(force(t, *moved), float)) / step
            columns.append(matrix.ravel())
        return columns[0], columns[1]
    return tangent
