"""One page and paper figures from compare.json, what `orthodyn compare` has written."""
from pathlib import Path

VIEW = "view.html"


def write_report(result, out=None):
    """Writes RESULT/report.html (or `out`) and RESULT/pictures; yields the paths."""
    from .figures import write_paper_figures
    from .page import page
    from .reading import read_comparison
    from ..view.page import write_view
    from ..view.runs import keeps_frames, modest_extent
    comparison, folder = read_comparison(result), Path(result)
    path = out or folder / "report.html"
    path.parent.mkdir(parents=True, exist_ok=True)
    has_frames = keeps_frames(comparison, folder)
    path.write_text(page(comparison, folder, VIEW if has_frames else None), encoding="utf-8")
    yield path
    if has_frames:
        yield write_view([folder], path.with_name(VIEW), modest_extent(comparison, folder))
    yield from write_paper_figures(comparison, folder / "pictures")
