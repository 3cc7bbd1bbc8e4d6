"""Dot plot of the residuals of an experiment's single values."""
import math

from matplotlib.ticker import FuncFormatter, MaxNLocator

from ..report.layout import LETTER, WIDE, PixelLayout, shortened, styled
from ..report.theme import LIGHT
from .numbers import minus
from .series_plot import BAND, COMPUTED, residual_limit

ROW = 24


@styled
def draw_residuals(experiment, data, width):
    narrow = width < WIDE
    labels = [shortened(d.title, 22 if narrow else 40) for d in data]
    left, top, height = 16 + LETTER * max(map(len, labels)), 32, ROW * len(data)
    layout = PixelLayout(width, top + height + 48)
    axes = layout.axes(left, top, width - left - 16, height)
    most = residual_limit(d.residual for d in data)
    axes.set_xlim(-most, most)
    axes.xaxis.set_major_locator(MaxNLocator(4 if narrow else 8, steps=[1, 2, 5, 10]))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: minus(f"{x:g}")))
    axes.set_ylim(len(data) - 0.5, -0.5)
    axes.set_yticks(range(len(data)), labels)
    axes.axvspan(-BAND, BAND, color=LIGHT["band"], lw=0, zorder=0)
    axes.axvline(0, color=LIGHT["muted"], lw=0.8, zorder=1)
    for k, datum in enumerate(data):
        if math.isfinite(datum.residual):
            axes.plot([0, datum.residual], [k, k], color=COMPUTED, lw=1.2, zorder=2)
            axes.plot([datum.residual], [k], marker="o", ms=7.5, ls="none", mfc=COMPUTED, mec=LIGHT["paper"], mew=0.8,
                      clip_on=False, zorder=3, gid=f"pt-{datum.index}-0")
        else:
            axes.annotate("unknown", (0, k), xytext=(6, 0), textcoords="offset points", va="center", fontsize=11,
                          color=LIGHT["muted"])
    layout.text(0, 14, f"{experiment}: residuals", weight="bold")
    layout.text(left + (width - left - 16) / 2, top + height + 34, "Residual / deviation", ha="center")
    layout.description = f"Residuals of {experiment}: " + "; ".join(f"{d.title} {d.residual:.2g}" for d in data)
    return layout
