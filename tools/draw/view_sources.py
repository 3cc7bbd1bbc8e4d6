"""Finds what kind of result a folder holds, for `draw view`."""
from pathlib import Path

from .report import reading as comparison, view_source as comparison_view
from .stability import reading as stability, view_source as stability_view
from .sweep import reading as sweep, view_source as sweep_view
from .view.sources import run_source

STUDIES = ((sweep, sweep_view), (comparison, comparison_view), (stability, stability_view))


def source_of(name):
    """The Source of a result folder; `name` is the folder or a file in it. Raises DrawError if there is nothing to
    show."""
    path = Path(name)
    folder = path.parent if path.is_file() else path
    for reading, view in STUDIES:
        if (folder / reading.KIND.file).is_file():
            return view.view_source(folder)
    return run_source(folder)


def sources_of(names):
    return [source_of(name) for name in names]
