"""From the folder that a command wrote to what a view shows of it."""
from pathlib import Path

import numpy as np

from ..modes import LARGEST, Shapes, labelled_modes
from ..series import Series, is_static
from . import end_states, points, runs
from .item import Item, Source, name_of

STUDIES = ((points.is_sweep, points.of_sweep), (runs.is_comparison, runs.of_comparison),
           (end_states.is_matrix, end_states.of_matrix))


def source_of(name):
    """The Source of a folder. Raises DrawError where it has nothing to show."""
    folder = Path(name)
    for is_it, of_it in STUDIES:
        if is_it(folder):
            return of_it(folder)
    if (folder / "modes.pvd").is_file() and not (folder / "frames.pvd").is_file():
        return _of_shapes(folder)
    return Source("run", [Item(name_of(folder), Series(folder), folder, is_static=is_static(folder))], {})


def _of_shapes(folder):
    """Enlarged to be seen: the size of a shape means nothing."""
    shapes = Shapes(folder)
    scale = LARGEST * float(np.ptp(shapes.frame(0).points, axis=0).max())
    return Source("shapes", [Item(name_of(folder), shapes, labels=labelled_modes(folder, shapes))],
                  {"color": "shape", "scale": scale})


def begin(sources):
    """The start of a page of these: of several kinds only what holds for all, and the first two beside each other."""
    first = sources[0]
    if len(sources) == 1:
        return {"scale": 1.0, "panes": [0], **first.start}
    shared = first.start if all(s.kind == first.kind for s in sources) else {}
    return {"scale": 1.0, **{key: shared[key] for key in ("scale", "color", "rest") if key in shared},
            "panes": [0, len(first.items)]}
