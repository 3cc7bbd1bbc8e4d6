"""The visible part of a mesh: faces, edges, and normals at corners, which differ across sharp edges."""
import numpy as np

from ..surface import Surface


class Skin:
    """Faces (f,3) of `points`, the cell of each face, edges of the mesh and sharp edges of the shape (e,2), and the
    index of each corner's normal (f,3). Corners at the same node have the same normal unless a sharp edge is between
    them."""

    def __init__(self, frame):
        surface = Surface(frame.points, frame.tets, frame.cell_edges())
        self.surface = surface
        self.faces = surface.faces
        self.cell = frame.cell_of[surface.cell]
        start, end = surface.faces.ravel(), np.roll(surface.faces, -1, axis=1).ravel()
        pairs = np.stack([np.minimum(start, end), np.maximum(start, end)], axis=1)
        self.edges = np.unique(pairs[surface.of_cell.ravel()], axis=0)
        self.creases = np.unique(pairs[surface.sharp.ravel()], axis=0)
        self.normal = _normals(surface)


def _normals(surface):
    """For each corner the index of its normal. Corners that are connected across edges that are not sharp share a
    normal."""
    face, edge = np.nonzero(~surface.sharp)
    other = surface.neighbour[face, edge]
    label = np.arange(surface.faces.size)
    links = []
    for end in (0, 1):  # end of the edge
        corner = 3 * face + (edge + end) % 3
        node = surface.faces.ravel()[corner]
        links.append((corner, 3 * other + np.argmax(surface.faces[other] == node[:, None], axis=1)))
    one, two = (np.concatenate(side) for side in zip(*links))
    while True:
        least = np.minimum(label[one], label[two])
        before = label.copy()
        np.minimum.at(label, one, least)
        np.minimum.at(label, two, least)
        if (label == before).all():
            return np.unique(label, return_inverse=True)[1].reshape(-1, 3)
