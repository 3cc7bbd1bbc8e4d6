"""The runs of a comparison that kept frames, each with how far it is from its reference."""
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import DrawError
from ..report import formatting
from ..report.reading import FILE, read_comparison
from ..series import Series
from .item import Item, Source

REFERENCE = "reference"
DIFFERENCE = "difference"  # node field, m: the displacement less that of the reference at the same time
MOST_BYTES = 300e6  # of frames, which make a page of less than about 60 MB: it holds the surface, in half of the digits


class Compared(Series):
    """A run's frames, with their difference from those of a reference that has the same nodes and times."""

    def __init__(self, folder, reference):
        super().__init__(folder)
        self._reference = None
        if reference and self._fits(reference):
            self._reference = reference

    def _fits(self, reference):
        """A run that failed has only the first of the times."""
        return (len(self) <= len(reference) and np.allclose(self.times, reference.times[:len(self)])
                and np.array_equal(self.frame(0).points, reference.frame(0).points))

    def frame(self, index):
        frame = super().frame(index)
        if self._reference is None:
            return frame
        difference = frame.node_fields["displacement"] - self._reference.frame(index).node_fields["displacement"]
        return replace(frame, node_fields={**frame.node_fields, DIFFERENCE: difference})

    def distances(self):
        """The largest difference of each frame, m; None where there is no reference for it."""
        if self._reference is None:
            return None
        return [float(abs(self.frame(k).node_fields[DIFFERENCE]).max()) for k in range(len(self))]


def is_comparison(folder):
    return (Path(folder) / FILE).is_file()


def _shows(series):
    """Whether all of it can be drawn: a run that went astray may have no finite places."""
    return all(np.isfinite(series.frame(k).node_fields["displacement"]).all() for k in range(len(series)))


def _series(folder, make):
    """Of a run's folder; None where it has nothing that can be shown."""
    if not (folder / "frames.pvd").is_file():
        return None
    try:
        series = make(folder)
        return series if _shows(series) else None
    except DrawError:  # no frame, as of a process that was killed
        return None


def _facts(point):
    if not point.completed:
        return (f"failed: {': '.join(part for part in (point.reason, point.message) if part)}",)
    return (f"error {formatting.general(point.error('displacement.l2'), 3)}, {formatting.seconds(point.seconds())}",)


def _of_problem(comparison, folder, problem):
    place = folder / problem.reference.folder
    reference = _series(place, Series) if problem.reference.folder else None
    if reference:
        yield Item(REFERENCE, reference, place, problem.label, facts=(problem.reference.method,))
    methods = {method.id: method.label for method in comparison.methods}
    for point in comparison.points_of(problem):
        place = (folder / point.scene).parent
        series = _series(place, lambda found: Compared(found, reference))
        if series:
            yield Item(f"{methods[point.method]}, {formatting.control(point.control)}", series, place, problem.label,
                       facts=_facts(point))


def of_comparison(folder):
    """Of each problem the reference and its points, from loose to tight."""
    comparison = read_comparison(folder)
    items = [item for problem in comparison.problems for item in _of_problem(comparison, folder, problem)]
    if not items:
        raise DrawError(f"{folder}: no point kept frames; name `frames: {{}}` in the comparison, and run it again")
    files = sum(path.stat().st_size for item in items for path in item.series.paths)
    return Source("comparison", items, _start(items), max(1, math.ceil(files / MOST_BYTES)))


def _start(items):
    """The first problem's reference and the run that is farthest from it, when it is so."""
    distances = {k: item.series.distances() for k, item in enumerate(items)
                 if item.group == items[0].group and isinstance(item.series, Compared)}
    largest = {k: max(d) for k, d in distances.items() if d and max(d) > 0}
    if not largest:
        return {"panes": list(range(len(items)))[:2]}
    farthest = max(largest, key=largest.get)
    return {"panes": [0, farthest], "time": float(items[farthest].series.times[np.argmax(distances[farthest])])}
