"""A fit: parameters with their intervals, data with residuals, attempts of the search, and candidates.

Values are in units of display; unknown and infinite numbers are nan.
"""
import math
from dataclasses import dataclass
from functools import cached_property

WIDE_RATIO = 100  # upper over lower end of an interval, from which it is called unknown
UNDETERMINED = "undetermined"


@dataclass(frozen=True)
class Parameter:
    name: str
    unit: str
    paths: list
    value: float
    deviation: float
    low: float  # of the 95 % interval
    high: float
    start: float
    relative: bool  # whether the search uses its logarithm
    knowledge: str
    precision: str  # half of the 95 % interval in words: "±0.8 %"
    at_bound: bool
    prior: float
    prior_deviation: float
    shift: float  # by one refinement of the meshes
    profile: list = None  # (value, whether chi-square stays low up to the bound) of both ends of the profile interval

    @property
    def half_width(self):
        """Half of the 95 % interval; nan if it is unknown or too wide to mean anything."""
        if not all(map(math.isfinite, (self.low, self.high, self.deviation))):
            return math.nan
        if self.relative:
            too_wide = not self.low > 0 or self.high / self.low > WIDE_RATIO
        else:
            too_wide = self.knowledge == UNDETERMINED
        return math.nan if too_wide else (self.high - self.low) / 2


@dataclass(frozen=True)
class Datum:
    index: int
    experiment: str
    entry: int
    title: str
    unit: str
    over: float  # time (s) or frequency (Hz) in a table
    measured: float
    deviation: float
    computed: float
    at_start: float
    residual: float  # (computed - measured) / deviation
    mode: float  # number of the computed mode of a frequency
    mac: float  # modal assurance criterion of the measured and the computed shape


@dataclass(frozen=True)
class Field:
    """Stiffness factors on a grid; arrays by layer along z, then y, then x."""
    name: str
    path: str
    grid: list  # cells along x, y, z
    low_corner: list  # of the region, m
    high_corner: list
    smoothness: float
    factors: object
    half_widths: object  # of the 95 % intervals, as fractions of the factors


@dataclass(frozen=True)
class Direction:
    """A combination of the search's coordinates; its deviation is infinite if the data say nothing about it."""
    deviation: float
    weights: list


@dataclass(frozen=True)
class Iteration:
    index: int  # of its tooltip
    number: int
    chi_square: float
    accepted: bool
    values: list


@dataclass(frozen=True)
class Attempt:
    start: list
    failure: str
    end: list  # empty if it failed
    chi_square: float
    converged: bool
    message: str
    evaluations: float
    failed_evaluations: float
    iterations: list


@dataclass(frozen=True)
class Candidate:
    name: str
    deviations: list  # of the parameters after it
    determinant_gain: float
    trace_gain: float


@dataclass(frozen=True)
class Noise:
    chi_square: float
    freedom: int
    probability: float
    runs_probability: float
    factor: float


@dataclass(frozen=True)
class Series:
    """Data of a table over time or frequency."""
    experiment: str
    entry: int
    data: list

    @property
    def is_over_frequency(self):
        return self.data[0].title.endswith(" Hz")

    @property
    def quantity(self):
        return self.data[0].title.rsplit(" at ", 1)[0]


@dataclass(frozen=True)
class Fit:
    title: str
    description: str
    file: str
    version: str
    parameters: list
    fields: list
    correlation: list  # rows
    directions: list
    data: list
    noise: Noise
    attempts: list
    best: int
    candidates: list
    findings: list
    warnings: list
    materials: list  # (name, YAML)
    runs: float
    cpu_seconds: float

    @cached_property
    def series(self):
        groups = {}
        for datum in self.data:
            if math.isfinite(datum.over):
                groups.setdefault((datum.experiment, datum.entry), []).append(datum)
        return [Series(*key, sorted(found, key=lambda d: d.over)) for key, found in groups.items()]

    @cached_property
    def single(self):
        """{experiment: data that are not in a table}."""
        groups = {}
        for datum in self.data:
            if not math.isfinite(datum.over):
                groups.setdefault(datum.experiment, []).append(datum)
        return groups
