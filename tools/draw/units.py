"""Numbers for people: SI prefixes, round lengths, times that can be told apart."""
import math

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
PREFIXED = ("m", "m/s", "Pa", "s", "J", "N", "W")


def prefix(unit, largest):
    """(factor, unit) such that `largest` / factor is between 1 and 1000; 1 for units without prefixes."""
    if unit not in PREFIXED or not largest > 0 or not math.isfinite(largest):
        return 1.0, unit
    allowed = [(f, p) for f, p in PREFIXES if not (unit == "s" and f > 1)]
    for factor, letter in allowed:
        if largest >= factor * 0.9999:
            return factor, letter + unit
    return allowed[-1][0], allowed[-1][1] + unit


def round_length(at_most):
    """The largest 1, 2 or 5 times a power of ten that is not above `at_most`."""
    power = 10.0 ** math.floor(math.log10(at_most))
    return next(m * power for m in (5, 2, 1) if m * power <= at_most * 1.000001)


def length_label(length):
    """0.02 -> '20 mm', 0.5 -> '50 cm'."""
    for factor, unit in ((1e3, "km"), (1.0, "m"), (1e-2, "cm"), (1e-3, "mm"), (1e-6, "µm")):
        if length >= factor * 0.9999 and not (unit == "cm" and length < 0.0999):
            return f"{length / factor:.4g} {unit}"
    return f"{length:.3g} m"


def time_labels(times):
    """Labels 't = 12.5 ms', in one unit and with as few digits as show each time well."""
    factor, unit = prefix("s", max(abs(t) for t in times))
    scaled = [float(t / factor) for t in times]
    distinct = sorted(set(scaled))
    if len(distinct) == 1:
        return [f"t = {t:.4g} {unit}" for t in scaled]
    gap = min(b - a for a, b in zip(distinct, distinct[1:]))
    digits = next((d for d in range(9) if all(abs(t - round(t, d)) < 0.02 * gap for t in distinct)), 9)
    return [f"t = {t:.{digits}f} {unit}" for t in scaled]
