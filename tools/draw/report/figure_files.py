"""Figures of a report: as SVGs of the page in two widths, and as files for papers."""
import re

import matplotlib

from .layout import NARROW, WIDE
from .markup import Html, tag
from .svg import Styles, page_svg

PAPER_DPI = 220
PAPER = {"bbox_inches": "tight", "pad_inches": 0.08, "facecolor": "white"}


class PageFigures:
    """The SVGs of one page. Their ids are distinct, and they share the CSS `styles`."""

    def __init__(self):
        self.styles, self._drawn = Styles(), 0

    def both_widths(self, draw):
        """`draw(width)` as a wide and a narrow SVG, of which the page shows one; None if there is nothing to draw."""
        self._drawn += 1
        parts = []
        for name, width in (("wide", WIDE), ("narrow", NARROW)):
            layout = draw(width)
            if layout is None:
                return None
            parts.append(tag("div", Html(page_svg(layout, f"f{self._drawn}{name[0]}", self.styles)), class_=name))
        return Html("".join(parts))


def file_name(text):
    """`text` with characters that are unusual in file names replaced by underscores."""
    return re.sub(r"[^\w.-]+", "_", text)


def distinct(name, taken):
    """`name`, with underscores appended until it is not in the set `taken`. Adds the result to `taken`."""
    while name in taken:
        name += "_"
    taken.add(name)
    return name


def write_paper_figure(layout, stem):
    """Writes STEM.svg and STEM.png unless the layout is None; yields the paths."""
    if layout is None:
        return
    svg, png = (stem.with_name(f"{stem.name}.{kind}") for kind in ("svg", "png"))
    with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": svg.stem}):
        layout.figure.savefig(svg, metadata={"Date": None}, **PAPER)
    layout.figure.savefig(png, dpi=PAPER_DPI, **PAPER)
    yield svg
    yield png
