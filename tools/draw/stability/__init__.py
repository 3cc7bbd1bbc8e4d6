"""One page and figures from stability.json, what `orthodyn stability` has written."""
from pathlib import Path

FILE = "stability.json"


def write_stability_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figure import write_figures
    from .page import page
    from .reading import read_matrix
    from ..view.beside import with_view
    matrix, folder = read_matrix(result), Path(result)
    path = out or folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)

    def write(view=None):
        path.write_text(page(matrix, folder, view), encoding="utf-8")

    write()
    yield path
    yield from write_figures(matrix, folder / "pictures")
    has_states = any(t.folder and (folder / t.folder / "end.vtu").is_file() for t in matrix.trials)
    yield from with_view(path, folder, has_states, write)
