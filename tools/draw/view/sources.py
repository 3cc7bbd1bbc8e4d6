"""From the folder that a command wrote to what a view shows of it."""
import json
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..modes import LARGEST, Shapes, is_of_modes, labelled_modes
from ..series import Series, is_static
from . import end_states, points, runs
from .item import Item, Source, name_of

STUDIES = ((points.is_sweep, points.of_sweep), (runs.is_comparison, runs.of_comparison),
           (end_states.is_matrix, end_states.of_matrix))


def folder_of(name):
    """That of a report, a run.json and so on."""
    path = Path(name)
    return path.parent if path.is_file() else path


def source_of(name):
    """The Source of a folder, or of a file in it. Raises DrawError where it has nothing to show."""
    folder = folder_of(name)
    for is_it, of_it in STUDIES:
        if is_it(folder):
            return of_it(folder)
    if (folder / "modes.pvd").is_file() and not (folder / "frames.pvd").is_file():
        return _of_shapes(folder)
    series = Series(folder)
    return Source("run", [Item(name_of(folder), series, folder, is_static=is_static(folder))], _at_largest(series))


def _at_largest(series):
    """At rest there is nothing to see, nor in a motion that is too small."""
    peak, _, _ = series.peak
    start = {} if peak is None else {"time": float(series.times[peak])}
    return {**start, "scale": series.visible_scale} if series.visible_scale else start


def _of_shapes(folder):
    """Enlarged to be seen: the size of a shape means nothing."""
    shapes = Shapes(folder)
    scale = LARGEST * float(np.ptp(shapes.frame(0).points, axis=0).max())
    return Source("shapes", [Item(name_of(folder), shapes, labels=labelled_modes(folder, shapes), is_shape=True)],
                  {"color": "swing", "range": [-1, 1], "scale": scale, "swing": is_of_modes(folder)})


def told_apart(items):
    """Those of one name and group with what was set for each of them, or else with a number."""
    found = []
    for item in items:
        same = [other for other in items if (other.name, other.group) == (item.name, item.group)]
        if len(same) > 1:
            texts = [", ".join(_set(other)) for other in same]
            number = next(k for k, other in enumerate(same) if other is item)
            told = texts[number] if texts[number] and texts.count(texts[number]) == 1 else str(number + 1)
            item = replace(item, name=f"{item.name} ({told})")
        found.append(item)
    return found


def _set(item):
    try:
        return json.loads((item.folder / "run.json").read_text(encoding="utf-8"))["set"]
    except (OSError, ValueError, KeyError, TypeError):
        return []


def begin(sources):
    """The start of a page of these: of several kinds only what holds for all, and the first two beside each other."""
    first = sources[0]
    if len(sources) == 1:
        return {"scale": 1.0, "panes": [0], **first.start}
    shared = first.start if all(s.kind == first.kind for s in sources) else {}
    return {"scale": 1.0, **{key: shared[key] for key in ("scale", "color", "range", "rest") if key in shared},
            "panes": [0, len(first.items)]}
