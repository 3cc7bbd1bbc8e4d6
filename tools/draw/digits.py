"""Numbers with as many digits as are known of them, as lib/core/digits.h has it."""
import math

FEWEST = 2


def known_digits(value, error=math.nan, most=7):
    """A value of which a share `error` may be wrong: with the digits that the error does not touch and one more, at least
    two and at most `most`; 324.487 with an error of 0.3 is '320'. With `most` where the error is 0 or not known."""
    if not math.isfinite(error) or error == 0:
        return f"{value:.{most}g}"
    digits = min(max(math.ceil(-math.log10(abs(error))) + 1, FEWEST), most)
    rounded = f"{value:.{digits - 1}e}"
    number = float(rounded)
    if number != 0 and not 1e-4 <= abs(number) < 1e7:
        return rounded
    power = math.floor(math.log10(abs(number))) if number else 0
    return f"{number:.{max(digits - 1 - power, 0)}f}"
