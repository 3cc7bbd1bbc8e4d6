"""One page and paper figures from convergence.json, what `orthodyn converge` has written."""
from pathlib import Path

FILE = "convergence.json"


def write_convergence_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_convergence
    study, folder = read_convergence(result), Path(result)
    path = out or folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page(study, folder), encoding="utf-8")
    yield path
    yield from write_paper_figures(study, folder / "pictures")
