"""One page and paper figures from compare.json, what `orthodyn compare` has written."""
from pathlib import Path


def write_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_comparison
    from ..view.beside import with_view
    comparison, folder = read_comparison(result), Path(result)
    path = out or folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)

    def write(view=None):
        path.write_text(page(comparison, folder, view), encoding="utf-8")

    write()
    yield path
    yield from write_paper_figures(comparison, folder / "pictures")
    has_frames = any((folder / point.scene).with_name("frames.pvd").is_file() for point in comparison.points)
    yield from with_view(path, folder, has_frames, write)
