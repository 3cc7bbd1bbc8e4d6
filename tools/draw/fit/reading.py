"""fit.json as a Fit."""
import math

import numpy as np

from ..study_json import StudyKind, read_study
from .model import Attempt, Candidate, Datum, Direction, Field, Fit, Iteration, Noise, Parameter

KIND = StudyKind("fit.json", "orthodyn fit", ("orthodyn_fit", 1))


def read_fit(result):
    return _fit(read_study(result, KIND))


def _some(node, key):
    found = node.children(key)
    if not found:
        raise node.wrong(key, node.value.get(key), "a list with at least one entry")
    return found


def _numbers(node, key, count):
    values = node.series(key)
    if values.shape != (count,):
        raise node.wrong(key, node.value.get(key), f"a list of {count} numbers")
    return [float(v) for v in values]


def _matrix(node, key, count):
    rows = node.list(key)
    if len(rows) != count or not all(isinstance(row, list) and len(row) == count for row in rows):
        raise node.wrong(key, rows, f"a list of {count} lists of {count} numbers")
    try:
        return [[math.nan if v is None else float(v) for v in row] for row in rows]
    except (TypeError, ValueError):
        raise node.wrong(key, rows, "lists of numbers") from None


def _texts(node, key):
    texts = node.list(key)
    if not all(isinstance(text, str) for text in texts):
        raise node.wrong(key, texts, "a list of texts")
    return texts


def _is_true(node, key):
    return node.value.get(key) is True


def _profile(node):
    profile = node.child("profile")
    ends = [profile.child(key) for key in ("low", "high")]
    return [(end.number("value"), _is_true(end, "open")) for end in ends] if profile.value else None


def _parameter(node):
    prior = node.child("prior")
    return Parameter(node.needed("name"), node.text("unit"), _texts(node, "paths"),
                     *map(node.number, ("value", "deviation", "low", "high", "start")), _is_true(node, "relative"),
                     node.text("knowledge"), node.text("precision"), _is_true(node, "at_bound"), prior.number("value"),
                     prior.number("deviation"), node.number("shift"), _profile(node))


def _datum(index, node):
    return Datum(index, node.needed("experiment"), node.text("entry"), node.needed("title"), node.text("unit"),
                 *map(node.number, ("over", "measured", "deviation", "computed", "computed_at_start", "residual", "mode", "mac")))


def _field(node):
    grid = [int(n) for n in _numbers(node, "grid", 3)]
    count = grid[0] * grid[1] * grid[2]
    factors, low, high = (np.array(_numbers(node, key, count)).reshape(grid[::-1]) for key in ("factors", "low", "high"))
    return Field(node.needed("name"), node.text("path"), grid, _numbers(node, "min", 3), _numbers(node, "max", 3),
                 node.number("smoothness"), factors, np.log(high / low) / 2)


def _direction(node, count):
    deviation = node.number("deviation")
    return Direction(deviation if math.isfinite(deviation) else math.inf, _numbers(node, "weights", count))


def _iteration(index, node, count):
    return Iteration(index, int(node.number("number")), node.number("chi_square"), _is_true(node, "accepted"),
                     _numbers(node, "values", count))


def _attempt(node, count, first):
    """An attempt whose iterations have the indices `first`, first + 1, ..."""
    end = _numbers(node, "end", count) if node.list("end") else []
    iterations = [_iteration(first + k, row, count) for k, row in enumerate(node.children("iterations"))]
    return Attempt(_numbers(node, "start", count), node.text("failure"), end, node.number("chi_square"),
                   _is_true(node, "converged"), node.text("message"), node.number("evaluations"),
                   node.number("failed_evaluations"), iterations)


def _attempts(node, count, first):
    found = []
    for row in node.children("attempts"):
        found.append(_attempt(row, count, first))
        first += len(found[-1].iterations)
    return found


def _noise(node):
    numbers = map(node.number, ("probability", "runs_probability", "factor"))
    freedom = node.number("freedom")
    return Noise(node.number("chi_square"), int(freedom) if math.isfinite(freedom) else 0, *numbers)


def _candidate(node, count):
    return Candidate(node.needed("name"), _numbers(node, "deviations", count), node.number("determinant_gain"),
                     node.number("trace_gain"))


def _fit(node):
    fields = [_field(f) for f in node.children("fields")]
    parameters = [_parameter(p) for p in (node.children("parameters") if fields else _some(node, "parameters"))]
    count = len(parameters)
    data = [_datum(k, d) for k, d in enumerate(_some(node, "data"))]
    best = node.number("best")
    return Fit(node.text("title") or node.needed("name"), node.text("description"), node.text("file"),
               node.text("version"), parameters, fields, _matrix(node, "correlation", count),
               [_direction(d, count) for d in node.children("directions")], data, _noise(node.child("noise")),
               _attempts(node, count, len(data)), int(best) if math.isfinite(best) else 0,
               [_candidate(c, count) for c in node.children("candidates")], _texts(node, "findings"),
               _texts(node, "warnings"), [(m.needed("name"), m.needed("yaml")) for m in node.children("materials")],
               node.number("runs"), node.number("cpu_seconds"))
