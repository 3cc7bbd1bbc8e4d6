"""Ranking of integrators, hardest cases, and trials that pass in one variant only."""
from dataclasses import dataclass

from .grades import GRADES

HARDLY = 0.2  # in a hard case at most this share of the integrators passes


@dataclass(frozen=True)
class Tally:
    """The numbers of trials with each grade, and their CPU time (s)."""
    counts: dict
    cpu: float

    @property
    def tried(self):
        return sum(self.counts.values())

    def __getitem__(self, grade):
        return self.counts[grade]

    @property
    def merit(self):
        """Key for sorting, larger is better: many passes, then few fails, then many degraded trials, then little CPU
        time. Refusals do not count, except that an integrator that refuses everything comes last."""
        refuses_all = self.tried > 0 and self["refused"] == self.tried
        return not refuses_all, self["pass"], -self["fail"], self["degraded"], -self.cpu


def tally(trials):
    counts = {grade: sum(t.grade == grade for t in trials) for grade in GRADES}
    return Tally(counts, sum(t.cpu for t in trials if t.cpu == t.cpu))


def ranked(matrix, variant=None):
    """[(integrator, Tally)] of all integrators, the best first."""
    found = [(name, tally(matrix.of(variant, integrator=name))) for name in matrix.integrators]
    return sorted(found, key=lambda entry: entry[1].merit, reverse=True)


def hard_cases(matrix, variant):
    """[(case, Tally)] of the cases that hardly any integrator passes, the hardest first."""
    found = [(case, tally(matrix.of(variant, case.label))) for case in matrix.cases]
    hard = [(case, t) for case, t in found if t.tried and t["pass"] <= HARDLY * t.tried]
    return sorted(hard, key=lambda entry: entry[1]["pass"] / entry[1].tried)


def lost(matrix, variant, first):
    """The trials that pass with the variant `first` but not with `variant`."""
    before = [t for t in matrix.of(first) if t.grade == "pass"]
    now = (matrix.trial(variant, t.case, t.integrator) for t in before)
    return [t for t in now if t and t.grade != "pass"]
