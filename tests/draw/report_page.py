"""Test cases for reports, and a parser of their pages."""
import re
import shutil
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

from folder_test import InAFolder  # noqa: E402
from synthetic_comparison import comparison, write_comparison  # noqa: E402

from draw.report import formatting  # noqa: E402
from draw.report.page import page  # noqa: E402
from draw.report.reading import read_comparison  # noqa: E402

VOID = {"meta", "link", "input", "br", "img"}
EVIL = '<script>alert("x")</script> & $\\frac{1}$ \'</title>'


class Page(HTMLParser):
    """The content of a page; checks that all elements are closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.attributes, self.words, self.unbalanced = [], [], [], [], []
        self.tables, self.cell = [], None
        self.feed(text)

    def handle_starttag(self, name, attributes):
        found = dict(attributes)
        self.attributes.append((name, found))
        if "id" in found:
            self.ids.append(found["id"])
        if name == "table":
            self.tables.append([])
        if name == "tr" and self.tables:
            self.tables[-1].append([])
        if name in ("td", "th"):
            self.tables[-1][-1].append("")
            self.cell = name
        if name not in VOID:
            self.open.append(name)

    def handle_startendtag(self, name, attributes):
        self.attributes.append((name, dict(attributes)))
        if "id" in dict(attributes):
            self.ids.append(dict(attributes)["id"])

    def handle_endtag(self, name):
        if not self.open or self.open.pop() != name:
            self.unbalanced.append(name)
        if name == self.cell:
            self.cell = None

    def handle_data(self, text):
        if self.open and self.open[-1] not in ("script", "style"):
            self.words.append(text)
        if self.cell:
            self.tables[-1][-1][-1] += text

    @property
    def text(self):
        return " ".join("".join(self.words).replace(formatting.THIN, " ").split())


CHROMIUM = shutil.which("chromium")


def dom_of(path, width=1280, *more):
    """The page after its scripts have run, and the console output; `more`: options of the browser."""
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", *(more or ["--disable-gpu"]), "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             f"--user-data-dir={profile}", f"--window-size={width},900", "--enable-logging=stderr", "--dump-dom",
             path.as_uri()], capture_output=True, text=True, timeout=90)
    return done.stdout, re.findall(r":CONSOLE.*", done.stderr)


class OfAComparison(InAFolder):
    def setUp(self):
        super().setUp()
        self.folder /= "r"

    def read(self, content):
        return read_comparison(write_comparison(self.folder, content))

    def html(self, content):
        return page(self.read(content), self.folder)

    def small(self, problems=1, methods=3, points=3, **changes):
        """One error measure and one clock, so that the page has few figures."""
        content = comparison(problems, methods, points)
        for point in content["points"]:
            if point["errors"]:
                point["errors"] = {"displacement": {"l2": point["errors"]["displacement"]["l2"]}}
            point["cpu"] = None
        return {**content, **changes}

    def run_draw(self, *arguments):
        return super().run_draw("report", *arguments)
