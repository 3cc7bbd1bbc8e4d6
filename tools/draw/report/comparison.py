"""A work-precision comparison as typed values; unknown numbers are nan, unknown texts ''.

Errors have keys: displacement.l2, velocity.final, probes.tip.max, phase; see measures.py.
"""
import math
from dataclasses import dataclass, field

import numpy as np

# Errors below these multiples of the reference's own time and mesh errors are not resolved.
NEAR_REFERENCE, NEAR_ITS_MESH = 10.0, 2.0
PARTS = ("force", "tangent", "factorization", "solve")


@dataclass
class Control:
    """What controls the error of a run: relative tolerance (rtol), step (s), or fraction of the critical step
    (safety)."""
    kind: str
    value: float


@dataclass
class Spread:
    """Times (s) of the repeats of one run."""
    median: float = math.nan
    min: float = math.nan
    max: float = math.nan


@dataclass
class Work:
    count: float = math.nan
    seconds: float = math.nan


@dataclass
class Point:
    """The run of a method with one value of its control."""
    index: int
    problem: str
    method: str
    control: Control
    status: str
    reason: str
    message: str
    time_reached: float
    repeats: float
    clocks: dict  # "wall", "cpu" -> Spread
    counts: dict  # steps, rejected_steps, newton_iterations, ...
    work: dict  # names in PARTS -> Work
    peak_memory: float
    factor_bytes: float
    errors: dict
    near_reference: set
    drift: dict  # largest relative drift of energy, linear_momentum, angular_momentum
    drift_times: np.ndarray
    drift_energy: np.ndarray
    smallest_det_f: float
    decisions: dict
    scene: str

    @property
    def completed(self):
        return self.status == "completed"

    def error(self, measure):
        return self.errors.get(measure, math.nan)

    def seconds(self, clock="wall"):
        return self.clocks[clock].median


@dataclass
class Reference:
    kind: str = "none"
    method: str = ""
    check: str = ""
    seconds: float = math.nan
    message: str = ""
    errors: dict = field(default_factory=dict)
    mesh_error: float = math.nan  # estimated; nan unless the reference has its own mesh
    unknowns: float = math.nan
    folder: str = ""  # of the reference's run, in the comparison's folder
    shared_mesh_error: float = math.nan  # of a mesh that the points share, so that their errors do not contain it

    @property
    def has_own_mesh(self):
        return math.isfinite(self.mesh_error)

    def reach(self, measure):
        """Smallest resolved error; nan if unknown."""
        own_mesh = NEAR_ITS_MESH * self.mesh_error if self.has_own_mesh else 0.0
        return NEAR_REFERENCE * self.errors.get(measure, math.nan) + own_mesh


@dataclass
class Problem:
    id: str
    label: str
    scene: str
    set: dict
    sentence: str
    unknowns: float
    elements: float
    nodes: float
    start: float
    end: float
    scales: dict
    scale_words: str
    probe_scales: dict
    quantity_scales: dict
    dominant_frequency: float
    reference: Reference
    mesh: str = ""  # name of the mesh, distinct among problems with one reference


@dataclass
class Method:
    id: str
    label: str
    integrator: str
    sentence: str
    set: dict
    control: str


@dataclass
class Answer:
    """Time (s) of each method to reach the error `target`. For a method that does not reach it: nan, and its best
    error."""
    problem: str
    error: str
    target: float
    seconds: dict
    best_error: dict


@dataclass
class Order:
    problem: str
    method: str
    error: str
    slope: float


@dataclass
class ParetoFront:
    """The Pareto front of problems that differ only in the mesh and share a reference."""
    id: str
    label: str
    problems: list  # their ids
    points: list  # indices of Pareto-optimal points (error, CPU time), fastest first
    answers: list  # (target, index of the fastest point that reaches it, in words)


@dataclass
class Comparison:
    name: str
    title: str
    description: str
    file: str
    started: str
    complete: bool
    planned: float
    machine: dict
    versions: dict
    settings: dict
    problems: list
    methods: list
    points: list
    answers: list
    orders: list
    pareto_fronts: list = field(default_factory=list)

    @property
    def clock(self):
        """The clock shown first: "wall" or "cpu"."""
        return "cpu" if self.pareto_fronts else "wall"

    def problem(self, name):
        return next(p for p in self.problems if p.id == name)

    def points_of(self, problem, method=None):
        """The points of a problem, or of a problem and a method: method by method, each from loose to tight control.
        Methods without a finished run come last."""
        rank = {m.id: k for k, m in enumerate(self.methods)}
        found = [p for p in self.points if p.problem == problem.id and method in (None, p.method)]
        ended = {p.method for p in found if p.completed}
        return sorted(found, key=lambda p: (p.method not in ended, rank[p.method], p.control.kind,
                                            -np.nan_to_num(p.control.value)))

    def finished(self, problem, method=None):
        return [p for p in self.points_of(problem, method) if p.completed]

    def failed(self, problem, method=None):
        return [p for p in self.points_of(problem, method) if not p.completed]

    def method_index(self, name):
        return next(k for k, m in enumerate(self.methods) if m.id == name)

    def slope(self, problem, method, measure):
        return next((o.slope for o in self.orders
                     if (o.problem, o.method, o.error) == (problem.id, method, measure)), math.nan)

    def is_near_reference(self, point, measure):
        return (measure in point.near_reference
                or point.error(measure) < self.problem(point.problem).reference.reach(measure))
