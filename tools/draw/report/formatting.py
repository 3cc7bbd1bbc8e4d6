"""Formats numbers and times. Unknown ones become '–'."""
import math

from ..digits import known_digits

UNKNOWN = "–"
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
THIN = "\u202f"  # narrow no-break space


def known(x):
    return x is not None and math.isfinite(x)


def exponent(x, digits=2):
    """0.0032 -> '3.2e-3', 1e-3 -> '1e-3'."""
    if not known(x):
        return UNKNOWN
    if x == 0:
        return "0"
    if 1 <= abs(x) < 1000:
        return f"{x:.{digits}g}" if abs(x) < 10 ** digits else f"{x:.0f}"
    mantissa, power = f"{x:.{digits - 1}e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return f"{mantissa}e{int(power)}"


def fixed_exponent(x):
    """For columns: always two digits, 1e-3 -> '1.0e-3'."""
    if not known(x) or x == 0:
        return exponent(x)
    mantissa, power = f"{x:.1e}".split("e")
    return f"{mantissa}e{int(power)}"


def percent(x):
    """1e-3 -> '0.1 %'; '' for numbers that are clearer without a percentage."""
    return f"{100 * x:.2g}{THIN}%" if known(x) and 1e-6 <= x <= 1 else ""


def seconds(x):
    """Two or three digits and a unit: '24 ms', '0.24 s', '12.3 s', '34 min'."""
    if not known(x):
        return UNKNOWN
    for factor, unit, from_ in ((3600, "h", 2 * 3600), (60, "min", 600), (1, "s", 0.095), (1e-3, "ms", 0.095e-3)):
        if x >= from_:
            return f"{_digits(x / factor)}{THIN}{unit}"
    return f"{_digits(x / 1e-6)}{THIN}µs"


def _digits(x):
    if x == 0 or not 1e-3 <= x < 1e6:
        return f"{x:.3g}"
    return f"{x:.{max(0, 1 - math.floor(math.log10(x)))}f}" if x < 100 else f"{x:.0f}"


def step(x):
    """0.0025 -> '2.5 ms'."""
    factor, unit = next(((f, u) for f, u in ((1, "s"), (1e-3, "ms"), (1e-6, "µs")) if x >= f), (1e-9, "ns"))
    return f"{x / factor:.3g}{THIN}{unit}"


def plain_seconds(x):
    """A time without unit, for columns headed by 's'."""
    if not known(x):
        return UNKNOWN
    return f"{x:.3f}" if x < 10 else f"{x:.1f}" if x < 1000 else f"{x:.0f}"


def span(spread):
    """'0.230 to 0.260' for repeats that differ."""
    return f"{plain_seconds(spread.min)} to {plain_seconds(spread.max)}" if spread.max > spread.min else UNKNOWN


def count(x):
    """12345 -> '12 345' with a narrow space."""
    return f"{x:,.0f}".replace(",", THIN) if known(x) else UNKNOWN


def megabytes(x):
    return f"{x / 1e6:,.0f}".replace(",", THIN) if known(x) else UNKNOWN


def general(x, digits=4, error=math.nan):
    """The number with the digits that exceed its relative error."""
    return known_digits(x, error, digits) if known(x) else UNKNOWN


def control(control):
    """'rtol 1e-3', 'step 2 ms', 'safety 0.9'."""
    if not known(control.value):
        return control.kind or UNKNOWN
    shown = {"step": step, "safety": "{:g}".format}.get(control.kind, lambda value: exponent(value, 3))
    return f"{control.kind} {shown(control.value)}"


def power_of_ten(x):
    """1e-3 -> '10⁻³', for axes."""
    return "10" + str(round(math.log10(x))).translate(SUPERSCRIPT)


def joined(parts):
    """'a', 'a and b', 'a, b and c'."""
    parts = list(parts)
    return " and ".join([", ".join(parts[:-1]), parts[-1]] if len(parts) > 1 else parts)


def plural(number, noun):
    return f"{count(number)} {noun}" + ("" if number == 1 else "s")
