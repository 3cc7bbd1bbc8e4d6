"""The frames of a result folder, listed in its frames.pvd."""
import functools
import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

from . import units
from .errors import DrawError
from .vtu import read_vtu


def result_folder(name):
    folder = Path(name)
    if not folder.is_dir():
        raise DrawError(f"{folder}: no such result folder; `orthodyn run SCENE.yaml` writes one")
    return folder


def analysis(folder):
    """'static' or 'buckling' from run.json; '' for a motion or without run.json."""
    try:
        return json.loads((folder / "run.json").read_text(encoding="utf-8"))["analysis"]
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def is_static(folder):
    """Whether the times of frames and rows are load factors."""
    return analysis(folder) == "static"


MOST_LOOKS = 200  # largest number of frames that are searched for the largest displacement
SMALL, VISIBLE = 0.02, 0.1  # fractions of the body's extent: a motion below SMALL is magnified to VISIBLE


class Series:
    """Times and frames of a run; frames are read on demand."""

    def __init__(self, name, collection="frames.pvd"):
        self.folder = result_folder(name)
        listed = self._listed(self.folder / collection)
        self.times = np.array([t for t, _ in listed])
        self.paths = [path for _, path in listed]

    @staticmethod
    def _listed(pvd):
        if not pvd.is_file():
            raise DrawError(f"{pvd}: missing, so there are no frames to draw; does the scene's output write frames?")
        try:
            root = ElementTree.fromstring(pvd.read_bytes())
            listed = [(float(d.get("timestep")), pvd.parent / d.get("file")) for d in root.iter("DataSet")]
        except (ElementTree.ParseError, TypeError, ValueError) as error:
            raise DrawError(f"{pvd}: not readable as PVD ({error})") from None
        if not listed:
            raise DrawError(f"{pvd}: lists no frames")
        return sorted(listed, key=lambda entry: entry[0])

    def __len__(self):
        return len(self.paths)

    @functools.lru_cache(maxsize=8)
    def frame(self, index):
        return read_vtu(self.paths[index])

    def index_at(self, time):
        """Frame nearest to `time`."""
        return int(np.argmin(np.abs(self.times - time)))

    @functools.cached_property
    def peak(self):
        """(frame, displacement in m, extent of the body in m) of the largest displacement; (None, 0, extent) without one.
        Searches at most MOST_LOOKS frames."""
        best, largest = None, 0.0
        for index in range(0, len(self), -(-len(self) // MOST_LOOKS)):
            moved = read_vtu(self.paths[index]).node_fields.get("displacement")
            size = np.linalg.norm(moved, axis=1).max() if moved is not None and len(moved) else 0.0
            if np.isfinite(size) and size > largest:
                best, largest = index, float(size)
        return best, largest, float(np.ptp(self.frame(0).points, axis=0).max())

    @property
    def visible_scale(self):
        """Magnification for a motion too small to see; None if it is visible or zero."""
        _, largest, extent = self.peak
        return units.round_length(VISIBLE * extent / largest) if 0 < largest < SMALL * extent else None

    def telling(self, count):
        """As evenly(), but the frame with the largest displacement replaces the nearest inner frame."""
        chosen, (peak, _, _) = self.evenly(count), self.peak
        if peak is None or peak in chosen or len(chosen) < 3:
            return chosen
        given_up = min(chosen[1:-1], key=lambda k: abs(self.times[k] - self.times[peak]))
        return sorted({peak, *chosen} - {given_up})

    def asked_at(self, time):
        """Frame nearest to the user's `time`. Raises DrawError outside the span of the frames."""
        first, last = self.times[0], self.times[-1]
        room = 1e-6 * max(abs(first), abs(last))
        if not first - room <= time <= last + room:
            what = ("load factor", "") if is_static(self.folder) else ("time", " s")
            raise DrawError(f"{self.folder}: no frame at the {what[0]} {time:g}{what[1]}; its frames are from {first:g} to "
                            f"{last:g}{what[1]}")
        return self.index_at(time)

    def checked_index(self, index):
        """The index of a frame from 0; a negative `index` counts from the end. Raises DrawError if it is out of
        range."""
        if not -len(self) <= index < len(self):
            raise DrawError(f"{self.folder}: no frame {index}; there are {len(self)} frames (0 to {len(self) - 1})")
        return index % len(self)

    def evenly(self, count):
        """At most `count` frames, evenly spaced in time, including the first and the last."""
        times = np.linspace(self.times[0], self.times[-1], max(count, 1)) if count > 1 else self.times[-1:]
        return sorted({self.index_at(t) for t in times})
