"""One page, pictures of points and paper figures from sweep.json, what `orthodyn sweep` has written."""
from pathlib import Path

FILE = "sweep.json"


def write_sweep_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .gallery import draw_gallery
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_sweep
    from ..view.beside import with_view
    sweep, folder = read_sweep(result), Path(result)
    gallery = draw_gallery(sweep, folder, folder / "pictures" / "points.png")
    path = out or folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)

    def write(view=None):
        path.write_text(page(sweep, folder, gallery, view), encoding="utf-8")

    write()
    yield path
    yield from gallery
    yield from write_paper_figures(sweep, folder / "pictures")
    yield from with_view(path, folder, bool(gallery), write)
