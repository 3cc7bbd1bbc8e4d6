"""What to measure next: the value of the candidates."""
import math

from ..report.markup import joined, tag
from ..report.tables import number, table
from . import numbers
from .model import UNDETERMINED

READ = ("The columns of the parameters say by which factor the standard deviation shrinks if the candidate is measured, too; "
        "for a parameter that the data do not determine, its new standard deviation. Largest gains first, the best of each "
        "column in bold. D-gain: factor by which the volume of the confidence region shrinks. A-gain: factor by which the "
        "sum of the variances shrinks.")
NOTHING = 0.9  # new relative deviation, from which a candidate tells nothing about an undetermined parameter


def shrinkage(parameter, after):
    """The factor by which the candidate shrinks the standard deviation; nan if the parameter is undetermined."""
    if parameter.knowledge == UNDETERMINED or not after > 0:
        return math.nan
    return parameter.deviation / after


def _cell(parameter, after):
    factor = shrinkage(parameter, after)
    if math.isfinite(factor):
        return numbers.times(factor)
    if not math.isfinite(after) or parameter.relative and after > NOTHING * abs(parameter.value):
        return "still unknown"
    return f"± {numbers.with_unit(numbers.brief(after, 2), parameter.unit)}"


def _score(parameter, after):
    """Larger is better."""
    factor = shrinkage(parameter, after)
    return factor if math.isfinite(factor) else -after if math.isfinite(after) else -math.inf


def _columns(fit, candidates):
    """[(heading, texts, scores)], one entry per column."""
    found = [(p.name, [_cell(p, c.deviations[k]) for c in candidates], [_score(p, c.deviations[k]) for c in candidates])
             for k, p in enumerate(fit.parameters)]
    for heading, key in (("D-gain", "determinant_gain"), ("A-gain", "trace_gain")):
        gains = [getattr(c, key) for c in candidates]
        found.append((heading, [numbers.times(g) for g in gains], [g if math.isfinite(g) else -math.inf for g in gains]))
    return found


def _bold(text, texts, scores):
    """The text, in bold if it is the best of the column and others differ."""
    best = texts[scores.index(max(scores))]
    return tag("strong", text) if text == best and set(texts) != {best} else text


def candidates_section(fit):
    def gain(candidate):
        return candidate.determinant_gain if math.isfinite(candidate.determinant_gain) else -math.inf
    candidates = sorted(fit.candidates, key=gain, reverse=True)
    columns = _columns(fit, candidates)
    rows = []
    for k, candidate in enumerate(candidates):
        cells = [number(_bold(texts[k], texts, scores)) for _, texts, scores in columns]
        name = tag("strong", candidate.name) if k == 0 else candidate.name
        rows.append(tag("tr", tag("th", name, scope="row"), *cells, class_="best" if k == 0 else None))
    head = [("Candidate", False), *((heading, True) for heading, *_ in columns)]
    return joined([tag("p", READ), table("Candidates, the most informative first", head, rows, "Candidates", "named")])
