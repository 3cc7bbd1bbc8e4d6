"""View of a sweep: its points as frames, which are labelled by the values of the variables."""
from ..errors import DrawError
from ..series import Series
from ..view.item import Item, Source, name_of
from ..vtu import read_vtu
from .reading import read_sweep


class SweepPoints(Series):
    """Points that share a mesh, as frames."""

    def __init__(self, sweep, folder, points):
        self.folder = folder
        self.paths = [folder / p["folder"] / p["frame"] for p in points]
        self.times = [float(k) for k in range(len(points))]
        self.labels = [", ".join(f"{v.name} {v.words(p['values'][v.name])}" for v in sweep.variables) for p in points]


def _by_mesh(folder, points):
    """The points grouped by mesh, in the order of the sweep."""
    found = {}
    for p in points:
        frame = read_vtu(folder / p["folder"] / p["frame"])
        found.setdefault((frame.points.shape, frame.tets.tobytes()), []).append(p)
    return list(found.values())


def _shared(sweep, points):
    """The values that these points share but not all points of the sweep: 'mesh coarse'."""
    return ", ".join(f"{v.name} {v.words(points[0]['values'][v.name])}" for v in sweep.variables
                     if len({p["values"][v.name] for p in points}) == 1 and len(sweep.levels(v)) > 1)


def view_source(folder):
    """The Source of a sweep, with an item for each mesh. The item's frames are the points with this mesh."""
    sweep = read_sweep(folder)
    found = [p for p in sweep.done if p.get("frame") and (folder / p["folder"] / p["frame"]).is_file()]
    if not found:
        raise DrawError(f"{folder}: no point has a frame; add `frames: {{}}` to the sweep and run it again")
    groups = _by_mesh(folder, found)
    items = []
    for points in groups:
        series = SweepPoints(sweep, folder, points)
        items.append(Item(_shared(sweep, points) if len(groups) > 1 else name_of(folder), series, labels=series.labels))
    start = {"scale": sweep.frames["enlarged"], "color": sweep.frames["color"]} if sweep.frames else {}
    return Source(folder, "sweep", items, start)
