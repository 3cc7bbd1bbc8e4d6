"""What a view shows: items, which are series of frames, from the sources that the user names."""
from dataclasses import dataclass
from pathlib import Path

from ..series import Series


@dataclass(frozen=True)
class Item:
    """A series of frames with its description on the page."""
    name: str
    series: Series
    folder: Path = None  # contains tables of curves, setup.vtu and run.json; None if there are none
    group: str = ""  # heading in the list of items
    labels: list = None  # labels of the frames that replace times
    is_static: bool = False  # whether times are load factors
    is_shape: bool = False  # whether displacements are mode shapes of arbitrary size
    facts: tuple = ()  # lines of text about the item


@dataclass(frozen=True)
class Source:
    """The items of a result folder, at least one."""
    folder: Path
    kind: str
    items: list
    start: dict  # defaults of the page: panes (indices of items), time, color, scale, rest
    every: int = 1  # default of Extent.every, chosen to limit the size of the page


def name_of(folder):
    return folder.resolve().name or str(folder)
