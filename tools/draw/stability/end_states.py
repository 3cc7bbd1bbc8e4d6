"""The last states of a case's trials: read, sorted into clusters, drawn as small pictures."""
from dataclasses import dataclass

import numpy as np

from ..errors import DrawError
from ..scene import Scene, Wish
from ..series import Series
from ..vtu import Frame, read_vtu
from .clusters import EXPLODED, SAME, about_middle, are_apart, extent, same_states, usual_extent

FILE = "end.vtu"
WELL = ("pass", "degraded")
COLOUR, RANGE = "det_f", (0.0, 2.0)


@dataclass(frozen=True)
class State:
    trial: object
    frame: Frame
    positions: np.ndarray

    @property
    def inverted(self):
        """Number of elements without volume or turned inside out."""
        volumes = self.frame.cell_fields.get(COLOUR)
        return 0 if volumes is None else int((volumes <= 0).sum())


@dataclass(frozen=True)
class Cluster:
    """Trials that end in the same state, and which frame of the case's scene shows it."""
    trials: list
    inverted: int
    index: int


class Shown(Series):
    """The states that stand for clusters, as the frames of a series."""

    def __init__(self, folder, frames):
        self.folder, self._frames = folder, frames
        self.paths, self.times = [folder] * len(frames), [0.0] * len(frames)

    def frame(self, index):
        return self._frames[index]


def _read(folder, trial):
    """The trial's State; None where it left none, or none that can be drawn."""
    path = folder / trial.folder / FILE
    if not trial.folder or not path.is_file():
        return None
    try:
        frame = read_vtu(path)
    except DrawError:
        return None
    moved = frame.node_fields.get("displacement", np.zeros_like(frame.points))
    positions = frame.points + moved
    drawable = len(frame.tets) and COLOUR in frame.cell_fields and np.isfinite(positions).all()
    return State(trial, frame, positions) if drawable else None


def _moved(state, positions):
    """The state's frame with its nodes at `positions`."""
    return Frame(state.frame.points, state.frame.tets, {"displacement": positions - state.frame.points},
                 state.frame.cell_fields)


def _of_one_mesh(states):
    """Those with the mesh of the first."""
    return [s for s in states if np.array_equal(s.frame.tets, states[0].frame.tets)
            and s.frame.points.shape == states[0].frame.points.shape]


class EndStates:
    """Of one case. `clusters`, `exploded` [(trial, times the usual extent)] and `absent` trials, by variant."""

    def __init__(self, matrix, folder, case):
        trials = matrix.of(case=case.label)
        states = _of_one_mesh([s for s in (_read(folder, t) for t in trials) if s])
        self.size = self._size(states)
        near = [s for s in states if not self._is_exploded(s)]
        self.centred = bool(near) and are_apart([s.positions for s in near], self.size)
        self._folder, self._frames, self._scene = folder, [], None
        drawable = {s.trial.index for s in states}
        self.clusters, self.exploded, self.absent = {}, {}, {}
        for v in matrix.variants:
            self.clusters[v] = self._sorted([s for s in near if s.trial.variant == v])
            self.exploded[v] = [(s.trial, extent(s.positions) / self.size) for s in states
                                if s.trial.variant == v and self._is_exploded(s)]
            self.absent[v] = [t for t in trials if t.variant == v and t.index not in drawable]

    @staticmethod
    def _size(states):
        return usual_extent(states[0].frame.points, [s.positions for s in states if s.trial.grade in WELL]) \
            if states else 1.0

    def _is_exploded(self, state):
        return not extent(state.positions) <= EXPLODED * self.size

    def _sorted(self, states):
        positions = [about_middle(s.frame.points, s.positions) if self.centred else s.positions for s in states]
        found = []
        for members in same_states(positions, SAME * self.size):
            leader = members[0]
            found.append(Cluster([states[k].trial for k in members], states[leader].inverted, len(self._frames)))
            self._frames.append(_moved(states[leader], positions[leader]))
        return found

    def scene(self, indices):
        """One camera, window and range of colours for all clusters of the case that are shown."""
        if self._scene is None:
            self._scene = Scene(Shown(self._folder, self._frames), indices,
                                Wish(color=COLOUR, limits=RANGE, ghost=True))
        return self._scene
