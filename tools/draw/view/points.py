"""The points of a sweep as the frames of a series, each with its values for a time."""
from pathlib import Path

from ..errors import DrawError
from ..series import Series
from ..sweep import FILE
from ..sweep.reading import read_sweep
from ..vtu import read_vtu
from .item import Item, Source, name_of


class SweepPoints(Series):
    """Points that have one mesh."""

    def __init__(self, sweep, folder, points):
        self.folder = folder
        self.paths = [folder / p["folder"] / p["frame"] for p in points]
        self.times = [float(k) for k in range(len(points))]
        self.labels = [", ".join(f"{v.name} {v.words(p['values'][v.name])}" for v in sweep.variables) for p in points]


def _by_mesh(folder, points):
    """Lists of points; those of the first mesh first."""
    found = {}
    for p in points:
        frame = read_vtu(folder / p["folder"] / p["frame"])
        found.setdefault((frame.points.shape, frame.tets.tobytes()), []).append(p)
    return list(found.values())


def _shared(sweep, points):
    """'mesh coarse': what all of these have, and not all of the sweep."""
    return ", ".join(f"{v.name} {v.words(points[0]['values'][v.name])}" for v in sweep.variables
                     if len({p["values"][v.name] for p in points}) == 1 and len(sweep.levels(v)) > 1)


def is_sweep(folder):
    return (Path(folder) / FILE).is_file()


def of_sweep(folder):
    """All points that have a frame; those of each mesh are frames of one series."""
    sweep = read_sweep(folder)
    found = [p for p in sweep.done if p.get("frame") and (folder / p["folder"] / p["frame"]).is_file()]
    if not found:
        raise DrawError(f"{folder}: no point has a frame; name `frames: {{}}` in the sweep")
    groups = _by_mesh(folder, found)
    items = []
    for points in groups:
        series = SweepPoints(sweep, folder, points)
        items.append(Item(_shared(sweep, points) if len(groups) > 1 else name_of(folder), series, labels=series.labels))
    start = {"scale": sweep.frames["enlarged"], "color": sweep.frames["color"]} if sweep.frames else {}
    return Source("sweep", items, start)
