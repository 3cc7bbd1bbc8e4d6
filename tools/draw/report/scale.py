"""Logarithmic axes: limits around the data, and few round ticks with readable labels."""
import numpy as np
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

from . import formatting

SMALLEST = 1e-300


def positive(values):
    values = np.asarray(list(values), float)
    return values[np.isfinite(values) & (values > SMALLEST)]


def limits(values, pad=0.08, least=1.0):
    """(low, high) around the positive values, at least `least` decades apart; (0.1, 10) if there are no such values."""
    values = positive(values)
    if not values.size:
        return 0.1, 10.0
    low, high = np.log10(values.min()), np.log10(values.max())
    extra = max(0.0, least - (high - low)) / 2 + pad * max(high - low, least)
    return 10.0 ** max(low - extra, -299.0), 10.0 ** min(high + extra, 299.0)


def _candidates(low, high):
    """Ticks from fine to coarse: 1-2-5, 1-3, powers of ten, every second power, ..."""
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))
    for steps, every in [((1, 2, 5), 1), ((1, 3), 1)] + [((1,), k) for k in range(1, last - first + 2)]:
        found = [m * 10.0 ** k for k in range(first, last + 1) if k % every == 0 for m in steps]
        yield [x for x in found if low * 0.9999 <= x <= high * 1.0001]


def ticks(low, high, most):
    """The ticks: powers of ten if there are three to `most` of them; else the finest candidate with at most `most`
    ticks, or a finer one if that has fewer than two ticks."""
    best, candidates = [], list(_candidates(low, high))
    if 3 <= len(candidates[2]) <= most:
        return candidates[2]
    for found in candidates:
        if len(found) <= most:
            return found if len(found) >= 2 or not best else best
        best = found
    return best


def error_tick(x):
    """1e-3 -> '10⁻³', 2e-3 -> '2e-3', 1 -> '1'."""
    if 0.99 < x < 10:
        return f"{x:g}"
    mantissa = x / 10.0 ** np.floor(np.log10(x) + 1e-9)
    return formatting.power_of_ten(x) if abs(mantissa - 1) < 1e-6 else formatting.exponent(x)


def seconds_tick(x):
    """1e-3 -> '1 ms', 0.1 -> '0.1 s', 1e4 -> '10⁴ s'."""
    if 0.0999 <= x < 9999:
        return f"{x:g} s"
    for factor, unit in ((1e-3, "ms"), (1e-6, "µs")):
        if factor * 0.999 <= x < 0.0999:
            return f"{x / factor:.3g} {unit}"
    return f"{error_tick(x)} s"


def set_log(axes, which, low, high, label, most=7):
    """Makes the x or y axis logarithmic from `low` to `high`."""
    getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}lim")(low, high)
    axis = getattr(axes, f"{which}axis")
    found = ticks(low, high, most)
    axis.set_major_locator(FixedLocator(found))
    axis.set_major_formatter(FixedFormatter([label(x) for x in found]))
    axis.set_minor_locator(NullLocator())
