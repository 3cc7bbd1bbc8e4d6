"""One page and paper figures from convergence.json (`orthodyn converge`)."""
from pathlib import Path


def write_convergence_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_convergence
    from ..view.beside import write_page
    study, folder = read_convergence(result), Path(result)
    yield write_page(out or folder / "report.html", lambda _: page(study, folder))
    yield from write_paper_figures(study, folder / "pictures")
