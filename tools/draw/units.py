"""Number formatting: SI prefixes, round lengths, distinct time labels."""
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
    """The largest number of the form 1, 2 or 5 times a power of ten that is not above `at_most`."""
    power = 10.0 ** math.floor(math.log10(at_most))
    return next(m * power for m in (5, 2, 1) if m * power <= at_most * 1.000001)


def length_label(length):
    """0.02 -> '20 mm', 0.5 -> '50 cm'."""
    for factor, unit in ((1e3, "km"), (1.0, "m"), (1e-2, "cm"), (1e-3, "mm"), (1e-6, "µm")):
        if length >= factor * 0.9999 and not (unit == "cm" and length < 0.0999):
            return f"{length / factor:.4g} {unit}"
    return f"{length:.3g} m"


def _distinct(values):
    """The values as text, with the fewest digits that keep them distinct."""
    distinct = sorted(set(values))
    if len(distinct) == 1:
        return [f"{v:.4g}" for v in values]
    gap = min(b - a for a, b in zip(distinct, distinct[1:]))
    digits = next((d for d in range(9) if all(abs(v - round(v, d)) < 0.02 * gap for v in distinct)), 9)
    return [f"{v:.{digits}f}" for v in values]


def time_labels(times):
    """Labels such as 't = 12.5 ms', all in one unit."""
    factor, unit = prefix("s", max(abs(t) for t in times))
    return [f"t = {figure} {unit}" for figure in _distinct([float(t / factor) for t in times])]


def load_factor_labels(factors):
    return [f"load factor {figure}" for figure in _distinct([float(f) for f in factors])]
