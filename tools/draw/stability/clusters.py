"""Which end states are the same, which are apart, and which have left the neighbourhood of the body."""
import numpy as np

SAME = 0.02  # of the body's extent, the largest distance of a node
EXPLODED = 4.0  # times the extent that those have that did well
SPREAD = 2.5  # times the extent: bodies further apart are each drawn about their own middle


def extent(points):
    """Diagonal of the box around them."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def same_states(positions, distance):
    """Lists of indices: [n, 3] positions within `distance` of the first of their list; the most common state first.

    The first is the state with the most neighbours that are in no list yet.
    """
    near = np.array([[np.linalg.norm(a - b, axis=1).max() <= distance for b in positions] for a in positions])
    left, found = np.ones(len(positions), bool), []
    while left.any():
        votes = np.where(left, (near & left).sum(axis=1), -1)
        leader = int(np.argmax(votes))
        members = np.flatnonzero(near[leader] & left)
        found.append([leader, *(int(k) for k in members if k != leader)])
        left[members] = False
    return sorted(found, key=len, reverse=True)


def usual_extent(rest, well):
    """Of the rest shape, or of the states of those that did `well` where most of them are larger."""
    sizes = sorted(extent(x) for x in well)
    return max([extent(rest), *sizes[(len(sizes) - 1) // 2:][:1]])


def are_apart(positions, size):
    """Whether one window around all would make each of them small."""
    return extent(np.concatenate(positions)) > SPREAD * max(size, *(extent(x) for x in positions))


def as_they_are(rest, positions):
    return positions


def about_middle(rest, positions):
    """Moved so that its middle is that of the rest shape."""
    return positions - (positions.mean(axis=0) - rest.mean(axis=0))


def turned_back(rest, positions):
    """About its middle and turned onto the rest shape as well as can be (Kabsch 1976); mirror images stay mirrored."""
    middle = rest.mean(axis=0)
    u, _, v = np.linalg.svd((positions - positions.mean(axis=0)).T @ (rest - middle))
    u[:, -1] *= np.sign(np.linalg.det(u @ v))
    return (positions - positions.mean(axis=0)) @ (u @ v) + middle
