"""One page and paper figures from compare.json (`orthodyn compare`)."""
from pathlib import Path


def write_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_comparison
    from .view_source import view_source
    from ..view.beside import with_view, write_page
    comparison, folder = read_comparison(result), Path(result)
    path = out or folder / "report.html"

    def report(view):
        return page(comparison, folder, view)

    yield write_page(path, report)
    yield from write_paper_figures(comparison, folder / "pictures")
    has_frames = any((folder / point.scene).with_name("frames.pvd").is_file() for point in comparison.points)
    yield from with_view(path, (lambda: view_source(folder)) if has_frames else None, report)
