"""Test case for pages of the 3D view, and a decoder of their data."""
import base64
import gzip
import html
import json
import re

import numpy as np

from folder_test import InAFolder
from tiny_result import write_curves, write_result

from draw.view.collect import Extent
from draw.view import page as view_page
from draw.view_sources import sources_of


def page(results, extent, start=None):
    return view_page.page(sources_of(results), extent, start)


def unpacked(text):
    """All blocks of a page by name: kind, numbers, and planes as they are stored."""
    found = {}
    for name, about, packed in re.findall(r'id="([^"]*)" data-about="([^"]*)">([^<]*)</script>', text):
        found[html.unescape(name)] = json.loads(html.unescape(about)), gzip.decompress(base64.b64decode(packed))
    return found


def values_of(block):
    """Values as rows, as in web/src/blocks.ts."""
    about, raw = block
    planes = np.frombuffer(raw, {"u32": "<u4", "f32": "<f4", "linear": "<u2", "half": "<f2"}[about["kind"]])
    rows = planes.reshape(about["components"], -1).T.astype(float)
    if about["kind"] == "linear":
        return np.array(about["low"]) + rows * np.array(about["step"])
    return rows * about.get("factor", 1) + about.get("offset", 0)


class OfAResult(InAFolder):
    def setUp(self):
        super().setUp()
        self.times = [0.0, 0.25, 0.5, 1.0]
        self.result = write_result(self.folder / "r", self.times)
        write_curves(self.result)

    def page(self, **extent):
        return page([self.result], Extent(**extent))
