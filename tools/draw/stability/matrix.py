"""A matrix of hard cases: trials of integrators on cases, in variants of the force."""
from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Case:
    label: str
    file: str
    sentence: str
    model: str  # why the model itself is at fault, or ''


@dataclass(frozen=True)
class Figure:
    """What a trial was judged by; unknown numbers are nan."""
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
    reason: str  # why it is no pass, shortened
    worst: Figure  # or None
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
    limit: float  # seconds of a trial
    complete: bool
    cases: list
    variants: list
    integrators: list
    trials: list
    suspected: list = ()  # sentences on expectations that all integrators miss alike

    @property
    def planned(self):
        return len(self.cases) * len(self.variants) * len(self.integrators)

    @cached_property
    def _fields(self):
        return {(t.variant, t.case, t.integrator): t for t in self.trials}

    def trial(self, variant, case, integrator):
        """The trial, or None where it has not been made yet."""
        return self._fields.get((variant, case, integrator))

    def of(self, variant=None, case=None, integrator=None):
        """Trials of the names given."""
        return [t for t in self.trials if variant in (None, t.variant) and case in (None, t.case)
                and integrator in (None, t.integrator)]

    def case(self, label):
        return next(c for c in self.cases if c.label == label)

    def case_id(self, label):
        """Of its part of the page."""
        return f"case-{next(k for k, c in enumerate(self.cases) if c.label == label)}"
