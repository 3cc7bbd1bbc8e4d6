"""Fonts, colours and resolution of all pictures."""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend is chosen before pyplot is loaded)

DPI = 200
TEXT = "#22252b"
FAINT = "#6b7280"
GRID = "#e5e7eb"

matplotlib.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 9, "text.color": TEXT, "axes.labelcolor": TEXT,
    "axes.edgecolor": FAINT, "axes.linewidth": 0.7, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.6, "axes.axisbelow": True,
    "xtick.color": FAINT, "ytick.color": FAINT, "xtick.labelcolor": TEXT, "ytick.labelcolor": TEXT,
    "xtick.labelsize": 8, "ytick.labelsize": 8, "legend.frameon": False, "legend.fontsize": 8,
    "savefig.facecolor": "white", "figure.facecolor": "white", "lines.solid_capstyle": "round",
})


def save(figure, path, dpi=DPI):
    """Writes the figure to `path` and closes it. Returns the path."""
    figure.align_ylabels()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=dpi)
    pyplot.close(figure)
    return path
