"""The answer of a fit: its findings as sentences, and the table of the parameters."""
import math
import re

from ..report import formatting
from ..report.markup import joined, tag
from ..report.tables import number, table
from . import numbers

UNKNOWN = "unknown"
PROFILE = (" Profile interval: where chi-square, minimised over the other parameters, has risen by 3.84; it holds also where the "
           "linearised interval does not.")
CAPTION = ("Fitted parameters. The interval contains the true value with a probability of 95 %, if the scenes and the "
           "stated deviations are right. Shift: change by one refinement of the meshes; in bold if it leaves the interval.")


def sentence(text, names=()):
    """The text with a capital letter, unless it begins with one of the names, with a full stop, and with a minus and a
    percent sign that are not separated from their numbers."""
    text = re.sub(r"(?<= )-(?=\d)", "−", re.sub(r"(?<=\d) %", f"{formatting.THIN}%", text))
    first = text.split(" ", 1)[0]
    start = text if first in names else text[:1].upper() + text[1:]
    return start if start.endswith((".", "!", "?")) else start + "."


def value(parameter):
    """The value with the digits that its interval justifies, and its unit."""
    return numbers.with_unit(numbers.rounded(parameter.value, parameter.half_width), parameter.unit)


def _interval(parameter):
    width = parameter.half_width
    if not math.isfinite(width):
        return tag("td", UNKNOWN, class_="word")
    ends = " to ".join(numbers.rounded(end, width) for end in (parameter.low, parameter.high))
    return tag("td", f"{ends} ", tag("small", parameter.precision), class_="word")


def _knowledge(parameter):
    return tag("td", parameter.knowledge + (", at its bound" if parameter.at_bound else ""), class_="word")


def _prior(parameter):
    if not math.isfinite(parameter.prior):
        return formatting.UNKNOWN
    return f"{numbers.brief(parameter.prior)} ± {numbers.brief(parameter.prior_deviation, 2)}"


def _shift(parameter):
    text = numbers.signed(parameter.shift)
    return tag("strong", text) if abs(parameter.shift) > parameter.half_width else text


def _profile(parameter):
    if not parameter.profile:
        return formatting.UNKNOWN
    width = parameter.half_width
    ends = [UNKNOWN if not math.isfinite(end) else numbers.rounded(end, width) if math.isfinite(width)
            else numbers.brief(end, 3) for end, _ in parameter.profile]
    return " to ".join(text + " (bound)" * is_open for text, (_, is_open) in zip(ends, parameter.profile))


def _row(parameter, with_prior, with_shift, with_profile):
    cells = [number(value(parameter)), _interval(parameter), _knowledge(parameter), number(numbers.brief(parameter.start))]
    cells[2:2] = [tag("td", _profile(parameter), class_="word")] if with_profile else []
    cells += [number(_prior(parameter))] if with_prior else []
    cells += [number(_shift(parameter))] if with_shift else []
    return tag("tr", tag("th", parameter.name, scope="row", title=", ".join(parameter.paths) or None), *cells)


def parameter_table(fit):
    with_prior = any(math.isfinite(p.prior) for p in fit.parameters)
    with_shift = any(math.isfinite(p.shift) for p in fit.parameters)
    with_profile = any(p.profile for p in fit.parameters)
    head = [("Parameter", False), ("Value", True), ("95 % interval", False), ("Knowledge", False), ("Start", True)]
    head[3:3] = [("Profile interval", False)] if with_profile else []
    head += [("Prior", True)] if with_prior else []
    head += [("Shift", True)] if with_shift else []
    rows = [_row(p, with_prior, with_shift, with_profile) for p in fit.parameters]
    caption = CAPTION if with_shift else CAPTION.split(" Shift:")[0]
    caption += PROFILE if with_profile else ""
    return table(caption, head, rows, "Parameters")


def answer(fit):
    """The first finding as the headline, the others as a list, and the table."""
    first, *others = [sentence(text, [p.name for p in fit.parameters]) for text in fit.findings] or [
        "The fit has no findings."]
    return joined([tag("p", first, class_="headline"), tag("ul", *(tag("li", s) for s in others)) if others else None,
                   parameter_table(fit) if fit.parameters else None])


def banner(fit):
    """The warnings, or None."""
    found = [sentence(text, [p.name for p in fit.parameters]) for text in fit.warnings]
    if not found:
        return None
    if len(found) == 1:
        return tag("p", found[0], class_="banner", role="status")
    return tag("div", tag("ul", *(tag("li", s) for s in found)), class_="banner", role="status")
