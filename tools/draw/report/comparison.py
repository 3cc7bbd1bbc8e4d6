"""A work-precision comparison as typed values; a number that is not known is nan, a text ''.

Errors have keys: displacement.l2, velocity.final, probes.tip.max, phase; see measures.py.
"""
import math
from dataclasses import dataclass, field

import numpy as np

# An error below these multiples of the reference's own, in time and by its mesh, is not resolved.
NEAR_REFERENCE, NEAR_ITS_MESH = 10.0, 2.0
PARTS = ("force", "tangent", "factorization", "solve")


@dataclass
class Control:
    """What a method was asked for: a relative tolerance (rtol) or a step in seconds."""
    kind: str
    value: float


@dataclass
class Spread:
    """Seconds of the repeats of one run."""
    median: float = math.nan
    min: float = math.nan
    max: float = math.nan


@dataclass
class Work:
    count: float = math.nan
    seconds: float = math.nan


@dataclass
class Point:
    """One run of one method at one control."""
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
    work: dict  # of PARTS -> Work
    peak_memory: float
    factor_bytes: float
    errors: dict
    near_reference: set
    drift: dict  # energy, linear_momentum, angular_momentum: largest relative drift
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
    mesh_error: float = math.nan  # an estimate; of a reference with a mesh of its own
    unknowns: float = math.nan
    folder: str = ""  # in that of the comparison
    shared_mesh_error: float = math.nan  # of the mesh that the points have, too: no part of their errors

    @property
    def has_own_mesh(self):
        return math.isfinite(self.mesh_error)

    def reach(self, measure):
        """Errors below it are not resolved; nan where it is not known."""
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
    mesh: str = ""  # what tells it from others that share its reference


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
    """Seconds each method needs to reach the error `target`; nan with the best error where it did not."""
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
class Front:
    """Problems that differ in their meshes only, measured against one reference."""
    id: str
    label: str
    problems: list  # ids
    points: list  # indices of those that no other beats in both error and CPU time, from fast to accurate
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
    fronts: list = field(default_factory=list)

    @property
    def clock(self):
        """The one that is shown first."""
        return "cpu" if self.fronts else "wall"

    def problem(self, name):
        return next(p for p in self.problems if p.id == name)

    def points_of(self, problem, method=None):
        """Points of a problem (and a method), loose control first; methods in their order, those without a finished
        run last."""
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
