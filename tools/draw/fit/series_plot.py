"""Measured and computed values of a table over time or frequency, with the residuals below."""
import math

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ..report.layout import LETTER, WIDE, PixelLayout, styled
from ..report.theme import LIGHT
from ..study_json import with_unit
from ..sweep.curves import scaled
from ..units import prefix
from .numbers import minus

MOST_BARS = 60    # measured values, up to which deviations are drawn as bars
MOST_MARKS = 200  # most marks of measured values
BAND = 1.96       # residuals of noise are within it with a probability of 95 %
LOG_RATIO = 30    # largest over smallest amplitude, from which the axis over frequency is logarithmic
MEASURED, COMPUTED, START = LIGHT["ink"], LIGHT["c1"], LIGHT["k4"]


def every(series):
    """Distance between the measured values that have a mark; 1 if all have."""
    return -(-len(series.data) // MOST_MARKS)


def _column(series, key, factor=1.0):
    return np.array([getattr(d, key) for d in series.data]) / factor


def _unit(values, unit):
    finite = np.abs(values[np.isfinite(values)])
    return prefix(unit, float(finite.max())) if finite.size else (1.0, unit)


def _is_log(series, values):
    finite = values[np.isfinite(values)]
    return series.is_over_frequency and finite.size > 0 and finite.min() > 0 and finite.max() > LOG_RATIO * finite.min()


def _legend(layout, y):
    x = 0
    for words, style in (("measured", {"marker": "o", "ms": 5, "color": MEASURED, "ls": "none"}),
                         ("computed", {"color": COMPUTED, "lw": 1.8}), ("at start", {"color": START, "lw": 1.8})):
        xs = [x + 9] if "marker" in style else [x, x + 18]
        layout.line(xs, [y] * len(xs), **style)
        layout.text(x + 25, y, words)
        x += 44 + LETTER * len(words)


def _values(axes, series, x, factor):
    columns = {key: _column(series, key, factor) for key in ("measured", "computed", "at_start", "deviation")}
    drawn = np.concatenate([columns[key] for key in ("measured", "computed", "at_start")])
    scaled(axes, "y", list(drawn), _is_log(series, drawn), 6)
    axes.plot(x, columns["at_start"], color=START, lw=1.8, zorder=2)
    axes.plot(x, columns["computed"], color=COMPUTED, lw=1.8, zorder=3)
    if len(x) <= MOST_BARS:
        axes.vlines(x, columns["measured"] - columns["deviation"], columns["measured"] + columns["deviation"],
                    color=MEASURED, lw=1, zorder=4)
    _marks(axes, series, x, columns["measured"])


def _marks(axes, series, x, values):
    size = 4.5 if len(x) <= MOST_BARS else 3
    for k in range(0, len(x), every(series)):
        axes.plot([x[k]], [values[k]], marker="o", ms=size, ls="none", mfc=MEASURED, mec=LIGHT["paper"], mew=0.5,
                  clip_on=False, zorder=5, gid=f"pt-{series.data[k].index}-0")


def residual_limit(residuals):
    """Half of the range of an axis of residuals."""
    finite = [abs(r) for r in residuals if math.isfinite(r)]
    return max(2.6, 1.12 * max(finite, default=0))


def _residuals(axes, series, x):
    residuals = _column(series, "residual")
    most = residual_limit(residuals)
    axes.set_ylim(-most, most)
    axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: minus(f"{y:g}")))
    axes.axhspan(-BAND, BAND, color=LIGHT["band"], lw=0, zorder=0)
    axes.axhline(0, color=LIGHT["muted"], lw=0.8, zorder=1)
    if every(series) > 1:
        axes.plot(x, residuals, color=COMPUTED, lw=1, zorder=3)
        return
    axes.vlines(x, 0, residuals, color=COMPUTED, lw=1, zorder=2)
    for datum, place in zip(series.data, x):
        if math.isfinite(datum.residual):
            axes.plot([place], [datum.residual], marker="o", ms=4, ls="none", color=COMPUTED, clip_on=False, zorder=3,
                      gid=f"pt-{datum.index}-0")


@styled
def draw_series(series, width):
    narrow = width < WIDE
    left, top, right, gap, below = (58 if narrow else 64), 58, 14, 40, 110
    height = 210 if narrow else 280
    layout = PixelLayout(width, top + height + gap + below + 52)
    shown = np.concatenate([_column(series, key) for key in ("measured", "computed")])
    factor, unit = _unit(shown, series.data[0].unit)
    x = _column(series, "over")
    x_factor, x_unit = (1.0, "Hz") if series.is_over_frequency else _unit(x, "s")
    across = width - left - right
    upper = layout.axes(left, top, across, height)
    lower = layout.axes(left, top + height + gap, across, below)
    for axes in (upper, lower):
        scaled(axes, "x", list(x / x_factor), False, 4 if narrow else 8)
    upper.tick_params(labelbottom=False)
    _values(upper, series, x / x_factor, factor)
    _residuals(lower, series, x / x_factor)
    layout.text(0, 14, with_unit(f"{series.experiment}: {series.quantity}", unit), weight="bold")
    _legend(layout, 38)
    layout.text(0, top + height + 22, "Residual / deviation", color=LIGHT["muted"])
    name = "Frequency" if series.is_over_frequency else "Time"
    layout.text(left + across / 2, top + height + gap + below + 36, with_unit(name, x_unit), ha="center")
    layout.description = (f"{series.quantity} of {series.experiment}: {len(series.data)} measured values and the "
                          f"computed curve; largest residual {max(map(abs, _column(series, 'residual'))):.2g} deviations.")
    return layout
