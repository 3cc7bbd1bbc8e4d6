"""One page and figures from stability.json (`orthodyn stability`)."""
from pathlib import Path


def write_stability_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figure import write_figures
    from .page import page
    from .reading import read_matrix
    from .view_source import view_source
    from ..view.beside import with_view, write_page
    matrix, folder = read_matrix(result), Path(result)
    path = out or folder / "report.html"

    def report(view):
        return page(matrix, folder, view)

    yield write_page(path, report)
    yield from write_figures(matrix, folder / "pictures")
    has_states = any(t.folder and (folder / t.folder / "end.vtu").is_file() for t in matrix.trials)
    yield from with_view(path, (lambda: view_source(folder)) if has_states else None, report)
