"""Groups end states that are the same, and finds bodies that are exploded or far apart."""
import numpy as np

SAME = 0.02  # largest distance of a node between states of a cluster, as a fraction of the body's extent
EXPLODED = 4.0  # multiple of the usual extent above which a body counts as exploded
SPREAD = 2.5  # multiple of the extent; bodies further apart are each drawn about their own centre


def extent(points):
    """Diagonal of the bounding box."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def same_states(positions, distance):
    """Groups states whose nodes all lie within `distance` of those of the group's first state.

    `positions`: [n, 3] of each state. Returns lists of indices, the longest list first. Each list starts with the state
    that has the most neighbours not yet in a list.
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
    """The extent of the rest shape, or the median extent of the states `well` if that is larger."""
    sizes = sorted(extent(x) for x in well)
    return max([extent(rest), *sizes[(len(sizes) - 1) // 2:][:1]])


def are_apart(positions, size):
    """Whether the bodies are so far apart that each would be small in a common window."""
    return extent(np.concatenate(positions)) > SPREAD * max(size, *(extent(x) for x in positions))


def as_they_are(rest, positions):
    return positions


def about_middle(rest, positions):
    """Translated to the centre of the rest shape."""
    return positions - (positions.mean(axis=0) - rest.mean(axis=0))


def turned_back(rest, positions):
    """Translated and rotated onto the rest shape (Kabsch 1976), without reflection."""
    middle = rest.mean(axis=0)
    u, _, v = np.linalg.svd((positions - positions.mean(axis=0)).T @ (rest - middle))
    u[:, -1] *= np.sign(np.linalg.det(u @ v))
    return (positions - positions.mean(axis=0)) @ (u @ v) + middle
