"""Views of runs and modes, and of several sources on one page."""
import json
from dataclasses import replace

import numpy as np

from ..modes import LARGEST, Shapes, is_of_modes, labelled_modes
from ..series import Series, is_static
from .item import Item, Source, name_of


def run_source(folder):
    """The Source of a run: its frames, or its mode shapes if there are no frames."""
    if (folder / "modes.pvd").is_file() and not (folder / "frames.pvd").is_file():
        return _of_shapes(folder)
    series = Series(folder)
    return Source(folder, "run", [Item(name_of(folder), series, folder, is_static=is_static(folder))], _at_largest(series))


def _at_largest(series):
    """Defaults of a page that opens at the largest displacement, magnified if that is too small to see."""
    peak, _, _ = series.peak
    start = {} if peak is None else {"time": float(series.times[peak])}
    return {**start, "scale": series.visible_scale} if series.visible_scale else start


def _of_shapes(folder):
    """The Source of mode shapes. They are magnified, because the size of a mode shape is arbitrary."""
    shapes = Shapes(folder)
    scale = LARGEST * float(np.ptp(shapes.frame(0).points, axis=0).max())
    return Source(folder, "shapes", [Item(name_of(folder), shapes, labels=labelled_modes(folder, shapes), is_shape=True)],
                  {"color": "swing", "range": [-1, 1], "scale": scale, "swing": is_of_modes(folder)})


def told_apart(items):
    """The items with distinct names. The settings of the run, or a number, are added to equal names."""
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
    """Defaults of a page with these sources. Several sources are shown with the first two side by side, and use the
    first source's defaults only if all are of the same kind."""
    first = sources[0]
    if len(sources) == 1:
        return {"scale": 1.0, "panes": [0], **first.start}
    shared = first.start if all(s.kind == first.kind for s in sources) else {}
    return {"scale": 1.0, **{key: shared[key] for key in ("scale", "color", "range", "rest") if key in shared},
            "panes": [0, len(first.items)]}
