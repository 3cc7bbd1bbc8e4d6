"""The page of a stability matrix: one HTML file that opens offline."""
from pathlib import Path

from ..report import formatting
from ..report.details import command, drawing, facts, pairs
from ..report.document import document, header, not_finished, run_data, section, when
from ..report.markup import joined, tag
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
    return parts + [p for p in (when(matrix.at),
                                f"{machine}, {cores} cores" if machine and cores else machine) if p]


def _banner(matrix):
    if matrix.complete:
        return None
    return not_finished(f"{formatting.count(len(matrix.trials))} of {formatting.plural(matrix.planned, 'trial')}. What "
                        "follows covers the trials so far.")


def _origin(matrix, folder):
    lines = f"{command('stability', matrix.file, folder)}\n{drawing(folder)}"
    files = pairs((case.label, tag("code", case.file)) for case in matrix.cases)
    blocks = (("Machine", facts(matrix.machine)), ("Versions", facts(matrix.versions)))
    return joined([pairs([("File", tag("code", matrix.file) if matrix.file else ""), ("Written", matrix.at)]),
                   tag("div", *(tag("div", tag("h3", name), content) for name, content in blocks), class_="columns"),
                   tag("h3", "To reproduce"), tag("pre", tag("code", lines)), tag("h3", "Scenes"), files])


def page(matrix, folder, view=None):
    """The page as HTML. `folder`: contains the end states; `view`: file of the 3D view, or None."""
    sections = (("answer", "Integrators in order", answer(matrix)), ("matrix", "Matrix", grid(matrix)),
                ("states", "End states", gallery(matrix, Path(folder))), ("trials", "Not passed", failures(matrix)),
                ("details", "Origin", _origin(matrix, folder)))
    tooltips = [tooltip(t) for t in matrix.trials] + [case_tooltip(c) for c in matrix.cases]
    top = header(matrix.title, _counted(matrix), [part[:2] for part in sections], matrix.description, _banner(matrix), view)
    return document(matrix.title, STYLE.read_text(encoding="utf-8") + grades.css(), top,
                    [section(*part) for part in sections], run_data(tooltips), grades.symbols())
