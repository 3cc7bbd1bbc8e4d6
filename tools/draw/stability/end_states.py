"""The last states of a case's trials, which are read, sorted into clusters and drawn as small pictures."""
from dataclasses import dataclass, replace

import numpy as np

from ..errors import DrawError
from ..scene import Scene, PictureSpec
from ..series import Series
from ..vtu import Frame, read_vtu
from .clusters import (EXPLODED, SAME, about_middle, are_apart, as_they_are, extent, same_states, turned_back,
                       usual_extent)

FILE = "end.vtu"
WELL = ("pass", "degraded")
COLOUR, RANGE = "det_f", (0.0, 2.0)
POINT = 1e-3  # fraction of the usual extent, below which a body is too small to draw
MANY = 4  # number of end states per variant, above which rotations are removed if that merges many states


@dataclass(frozen=True)
class State:
    trial: object
    frame: Frame
    positions: np.ndarray

    @property
    def inverted(self):
        """The number of elements that are flat or inside out."""
        volumes = self.frame.cell_fields.get(COLOUR)
        return 0 if volumes is None else int((volumes <= 0).sum())


@dataclass(frozen=True)
class Cluster:
    """Trials with the same end state. It is shown by the state of the `leader`, which is frame `index` of the case's
    scene."""
    trials: list
    leader: State
    index: int


class ClusterStates(Series):
    """The states of the clusters' leaders as a Series."""

    def __init__(self, folder, frames):
        self.folder, self._frames = folder, frames
        self.paths, self.times = [folder] * len(frames), [float(k) for k in range(len(frames))]

    def frame(self, index):
        return self._frames[index]


def _read(folder, trial):
    """The trial's State; None if the trial has no state that can be drawn."""
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
    return replace(state.frame, node_fields={"displacement": positions - state.frame.points})


def _of_one_mesh(states):
    """The states with the same mesh as the first one."""
    return [s for s in states if np.array_equal(s.frame.tets, states[0].frame.tets)
            and s.frame.points.shape == states[0].frame.points.shape]


class EndStates:
    """End states of a case, by variant: `clusters`; `exploded`, a list of (trial, extent / usual extent); and `absent`,
    the trials without a state."""

    def __init__(self, matrix, folder, case):
        trials = matrix.of(case=case.label)
        states = _of_one_mesh([s for s in (_read(folder, t) for t in trials) if s])
        self.size = self._size(states)
        near = [s for s in states if not self._is_exploded(s)]
        self.place = self._placing([[s for s in near if s.trial.variant == v] for v in matrix.variants])
        self._folder, self._frames, self._scene = folder, [], None
        drawable = {s.trial.index for s in states}
        self.clusters, self.exploded, self.absent = {}, {}, {}
        for v in matrix.variants:
            self.clusters[v] = self._clusters([s for s in near if s.trial.variant == v])
            self.exploded[v] = [(s.trial, extent(s.positions) / self.size) for s in states
                                if s.trial.variant == v and self._is_exploded(s)]
            self.absent[v] = [t for t in trials if t.variant == v and t.index not in drawable]

    @staticmethod
    def _size(states):
        return usual_extent(states[0].frame.points, [s.positions for s in states if s.trial.grade in WELL]) \
            if states else 1.0

    def _is_exploded(self, state):
        return not extent(state.positions) <= EXPLODED * self.size

    def _sorted(self, states, place):
        """The positions of each state, and lists of the states that are the same."""
        positions = [place(s.frame.points, s.positions) for s in states]
        return positions, same_states(positions, SAME * self.size)

    def _placing(self, groups):
        """How bodies are placed in pictures: unchanged, centred, or also rotated back if that merges many states."""
        near = [s.positions for states in groups for s in states]
        place = about_middle if near and are_apart(near, self.size) else as_they_are
        numbers = [[len(self._sorted(states, way)[1]) for states in groups] for way in (place, turned_back)]
        return turned_back if max(numbers[0]) > MANY and 2 * sum(numbers[1]) <= sum(numbers[0]) else place

    def _clusters(self, states):
        positions, lists = self._sorted(states, self.place)
        found = []
        for members in lists:
            leader = states[members[0]]
            found.append(Cluster([states[k].trial for k in members], leader, len(self._frames)))
            self._frames.append(_moved(leader, positions[members[0]]))
        return found

    def is_a_point(self, cluster):
        return extent(cluster.leader.positions) < POINT * self.size

    def series(self):
        """The states of the clusters, in the order of `clusters`."""
        return ClusterStates(self._folder, self._frames)

    def scene(self, indices):
        """The Scene of the case's clusters that are shown: one camera, window and colour range for all of them."""
        if self._scene is None:
            self._scene = Scene(self.series(), indices,
                                PictureSpec(color=COLOUR, limits=RANGE, ghost=True))
        return self._scene
