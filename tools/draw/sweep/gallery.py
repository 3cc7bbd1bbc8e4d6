"""The frames of a sweep's points as small pictures, with the same camera, window and colour range."""
from pathlib import Path

import matplotlib
import numpy as np

from ..camera import Window
from ..colouring import Colouring
from ..picture import draw_page, strip_columns
from ..scene import Scene, PictureSpec
from ..series import Series
from ..report.theme import DARK
from .plan import plans

MOST_COLUMNS = 8
PAGE, LETTER = 10.0, 0.085  # inches: width of the whole picture, and of a letter
ON_DARK = {**dict.fromkeys(("figure.facecolor", "savefig.facecolor"), DARK["paper"]), "text.color": DARK["ink"],
           **dict.fromkeys(("xtick.color", "ytick.color"), DARK["muted"]),
           **dict.fromkeys(("xtick.labelcolor", "ytick.labelcolor"), DARK["ink"])}


class Files(Series):
    """Frames of which each has its own mesh."""

    def __init__(self, paths):
        self.folder, self.paths, self.times = paths[0].parent, paths, [0.0] * len(paths)


class Gallery:
    """Stands for a Scene in draw_page(), although each frame has its own mesh."""

    def __init__(self, paths, labels, spec):
        series = Files(paths)
        self.scenes = [Scene(series, [k], spec) for k in range(len(paths))]
        self.camera, self.note = self.scenes[0].camera, ""  # the page states the magnification
        self.labels, self.window = dict(enumerate(labels)), Window()
        self.window.include(np.array([w for s in self.scenes for w in (s.window.low, s.window.high)]))
        samples = [s.corner_values(series.frame(k)).ravel() for k, s in enumerate(self.scenes)]
        self.colouring = Colouring(self.scenes[0].quantity, samples)
        for scene in self.scenes:
            scene.colouring = self.colouring

    def draw(self, axes, index, budget):
        self.scenes[index].draw(axes, index, budget)


def _chosen(points, most):
    """At most `most` points, evenly spaced, including the first and the last."""
    if len(points) <= most:
        return points
    return [points[round(k * (len(points) - 1) / max(most - 1, 1))] for k in range(most)]


def _ordered(sweep, points):
    """The points, line by line along x; and the number of columns if the points form a table, else None."""
    plan = plans(sweep)[0]
    along, lines = sweep.levels(plan.x), plan.line_levels(sweep)
    if sweep.combine == "cartesian":
        key = lambda p: (lines.index(p["values"][plan.lines.name]) if plan.lines else 0,  # noqa: E731
                         along.index(p["values"][plan.x.name]))
        points = sorted(points, key=key)
    complete = len(points) == len(along) * len(lines)
    return points, len(along) if complete and plan.lines and len(along) <= MOST_COLUMNS else None


def _label(sweep, point):
    """The point's values without names: 'L, 31.6'."""
    return ", ".join(f"{float(f'{value:.3g}'):g}" + (f" {v.unit}" if v.unit else "") if v.numeric else str(value)
                     for v in sweep.variables for value in [point["values"][v.name]])


def draw_gallery(sweep, folder, path):
    """Writes the picture, and NAME_dark.png for dark pages. Returns both paths, or [] without frames."""
    frames = sweep.frames
    points = [p for p in sweep.done if p.get("frame") and (Path(folder) / p["folder"] / p["frame"]).is_file()]
    if not frames or not points:
        return []
    points, columns = _ordered(sweep, points)
    chosen = _chosen(points, frames["most"])
    paths = [Path(folder) / p["folder"] / p["frame"] for p in chosen]
    gallery = Gallery(paths, [_label(sweep, p) for p in chosen],
                  PictureSpec(color=frames["color"], view=tuple(frames["view"]), up=frames["up"],
                                scale=frames["enlarged"], ghost=frames["ghost"]))
    if not columns or len(chosen) < len(points):
        fitting = int(PAGE / (0.2 + LETTER * max(map(len, gallery.labels.values()))))
        columns = max(1, min(strip_columns(len(chosen), gallery.window.size[0] / gallery.window.size[1]), fitting))
    with matplotlib.rc_context(ON_DARK):
        dark = draw_page(gallery, columns, range(len(chosen)), path.with_stem(f"{path.stem}_dark"))
    return [draw_page(gallery, columns, range(len(chosen)), path), dark]
