"""Logarithmic axes: limits around data and few round ticks with readable labels."""
import numpy as np
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

from . import words

SMALLEST = 1e-300


def positive(values):
    values = np.asarray(list(values), float)
    return values[np.isfinite(values) & (values > SMALLEST)]


def limits(values, pad=0.08, least=1.0):
    """(low, high) around positive values, at least `least` decades; (0.1, 10) without any."""
    values = positive(values)
    if not values.size:
        return 0.1, 10.0
    low, high = np.log10(values.min()), np.log10(values.max())
    extra = max(0.0, least - (high - low)) / 2 + pad * max(high - low, least)
    return 10.0 ** max(low - extra, -299.0), 10.0 ** min(high + extra, 299.0)


def ticks(low, high, most):
    """1-2-5 ticks over less than two decades, else powers of ten, at most `most`."""
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))
    decades = np.log10(high) - np.log10(low)
    steps = (1, 2, 5) if 3 * decades <= most and decades < 2.2 else (1,)
    every = 1 if len(steps) > 1 else max(1, int(np.ceil(decades / most)))
    found = [m * 10.0 ** k for k in range(first, last + 1) if k % every == 0 for m in steps]
    return [x for x in found if low * 0.9999 <= x <= high * 1.0001]


def error_tick(x):
    mantissa = x / 10.0 ** np.floor(np.log10(x) + 1e-9)
    return words.power_of_ten(x) if abs(mantissa - 1) < 1e-6 else words.exponent(x)


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
