"""The section of a body of tets by a plane: polygons inside, lines where it cuts the surface."""
import numpy as np


class Section:
    """The cut of a body by a plane: `triangles` (k,3,3) and the tets in which they lie, `cell` (k,); the segments of
    the `outline` (s,2,3) and the faces on which they lie, `face` (s,)."""

    def __init__(self, points, tets, surface, point, normal):
        normal = np.asarray(normal, float) / np.linalg.norm(normal)
        # The plane is moved by a little, so that no node lies on it.
        side = (points - point) @ normal + 1e-7 * np.linalg.norm(np.ptp(points, axis=0))
        self.triangles, self.cell = _cut_tets(points, tets, side)
        self.outline, self.face = _cut_faces(points, surface.faces, side)

    def find(self, flat_triangles, places):
        """For each of `places` (n,2): the index of a triangle (k,3,2) that contains the place, or -1."""
        a, b, c = (flat_triangles[:, i] for i in range(3))
        found = np.full(len(places), -1)
        for start in range(0, len(places), 256):
            p = places[start:start + 256, None]
            sides = np.stack([_turn(a, b, p), _turn(b, c, p), _turn(c, a, p)])
            inside = (sides >= 0).all(axis=0) | (sides <= 0).all(axis=0)
            found[start:start + 256] = np.where(inside.any(axis=1), inside.argmax(axis=1), -1)
        return found


def _turn(a, b, p):
    return (b[:, 0] - a[:, 0]) * (p[..., 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (p[..., 0] - a[:, 0])


def _between(points, side, one, other):
    """The points at which the edges from nodes `one` to `other` cross the plane."""
    t = side[one] / (side[one] - side[other])
    return points[one] + t[..., None] * (points[other] - points[one])


def _cut_tets(points, tets, side):
    above = side[tets] > 0
    order = np.argsort(~above, axis=1, kind="stable")  # nodes above come first
    sorted_tets, count = np.take_along_axis(tets, order, axis=1), above.sum(axis=1)
    triangles, cells = [], []

    def add(where, edges):
        n = sorted_tets[where]
        triangles.append(np.stack([_between(points, side, n[:, i], n[:, j]) for i, j in edges], axis=1))
        cells.append(where)

    one, two, three = (np.flatnonzero(count == k) for k in (1, 2, 3))
    add(one, [(0, 1), (0, 2), (0, 3)])
    add(three, [(0, 3), (1, 3), (2, 3)])
    add(two, [(0, 2), (0, 3), (1, 3)])
    add(two, [(0, 2), (1, 3), (1, 2)])
    return np.concatenate(triangles), np.concatenate(cells)


def _cut_faces(points, faces, side):
    above = side[faces] > 0
    count = above.sum(axis=1)
    lone = np.where(count == 1, above.argmax(axis=1), (~above).argmax(axis=1))  # the node that is alone on its side
    cut = np.flatnonzero((count == 1) | (count == 2))
    one, two, three = (faces[cut, (lone[cut] + k) % 3] for k in range(3))
    return np.stack([_between(points, side, one, two), _between(points, side, one, three)], axis=1), cut
