"""Chi-square against iteration for each attempt of the search."""
import math

from matplotlib.ticker import MaxNLocator

from ..report import theme
from ..report.layout import WIDE, PixelLayout, legend_columns, legend_height, side_margin, styled
from ..report.runs import end_fraction, label_runs
from ..report.scale import error_tick, limits, set_log
from ..report.theme import LIGHT

MOST_NAMES = 8  # attempts, up to which each has a colour and a name


def _rows(attempt):
    return [i for i in attempt.iterations if math.isfinite(i.chi_square) and i.chi_square > 0]


def _attempt(axes, colour, index, rows, front):
    kept = [i for i in rows if i.accepted]
    axes.plot([i.number for i in kept], [i.chi_square for i in kept], color=colour, lw=1.8 if front else 1.3,
              gid=f"me-{index}", zorder=4 if front else 3)
    for i in rows:
        axes.plot([i.number], [i.chi_square], marker="o", ms=6.5 if front else 5, ls="none", clip_on=False,
                  mfc=colour if i.accepted else LIGHT["paper"], mec=LIGHT["paper"] if i.accepted else colour,
                  mew=0.8 if i.accepted else 1.2, gid=f"pt-{i.index}-{index}", zorder=5)


def _expected(axes, freedom):
    """A line at the expected chi-square of noise, if it is within the axis."""
    low, high = axes.get_ylim()
    if not low < freedom < high:
        return
    axes.axhline(freedom, color=LIGHT["muted"], lw=0.9, ls=(0, (3, 3)), zorder=1)
    axes.annotate("expected of noise", (1, freedom), xycoords=axes.get_yaxis_transform(), xytext=(-2, 4),
                  textcoords="offset points", ha="right", va="bottom", fontsize=11, color=LIGHT["muted"])


def _name(fit, k):
    return f"attempt {k + 1}" + (" (best)" if k == fit.best and len(fit.attempts) > 1 else "")


@styled
def draw_search(fit, width):
    """The layout; None if no attempt has iterations."""
    drawn = {k: rows for k, attempt in enumerate(fit.attempts) if (rows := _rows(attempt))}
    if not drawn:
        return None
    named = len(fit.attempts) <= MOST_NAMES
    entries = [(k, _name(fit, k), False) for k in drawn if (named or k == fit.best) and len(fit.attempts) > 1]
    narrow = width < WIDE
    left, top, height, columns = (50 if narrow else 58), 36, (220 if narrow else 280), legend_columns(entries)
    right = 16 if narrow or not entries else side_margin(entries)
    layout = PixelLayout(width, top + height + 54 + (legend_height(entries, columns) if narrow else 0))
    box = (left, top, width - left - right, height)
    axes = layout.axes(*box)
    set_log(axes, "y", *limits([i.chi_square for rows in drawn.values() for i in rows]), error_tick)
    last = max(i.number for rows in drawn.values() for i in rows)
    axes.set_xlim(-0.02 * max(last, 1), 1.02 * max(last, 1))
    axes.xaxis.set_major_locator(MaxNLocator(6 if narrow else 10, integer=True))
    _expected(axes, fit.noise.freedom)
    for k, rows in drawn.items():
        colour = theme.colour(k) if named or k == fit.best else LIGHT["muted"]
        _attempt(axes, colour, k, rows, k == fit.best)
    layout.text(0, 14, "Chi-square", weight="bold")
    layout.text(box[0] + box[2] / 2, top + height + 36, "Iteration", ha="center")
    ends = [end_fraction(axes, drawn[k][-1].chi_square) for k, *_ in entries]
    label_runs(layout, box, entries, ends, columns, 50, plain=True)
    layout.description = "Chi-square of each iteration; at the end " + ", ".join(
        f"{_name(fit, k)} {rows[-1].chi_square:.2g}" for k, rows in drawn.items())
    return layout
