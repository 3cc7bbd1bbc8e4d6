"""Writes the 3D view of a study beside its report."""
import sys

from ..errors import DrawError
from .page import FILE, write_view


def write_page(path, page):
    """Writes the HTML of page(None), which has no link to a view. Returns the path."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page(None), encoding="utf-8")
    return path


def with_view(path, make_source, page):
    """Writes the view of make_source() beside the report at `path`, then page(view) as the report, with a link to the
    view. Yields the view's path. If `make_source` is None, only deletes an old view. A failure is reported in a line on
    stderr."""
    path.with_name(FILE).unlink(missing_ok=True)
    if not make_source:
        return
    try:
        yield write_view([make_source()], path.with_name(FILE))
    except DrawError as error:
        print(f"draw: no 3D view: {error}", file=sys.stderr)
        return
    path.write_text(page(FILE), encoding="utf-8")
