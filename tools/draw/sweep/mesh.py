"""Mesh errors of a sweep's metrics, in words. Only natural frequencies have their own error estimates."""
import math

from ..digits import known_digits
from ..report.formatting import THIN

NONE = 1e-6  # a smaller error counts as none


def percent(share):
    """A fraction in per cent, with two digits and if possible without an exponent: 0.2514 -> '25', 1.5 -> '150'."""
    return known_digits(100 * share, 1.0)


def off(error):
    """'25 % too high'; '' if unknown or negligible."""
    if not abs(error) > NONE:
        return ""
    return f"{percent(abs(error))}{THIN}% too {'high' if error > 0 else 'low'}"


def off_at(metric, points):
    """The range of errors over all points: '18 to 25 % too high', '2 % too low to 25 % too high'; '' if all are
    unknown."""
    errors = [e for p in points if abs(e := metric.mesh_error(p)) > NONE]
    if not errors:
        return ""
    low, high = min(errors), max(errors)
    if low < 0 < high:
        return f"{off(low)} to {off(high)}"
    least, most = sorted((low, high), key=abs)
    return off(most) if percent(least) == percent(most) else f"{percent(abs(least))} to {off(most)}"


def worst(metrics, points):
    """(error, metric, point) of the largest error; None if no error is known."""
    found = [(metric.mesh_error(p), metric, p) for metric in metrics for p in points]
    found = [entry for entry in found if math.isfinite(entry[0])]
    return max(found, key=lambda entry: abs(entry[0]), default=None)
