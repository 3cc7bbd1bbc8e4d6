"""From the folder that a command wrote to what a view shows of it."""
from pathlib import Path

import numpy as np

from ..modes import LARGEST, Shapes, read_modes
from ..series import Series, is_static
from . import end_states, points, runs
from .shown import Shown

STUDIES = ((points.is_sweep, points.of_sweep), (runs.is_comparison, runs.of_comparison),
           (end_states.is_matrix, end_states.of_matrix))


def shown_of(name):
    """A list of Shown."""
    folder = Path(name)
    for is_it, of_it in STUDIES:
        if is_it(folder):
            return of_it(folder)
    if (folder / "modes.pvd").is_file() and not (folder / "frames.pvd").is_file():
        return [_of_shapes(folder)]
    return [Shown(folder.name or str(folder), Series(folder), folder, is_static=is_static(folder))]


def _of_shapes(folder):
    shapes = Shapes(folder)
    figures, label = read_modes(folder)
    return Shown(folder.name, shapes, labels=[f"{k + 1}: {label(f)}" for k, f in enumerate(figures[:len(shapes)])])


def first_look(names, shown):
    """What a view begins with if nothing is said: panes, time, color, scale and rest shape; the size of a shape means nothing."""
    first, start = shown[0], {"scale": 1.0, "panes": [0, 1] if len(names) > 1 else [0]}
    if len(names) == 1 and runs.is_comparison(names[0]):
        start.update(runs.first_look(shown))
    if end_states.is_matrix(names[0]):
        start.update(color=end_states.COLOUR, rest=True)
    if isinstance(first.series, Shapes):
        start.update(color="shape", scale=LARGEST * float(np.ptp(first.series.frame(0).points, axis=0).max()))
    return start
