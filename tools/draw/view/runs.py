"""The runs of a comparison that kept frames, each with how far it is from its reference."""
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import DrawError
from ..report import formatting
from ..report.reading import FILE, read_comparison
from ..series import Series
from .collect import Extent
from .shown import Shown

REFERENCE = "reference"
DIFFERENCE = "difference"  # node field, m: the displacement less that of the reference at the same time

MOST_BYTES = 300e6  # of frames, of which the page holds the surface in half of the digits


class Compared(Series):
    """A run's frames, with their difference from those of a reference that has the same nodes and times."""

    def __init__(self, folder, reference):
        super().__init__(folder)
        self._reference = None
        if reference and len(self) <= len(reference) and self.frame(0).points.shape == reference.frame(0).points.shape:
            self._reference = reference

    def frame(self, index):
        frame = super().frame(index)
        if self._reference is None:
            return frame
        difference = frame.node_fields["displacement"] - self._reference.frame(index).node_fields["displacement"]
        return replace(frame, node_fields={**frame.node_fields, DIFFERENCE: difference})


def is_comparison(folder):
    return (Path(folder) / FILE).is_file()


def _has_frames(folder):
    return (folder / "frames.pvd").is_file()


def keeps_frames(comparison, folder):
    return any(_has_frames((folder / point.scene).parent) for point in comparison.points)


def modest_extent(comparison, folder):
    """As many frames of each as make a page of less than about 60 MB."""
    files = sum(f.stat().st_size for p in comparison.points for f in ((folder / p.scene).parent / "frames").glob("*.vtu"))
    return Extent(every=max(1, math.ceil(files / MOST_BYTES)))


def _facts(point):
    if not point.completed:
        return (f"failed: {': '.join(part for part in (point.reason, point.message) if part)}",)
    return (f"error {formatting.general(point.error('displacement.l2'), 3)}, {formatting.seconds(point.seconds())}",)


def _of_problem(comparison, folder, problem):
    reference = folder / problem.reference.folder if problem.reference.folder else None
    series = Series(reference) if reference and _has_frames(reference) else None
    if series:
        yield Shown(REFERENCE, series, reference, problem.label, facts=(problem.reference.method,))
    methods = {method.id: method.label for method in comparison.methods}
    for point in comparison.points_of(problem):
        place = (folder / point.scene).parent
        if _has_frames(place):
            yield Shown(f"{methods[point.method]}, {formatting.control(point.control)}", Compared(place, series), place,
                        problem.label, facts=_facts(point))


def of_comparison(folder):
    """Of each problem the reference and its points, from loose to tight."""
    comparison = read_comparison(folder)
    found = [shown for problem in comparison.problems for shown in _of_problem(comparison, Path(folder), problem)]
    if not found:
        raise DrawError(f"{folder}: no point kept frames; name `frames: {{}}` in the comparison, and run it again")
    return found


def first_look(shown):
    """What the view begins with: the first problem's reference and the run that is farthest from it, when it is so."""
    own = [(_distances(one.series), k) for k, one in enumerate(shown) if one.group == shown[0].group and k]
    if shown[0].name != REFERENCE or not own:
        return {"panes": list(range(len(shown)))[:2]}
    distances, farthest = max(own, key=lambda found: max(found[0]))
    return {"panes": [0, farthest], "time": float(shown[farthest].series.times[np.argmax(distances)])}


def _distances(series):
    """Of each frame, m; 0 where there is no reference on the same mesh."""
    found = (series.frame(k).node_fields.get(DIFFERENCE, np.zeros(1)) for k in range(len(series)))
    return [float(np.nan_to_num(abs(difference)).max()) for difference in found]
