"""Data with their fit: figures, tables of single values, and the test of the residuals."""
import math

from ..report import formatting
from ..report.markup import joined, tag
from ..report.tables import number, table
from ..units import prefix
from . import numbers
from .series_plot import BAND, MOST_BARS, every

FAR = 1e-3  # probability of so small a chi-square, below which the stated deviations look too large
SERIES = ("Dots are measured values, and their bars one standard deviation. The pale line is computed with the start values. "
          "Below, residuals are (computed − measured) / deviation: of noise, 95 % lie in the grey band.")
SINGLE = "Residuals are (computed − measured) / deviation. Of noise, 95 % lie in the grey band, between −1.96 and 1.96."


def _scaled(datum):
    """(factor, unit) in which the datum is readable: µm for 1e-4 m."""
    return prefix(datum.unit, abs(datum.measured)) if datum.measured else (1.0, datum.unit)


def _texts(datum):
    """Measured value, deviation and computed value as texts, and their unit."""
    factor, unit = _scaled(datum)
    width = datum.deviation / factor
    return (numbers.rounded(datum.measured / factor, width), numbers.rounded(width, width),
            numbers.rounded(datum.computed / factor, width), unit)


def _residual(datum):
    return numbers.minus(f"{datum.residual:.2f}").replace("−0.00", "0.00") if math.isfinite(
        datum.residual) else formatting.UNKNOWN


def _mode(datum):
    return str(int(datum.mode)) if math.isfinite(datum.mode) else ""


def _mac(datum):
    return f"{datum.mac:.2f}" if math.isfinite(datum.mac) else ""


def _row(datum, with_mode, with_mac):
    measured, deviation, computed, unit = _texts(datum)
    far = abs(datum.residual) > BAND
    modes = [number(_mode(datum))] * with_mode + [number(_mac(datum))] * with_mac
    return tag("tr", tag("th", datum.title, scope="row"), number(measured), number(deviation), number(computed),
               tag("td", unit or "", class_="word"), number(tag("strong", _residual(datum)) if far else _residual(datum)),
               *modes)


def _single_table(experiment, data):
    head = [("Datum", False), ("Measured", True), ("Deviation", True), ("Computed", True), ("Unit", False),
            ("Residual / deviation", True)]
    with_mac = any(math.isfinite(d.mac) for d in data)
    with_mode = with_mac or any(math.isfinite(d.mode) and _mode(d) != d.title.rsplit(" ", 1)[-1] for d in data)
    head += [("Computed mode", True)] * with_mode + [("MAC", True)] * with_mac
    return table(f"Single values of {experiment}", head, [_row(d, with_mode, with_mac) for d in data], f"Data of {experiment}",
                 "long named" if len(data) > 15 else "named")


def _smaller(noise):
    """Whether the residuals are far smaller than noise of the stated deviations."""
    return noise.freedom > 0 and 1 - noise.probability < FAR


def noise_sentences(noise):
    if noise.freedom <= 0:
        return "There are as many parameters as measured values, so the fit cannot be tested."
    freedom = f"{formatting.plural(noise.freedom, 'degree')} of freedom"
    found = numbers.brief(noise.chi_square, 4 if noise.chi_square >= 100 else 3)
    parts = [f"Chi-square, the sum of the squared residuals over their deviations, is {found}, "
             f"with {freedom}: about {formatting.count(noise.freedom)} is expected of noise."]
    if math.isfinite(noise.probability):
        parts.append(f"The probability of a value this large or larger is {numbers.brief(noise.probability, 2)}.")
    if _smaller(noise):
        parts.append("The residuals are far smaller than the stated deviations: the deviations may be too large.")
    if noise.factor > 1:
        parts.append(f"The deviations were enlarged by a factor {noise.factor:.2g} for the intervals.")
    if math.isfinite(noise.runs_probability):
        parts.append("The probability of as few or fewer changes of sign between neighbouring residuals is "
                     f"{numbers.brief(noise.runs_probability, 2)} (runs test).")
    return " ".join(parts)


def _figure(picture, label, words=None):
    return tag("figure", tag("div", picture, class_="stage"), tag("figcaption", words) if words else None, aria_label=label)


def data_section(fit, figures):
    parts = [tag("p", noise_sentences(fit.noise))]
    for k, series in enumerate(fit.series):
        words = [SERIES] * (k == 0)
        words += ["Bars are left out, because there are many values."] * (len(series.data) > MOST_BARS)
        if (step := every(series)) > 1:
            words.append(f"One in {step} of {len(series.data)} values is drawn as a dot, all as residuals.")
        parts.append(_figure(figures.series(series), series.quantity, " ".join(words)))
    for k, (experiment, data) in enumerate(fit.single.items()):
        parts += [_figure(figures.residuals(experiment, data), experiment, SINGLE if k == 0 else None),
                  _single_table(experiment, data)]
    return joined(parts)


def tip(datum):
    """The tooltip of a datum."""
    measured, deviation, computed, unit = _texts(datum)
    rows = [["Measured", numbers.with_unit(f"{measured} ± {deviation}", unit)],
            ["Computed", numbers.with_unit(computed, unit)], ["Residual / deviation", _residual(datum)]]
    rows += [["Computed mode", _mode(datum)]] * bool(_mode(datum)) + [["MAC", _mac(datum)]] * bool(_mac(datum))
    return {"title": datum.title, "rows": rows, "e": {}}
