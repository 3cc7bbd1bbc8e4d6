"""The points of a sweep as the frames of a series, each with its values for a time."""
from pathlib import Path

from ..errors import DrawError
from ..series import Series
from ..sweep import FILE
from ..sweep.reading import read_sweep
from .item import Item, Source, name_of


class SweepPoints(Series):
    """Those that have a frame, on the mesh of the first: a sweep over meshes shows the first of them."""

    def __init__(self, sweep, folder):
        self.folder = folder
        found = [p for p in sweep.done if p.get("frame") and (folder / p["folder"] / p["frame"]).is_file()]
        if not found:
            raise DrawError(f"{folder}: no point has a frame; name `frames: {{}}` in the sweep")
        self.paths = [folder / p["folder"] / p["frame"] for p in found]
        first = self.frame(0)
        same = [k for k in range(len(found)) if self._is_like(k, first)]
        self.paths = [self.paths[k] for k in same]
        self.times = [float(k) for k in range(len(same))]
        self.labels = [", ".join(f"{v.name} {v.words(found[k]['values'][v.name])}" for v in sweep.variables) for k in same]

    def _is_like(self, k, first):
        frame = self.frame(k)
        return frame.points.shape == first.points.shape and frame.tets.shape == first.tets.shape


def is_sweep(folder):
    return (Path(folder) / FILE).is_file()


def of_sweep(folder):
    sweep = read_sweep(folder)
    series = SweepPoints(sweep, folder)
    start = {"scale": sweep.frames["enlarged"], "color": sweep.frames["color"]} if sweep.frames else {}
    return Source("sweep", [Item(name_of(folder), series, labels=series.labels)], start)
