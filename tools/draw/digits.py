"""Numbers rounded to the digits that are known, like lib/core/number_format.h."""
import math

FEWEST = 2


def known_digits(value, error=math.nan, most=7):
    """The value with the digits that exceed the relative `error`, and one more: 324.487 with an error of 0.3 is '320'.
    At least 2 digits and at most `most`, which are shown if the error is 0 or unknown."""
    if not math.isfinite(error) or error == 0:
        return f"{value:.{most}g}"
    digits = min(max(math.ceil(-math.log10(abs(error))) + 1, FEWEST), most)
    rounded = f"{value:.{digits - 1}e}"
    number = float(rounded)
    if number != 0 and not 1e-4 <= abs(number) < 1e7:
        return rounded
    power = math.floor(math.log10(abs(number))) if number else 0
    return f"{number:.{max(digits - 1 - power, 0)}f}"
