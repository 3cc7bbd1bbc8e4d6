"""View of a comparison: the runs that kept frames, with their differences from the reference."""
import math
from dataclasses import replace

import numpy as np

from ..errors import DrawError
from ..series import Series
from ..view.item import Item, Source
from . import formatting
from .reading import read_comparison

REFERENCE = "reference"
DIFFERENCE = "difference"  # node field (m): displacement minus that of the reference at the same time
MOST_BYTES = 300e6  # of frame files to include. The page has about 60 MB then: surfaces only, in half precision


class Compared(Series):
    """A run's frames, with their difference from a reference that has the same nodes and times."""

    def __init__(self, folder, reference):
        super().__init__(folder)
        self._reference = None
        if reference and self._fits(reference):
            self._reference = reference

    def _fits(self, reference):
        """Whether nodes and times agree. A failed run has only the first of the reference's times."""
        return (len(self) <= len(reference) and np.allclose(self.times, reference.times[:len(self)])
                and np.array_equal(self.frame(0).points, reference.frame(0).points))

    def frame(self, index):
        frame = super().frame(index)
        if self._reference is None:
            return frame
        difference = frame.node_fields["displacement"] - self._reference.frame(index).node_fields["displacement"]
        return replace(frame, node_fields={**frame.node_fields, DIFFERENCE: difference})

    def distances(self):
        """The largest difference (m) in each frame; None without a reference."""
        if self._reference is None:
            return None
        return [float(abs(self.frame(k).node_fields[DIFFERENCE]).max()) for k in range(len(self))]


def _shows(series):
    """Whether all positions are finite."""
    return all(np.isfinite(series.frame(k).node_fields["displacement"]).all() for k in range(len(series)))


def _series(folder, make):
    """The series make(folder), or None if the run has nothing to show."""
    if not (folder / "frames.pvd").is_file():
        return None
    try:
        series = make(folder)
        return series if _shows(series) else None
    except DrawError:  # no complete frame: the process was killed
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


def view_source(folder):
    """The Source of a comparison: for each problem the reference, then its points from loose to tight control."""
    comparison = read_comparison(folder)
    items = [item for problem in comparison.problems for item in _of_problem(comparison, folder, problem)]
    if not items:
        raise DrawError(f"{folder}: no point kept frames; add `frames: {{}}` to the comparison and run it again")
    files = sum(path.stat().st_size for item in items for path in item.series.paths)
    return Source(folder, "comparison", items, _start(items), max(1, math.ceil(files / MOST_BYTES)))


def _start(items):
    """The page opens with the first problem's reference beside the run that differs most from it, at the time of the
    largest difference."""
    distances = {k: item.series.distances() for k, item in enumerate(items)
                 if item.group == items[0].group and isinstance(item.series, Compared)}
    largest = {k: max(d) for k, d in distances.items() if d and max(d) > 0}
    if not largest:
        return {"panes": list(range(len(items)))[:2]}
    farthest = max(largest, key=largest.get)
    return {"panes": [0, farthest], "time": float(items[farthest].series.times[np.argmax(distances[farthest])])}
