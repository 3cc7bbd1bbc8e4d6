"""The target error at which methods are compared, and the run that represents each method."""
import math

from . import measures

USUAL = 1e-3
AS_GOOD = 1.05  # an error up to 5 % above the target reaches it, as in the program (kTargetTolerance)


def _distance(target):
    return abs(math.log10(target / USUAL))


def main_target(comparison):
    """The main target error: the target nearest to 1e-3 that at least half of the methods reach, or failing that the
    one that most methods reach. None without answers."""
    primary, reached, asked = measures.primary(comparison), {}, {}
    for answer in comparison.answers:
        if answer.error == primary and answer.target > 0:
            found = [math.isfinite(s) for s in answer.seconds.values()]
            reached[answer.target] = reached.get(answer.target, 0) + sum(found)
            asked[answer.target] = asked.get(answer.target, 0) + len(found)
    if not reached:
        return None
    good = [t for t in reached if 2 * reached[t] >= asked[t]] or [t for t in reached
                                                                  if reached[t] == max(reached.values())]
    return min(good, key=_distance)


def _smallest_reachable(comparison, problem, measure):
    """Target without answers: 1e-3, or the smallest larger power of ten that every method with a finished run
    reaches."""
    best = [min((p.error(measure) for p in comparison.finished(problem, m.id) if math.isfinite(p.error(measure))),
                default=math.nan) for m in comparison.methods]
    best = [b for b in best if b > 0]
    return max(USUAL, 10.0 ** math.ceil(math.log10(max(best)))) if best else USUAL


def target_of(comparison, problem):
    return main_target(comparison) or _smallest_reachable(comparison, problem, measures.primary(comparison))


def representatives(comparison, problem):
    """(point, reached) for each method with a finished run: its cheapest run that reaches the target, else its most
    accurate run. Methods that reach the target come first, and within both groups the fastest."""
    measure, target, found = measures.primary(comparison), target_of(comparison, problem), []
    for method in comparison.methods:
        runs = [p for p in comparison.finished(problem, method.id) if math.isfinite(p.seconds())]
        below = [p for p in runs if p.error(measure) <= AS_GOOD * target]
        measured = [p for p in runs if math.isfinite(p.error(measure))]
        if below:
            found.append((min(below, key=lambda p: p.seconds()), True))
        elif runs:
            found.append((min(measured or runs, key=lambda p: p.error(measure)), False))
    return sorted(found, key=lambda pair: (not pair[1], pair[0].seconds()))
