"""One page and figures from stability.json, what `orthodyn stability` has written."""
from pathlib import Path

FILE, VIEW = "stability.json", "view.html"


def write_stability_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figure import write_figures
    from .page import page
    from .reading import read_matrix
    from ..view.page import write_view
    matrix, folder = read_matrix(result), Path(result)
    path = out or folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)
    has_states = any(t.folder and (folder / t.folder / "end.vtu").is_file() for t in matrix.trials)
    path.write_text(page(matrix, folder, VIEW if has_states else None), encoding="utf-8")
    yield path
    if has_states:
        yield write_view([folder], path.with_name(VIEW))
    yield from write_figures(matrix, folder / "pictures")
