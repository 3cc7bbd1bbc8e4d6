"""One page and paper figures from fit.json (`orthodyn fit`)."""
from pathlib import Path


def write_fit_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_fit
    from ..view.beside import write_page
    fit, folder = read_fit(result), Path(result)
    yield write_page(out or folder / "report.html", lambda _: page(fit, folder))
    yield from write_paper_figures(fit, folder / "pictures")
