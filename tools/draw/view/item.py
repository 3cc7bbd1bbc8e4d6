"""What a view can show beside each other: runs, the points of a study, shapes."""
from dataclasses import dataclass
from pathlib import Path

from ..series import Series


@dataclass(frozen=True)
class Item:
    """A series of frames, and what the page says of it."""
    name: str
    series: Series
    folder: Path = None  # of its curves, of where it is held and loaded, and of its record; None: there are none
    group: str = ""  # under which it is offered
    labels: list = None  # of the frames, in place of times
    is_static: bool = False  # times are load factors
    is_shape: bool = False  # displacements are shapes of modes, whose size means nothing
    facts: tuple = ()  # lines about it


@dataclass(frozen=True)
class Source:
    """What a folder holds for a view: never nothing."""
    kind: str
    items: list
    start: dict  # with what the page begins if nothing else is said: panes (indices of items), time, color, scale, rest
    every: int = 1  # every so many frames make a page that is not too large


def name_of(folder):
    return folder.resolve().name or str(folder)
