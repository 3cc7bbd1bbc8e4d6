"""The page of a matrix of hard cases: one HTML file that opens without a network."""
import shlex
from pathlib import Path

from ..report import formatting
from ..report.details import facts, pairs
from ..report.markup import Html, data_script, joined, tag
from ..report.page import SCRIPT, head
from . import grades
from .answer import answer
from .failures import failures
from .formatting import case_tooltip, tooltip
from .gallery import gallery
from .grid import grid

STYLE = Path(__file__).resolve().parent / "page.css"


def _counted(matrix):
    parts = [formatting.plural(len(matrix.cases), "case"), formatting.plural(len(matrix.integrators), "integrator"),
             formatting.plural(len(matrix.variants), "variant"), formatting.plural(len(matrix.trials), "trial")]
    if formatting.known(matrix.limit):
        parts.append(f"at most {formatting.seconds(matrix.limit)} each")
    machine, cores = matrix.machine.get("processor", ""), matrix.machine.get("cores", "")
    return parts + [p for p in (matrix.at.replace("T", " ").replace("Z", " UTC"),
                                f"{machine}, {cores} cores" if machine and cores else machine) if p]


def _banner(matrix):
    if matrix.complete:
        return None
    return tag("p", tag("strong", "Not finished: "), f"{formatting.count(len(matrix.trials))} of "
               f"{formatting.plural(matrix.planned, 'trial')}. What follows covers the trials so far.", class_="banner",
               role="status")


def _header(matrix, sections, view):
    return tag("header", tag("button", "Dark", type="button", id="theme", class_="js"), tag("h1", matrix.title),
               tag("p", matrix.description, class_="lede") if matrix.description else None,
               tag("p", " · ".join(_counted(matrix)), class_="facts"), _banner(matrix),
               tag("nav", *(tag("a", name, href=f"#{identity}") for identity, name, _ in sections),
                   tag("a", "In 3D", href=view) if view else None, aria_label="Sections"))


def _origin(matrix, folder):
    place = shlex.quote(str(folder))
    command = (f"orthodyn stability {shlex.quote(matrix.file or 'FILE.yaml')} --out {place}\n"
               f"tools/draw/draw report {place}")
    files = pairs((case.label, tag("code", case.file)) for case in matrix.cases)
    blocks = (("Machine", facts(matrix.machine)), ("Versions", facts(matrix.versions)))
    return joined([pairs([("File", tag("code", matrix.file) if matrix.file else ""), ("Written", matrix.at)]),
                   tag("div", *(tag("div", tag("h3", name), content) for name, content in blocks), class_="columns"),
                   tag("h3", "To reproduce"), tag("pre", tag("code", command)), tag("h3", "Scenes"), files])


def page(matrix, folder, view=None):
    """The whole page as text; `folder` has the end states and is named in the command that reproduces it, `view` is the page
    with the end states in 3D."""
    sections = (("answer", "Integrators in order", answer(matrix)), ("matrix", "Matrix", grid(matrix)),
                ("states", "End states", gallery(matrix, Path(folder))), ("trials", "Not passed", failures(matrix)),
                ("details", "Origin", _origin(matrix, folder)))
    main = tag("main", *(tag("section", tag("h2", name), content, id=identity) for identity, name, content in sections))
    tooltips = [tooltip(t) for t in matrix.trials] + [case_tooltip(c) for c in matrix.cases]
    body = tag("body", grades.symbols(), _header(matrix, sections, view), main,
               data_script("run-data", {"measure": "", "labels": {}, "runs": tooltips}),
               tag("script", Html(SCRIPT.read_text(encoding="utf-8"))))
    style = STYLE.read_text(encoding="utf-8") + grades.css()
    return "<!DOCTYPE html>\n" + tag("html", head(matrix.title, style), body, lang="en") + "\n"
