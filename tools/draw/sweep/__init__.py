"""One page, pictures of points and paper figures from sweep.json (`orthodyn sweep`)."""
from pathlib import Path


def write_sweep_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .gallery import draw_gallery
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_sweep
    from .view_source import view_source
    from ..view.beside import with_view, write_page
    sweep, folder = read_sweep(result), Path(result)
    gallery = draw_gallery(sweep, folder, folder / "pictures" / "points.png")
    path = out or folder / "report.html"

    def report(view):
        return page(sweep, folder, gallery, view)

    yield write_page(path, report)
    yield from gallery
    yield from write_paper_figures(sweep, folder / "pictures")
    yield from with_view(path, (lambda: view_source(folder)) if gallery else None, report)
