"""The 3D view beside a report, which then links to it."""
import sys

from ..errors import DrawError
from .page import FILE, write_view


def with_view(path, folder, has_frames, write):
    """Writes the view of `folder` beside the report that stands at `path`, and the report again by `write(view)`, with a
    link; yields the view's path. A view that cannot be drawn is a line on stderr. Without one an old one goes."""
    path.with_name(FILE).unlink(missing_ok=True)
    if not has_frames:
        return
    try:
        yield write_view([folder], path.with_name(FILE))
    except DrawError as error:
        print(f"draw: no 3D view: {error}", file=sys.stderr)
        return
    write(FILE)
