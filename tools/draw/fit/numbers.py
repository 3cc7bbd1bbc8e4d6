"""Numbers with the digits that their uncertainty leaves."""
import math

from ..report import formatting

FIGURES = 2  # digits of an uncertainty


def minus(text):
    return text.replace("-", "−")


def rounded(value, width, fewest=3):
    """The value to two digits of its half width: 11.0003 with 0.17 is '11.00'. Without a width, with `fewest` digits."""
    if not math.isfinite(value):
        return formatting.UNKNOWN
    if not (math.isfinite(width) and width > 0):
        return minus(f"{value:.{fewest}g}")
    last = FIGURES - 1 - int(f"{width:.{FIGURES - 1}e}".split("e")[1])  # decimal places
    largest = max(abs(value), width)
    if 1e-3 <= largest < 1e6:
        shown = round(value, min(last, 12)) + 0.0  # 0.0 instead of -0.0
        return minus(f"{shown:.{min(max(last, 0), 12)}f}")
    if value == 0:
        return "0"
    power = math.floor(math.log10(abs(value)))
    return minus(f"{value / 10.0 ** power:.{min(max(last + power, 0), 12)}f}e{power}")


def brief(value, digits=4):
    """A value without a known uncertainty, without trailing zeros: '0.25', '81500', '1.5e−9'."""
    if not math.isfinite(value):
        return formatting.UNKNOWN
    if value == 0 or 1e-4 <= abs(value) < 999999:
        short = float(f"{value:.{digits}g}")
        return minus(f"{short:.0f}" if abs(short) >= 10 ** digits else f"{short:.{digits}g}")
    return minus(formatting.exponent(value, digits))


def with_unit(text, unit):
    return f"{text}{formatting.THIN}{unit}" if unit else text


def signed(value):
    """'+0.0052': a change with two digits."""
    return f"+{brief(value, FIGURES)}" if value > 0 else brief(value, FIGURES)


def times(factor):
    """'1.50 ×' with three digits; '–' if it is unknown."""
    if not math.isfinite(factor):
        return formatting.UNKNOWN
    text = f"{factor:#.3g}".rstrip(".") if factor < 1e3 else brief(factor, 3)
    return f"{text}{formatting.THIN}×"
