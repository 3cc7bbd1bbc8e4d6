"""How far the mesh puts the figures of a sweep off, in words: of frequencies and load factors, which have errors of their own."""
import math

from ..digits import known_digits
from ..report.formatting import THIN

NONE = 1e-6  # shares below it are none


def percent(share):
    """Two digits, never an exponent where it can be helped: 0.2514 -> '25', 1.5 -> '150'."""
    return known_digits(100 * share, 1.0)


def off(error):
    """'25 % too high'; '' where that is not known or nothing."""
    if not abs(error) > NONE:
        return ""
    return f"{percent(abs(error))}{THIN}% too {'high' if error > 0 else 'low'}"


def off_at(figure, points):
    """'18 to 25 % too high' over all points, '2 % too low to 25 % too high'; '' where it is not known of any."""
    errors = [e for p in points if abs(e := figure.mesh_error(p)) > NONE]
    if not errors:
        return ""
    low, high = min(errors), max(errors)
    if low < 0 < high:
        return f"{off(low)} to {off(high)}"
    least, most = sorted((low, high), key=abs)
    return off(most) if percent(least) == percent(most) else f"{percent(abs(least))} to {off(most)}"


def worst(figures, points):
    """(error, figure, point) of the largest error; None where none is known."""
    found = [(figure.mesh_error(p), figure, p) for figure in figures for p in points]
    found = [entry for entry in found if math.isfinite(entry[0])]
    return max(found, key=lambda entry: abs(entry[0]), default=None)
