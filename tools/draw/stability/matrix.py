"""A stability matrix: trials of integrators on hard cases, in variants."""
from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Case:
    label: str
    file: str
    sentence: str
    model: str  # reason why the model itself is at fault, or ''


@dataclass(frozen=True)
class Expectation:
    """An expectation and the value computed by a trial; unknown numbers are nan."""
    title: str
    computed: float
    expected: float
    limit: float
    source: str
    tolerance: str


@dataclass(frozen=True)
class Trial:
    index: int
    case: str
    variant: str
    integrator: str
    folder: str
    grade: str
    reason: str  # why the trial did not pass, shortened
    worst: Expectation  # the expectation that decided the grade, or None
    time_reached: float
    wall: float
    cpu: float
    steps: float

    @property
    def title(self):
        return f"{self.case}, {self.variant}, {self.integrator}"


@dataclass(frozen=True)
class Matrix:
    title: str
    description: str
    file: str
    at: str
    machine: dict
    versions: dict
    limit: float  # time limit of a trial (s)
    complete: bool
    cases: list
    variants: list
    integrators: list
    trials: list
    suspected: list = ()  # sentences about expectations that all integrators miss by about the same amount

    @property
    def planned(self):
        return len(self.cases) * len(self.variants) * len(self.integrators)

    @cached_property
    def _fields(self):
        return {(t.variant, t.case, t.integrator): t for t in self.trials}

    def trial(self, variant, case, integrator):
        """The trial, or None if it has not been run yet."""
        return self._fields.get((variant, case, integrator))

    def of(self, variant=None, case=None, integrator=None):
        """The trials with the given variant, case and integrator; None stands for all."""
        return [t for t in self.trials if variant in (None, t.variant) and case in (None, t.case)
                and integrator in (None, t.integrator)]

    def case(self, label):
        return next(c for c in self.cases if c.label == label)

    def case_id(self, label):
        """HTML id of the section about the case."""
        return f"case-{next(k for k, c in enumerate(self.cases) if c.label == label)}"
