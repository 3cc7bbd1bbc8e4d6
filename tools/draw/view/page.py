"""One or several results as an HTML page with a 3D view, of one result or two side by side. The page opens offline."""
import html
import json
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..colouring import CATEGORIES, DIVERGING, NOT_A_NUMBER, SEQUENTIAL
from ..errors import DrawError, unknown
from .blocks import Blocks
from .collect import Extent, add_result, field_names
from .item import name_of
from .sources import begin, told_apart
from .still import take_still

FILE = "view.html"
HERE = Path(__file__).resolve().parent


def write_view(sources, out=None, extent=Extent(), start=None):
    """Writes the page to `out`, default view.html in the first folder, or view_OTHER.html for two sources. Returns the
    path."""
    name = f"view_{name_of(sources[1].folder)}.html" if len(sources) == 2 else FILE
    path = Path(out) if out else sources[0].folder / name
    text = page(sources, extent, start)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def write_still(sources, out, size, extent, start):
    """Writes a picture of the view as PNG, by default at the first source's largest displacement. Returns the path."""
    if Path(out).suffix.lower() != ".png":
        raise DrawError(f"{out}: the picture is a PNG; use a name that ends in .png")
    if len(sources) > 2:
        raise DrawError(f"{len(sources)} results; a picture shows one, or two side by side")
    start, first = {**sources[0].start, **start} if len(sources) == 1 else start, sources[0].items[0]
    if "time" not in start and not first.labels:
        start = {**start, "time": float(first.series.times[first.series.peak[0] or 0])}
    return take_still(page(sources, extent, {**start, "still": True}), Path(out), size)


def page(sources, extent, start=None):
    """The page as HTML. `start`: time, color and scale with which the page opens."""
    start = start or {}
    items, blocks = told_apart([item for source in sources for item in source.items]), Blocks()
    if extent.fields:
        _check_fields(extent.fields, items)
    if extent.every is None:
        extent = replace(extent, every=max(source.every for source in sources))
    described = [add_result(blocks, f"r{k}", item, extent) for k, item in enumerate(items)]
    usual = begin(sources)
    if "color" in start:
        usual.pop("range", None)  # the range belongs to the default colour
    start = {**usual, **start}
    _check(start, described)
    title = " and ".join(dict.fromkeys(name_of(source.folder) for source in sources))
    description = json.dumps({"results": described, "maps": _maps(), "start": start}, allow_nan=False).replace("<", "\\u003c")
    style, script = ((HERE / name).read_text(encoding="utf-8") for name in ("view.css", "viewer.js"))
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{html.escape(title)}</title>\n'
            f'<link rel="icon" href="data:,">\n<style>{style}</style>\n</head>\n<body>\n<div id="view"></div>\n'
            f'<noscript>The view needs JavaScript.</noscript>\n'
            f'<script type="application/json" id="description">{description}</script>\n{blocks.text()}\n'
            f"<script>{script}</script>\n</body>\n</html>\n")


def _check_fields(fields, items):
    """Raises DrawError for a field that no item has."""
    known = dict.fromkeys(name for item in items for name in field_names(item.series.frame(0)))
    for field in fields:
        if field not in known:
            raise unknown("field", field, known)


def _check(start, described):
    """Raises DrawError for a colour that no result has and for a time outside all results."""
    first, last = min(d["times"][0] for d in described), max(d["times"][-1] for d in described)
    time, name = start.get("time"), start.get("color")
    if time is not None and not first <= time <= last:
        raise DrawError(f"no frame at the time {time:g}; the frames are from {first:g} to {last:g}")
    if not start.get("scale", 1.0) > 0:
        raise DrawError(f"--scale: expected a positive number, found {start['scale']:g}")
    known = [q for d in described for q in d["quantities"]]
    if name and not any(name in (q["name"], q["key"], q["field"]) for q in known):
        raise unknown("colour", name, dict.fromkeys(q["name"] for q in known))


def _maps():
    """The colour maps, from the lowest to the highest value, as RGB from 0 to 255."""
    def whole(map_):
        return (255 * map_(np.linspace(0, 1, 256))[:, :3]).round().astype(int).tolist()
    return {"sequential": whole(SEQUENTIAL), "diverging": whole(DIVERGING),
            "categories": [[int(c[k:k + 2], 16) for k in (1, 3, 5)] for c in CATEGORIES],
            "nan": [int(NOT_A_NUMBER[k:k + 2], 16) for k in (1, 3, 5)]}
