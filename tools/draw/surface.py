"""The boundary of a tet mesh: its faces, its sharp edges, and normals smoothed between them."""
import numpy as np

CREASE_COSINE = np.cos(np.radians(35))  # an edge is sharp if its faces meet at a larger angle (here 35 deg)
OUTWARD = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # faces of a tet with positive volume


def boundary_faces(points, tets):
    """Boundary faces (f,3), counter-clockwise seen from outside, and their tets (f,)."""
    p = points[tets]
    volume = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0])
    tets = np.where((volume < 0)[:, None], tets[:, [0, 2, 1, 3]], tets)
    faces = tets[:, OUTWARD].reshape(-1, 3)
    n = len(points)  # a face's key fits 64 bits for up to two million points
    a, b, c = np.sort(faces, axis=1).T.astype(np.int64)
    _, first, count = np.unique((a * n + b) * n + c, return_index=True, return_counts=True)
    once = np.sort(first[count == 1])
    return faces[once], once // 4


def area_vectors(corners):
    """Normals of triangles (f,3,3), with twice the area as length."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def unit(vectors):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


class Surface:
    """The boundary of a body. Sharp edges are those of the rest shape, so that edges do not flicker in time.

    Edge e of a face joins the face's corners e and e + 1. `of_cell` (f,3) tells which of them are among `cell_edges`
    (m,2); by default all.
    """

    def __init__(self, points, tets, cell_edges=None):
        self.num_points = len(points)
        self.faces, self.cell = boundary_faces(points, tets)
        self.nodes = np.unique(self.faces)
        normal = unit(area_vectors(points[self.faces]))
        self.neighbour = self._neighbours()  # (f,3); -1 unless there is exactly one
        across = np.einsum("fk,fek->fe", normal, normal[self.neighbour])
        self.sharp = (self.neighbour < 0) | (across < CREASE_COSINE)
        self._pairs = self._smooth_pairs(normal)
        keys = self._edge_keys()
        self.of_cell = (np.ones(len(keys), bool) if cell_edges is None else
                        np.isin(keys, self._key(cell_edges[:, 0], cell_edges[:, 1]))).reshape(-1, 3)

    def _key(self, start, end):
        return np.minimum(start, end) * self.num_points + np.maximum(start, end)

    def _edge_keys(self):
        return self._key(self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel())

    def _neighbours(self):
        key = self._edge_keys()
        order = np.argsort(key, kind="stable")
        _, first, count = np.unique(key[order], return_index=True, return_counts=True)
        neighbour = np.full(len(key), -1)
        one, two = order[first[count == 2]], order[first[count == 2] + 1]
        neighbour[one], neighbour[two] = two // 3, one // 3
        return neighbour.reshape(-1, 3)

    def _smooth_pairs(self, normal):
        """Pairs (corner, face): the faces over which the normal at each corner is averaged."""
        node = self.faces.ravel()
        order = np.argsort(node, kind="stable")
        _, group, count = np.unique(node, return_inverse=True, return_counts=True)
        start = np.concatenate([[0], np.cumsum(count)])[group]
        size = count[group]
        corner = np.repeat(np.arange(len(node)), size)
        within = np.arange(len(corner)) - np.repeat(np.cumsum(size) - size, size)
        face = order[np.repeat(start, size) + within] // 3
        smooth = np.einsum("ik,ik->i", normal[corner // 3], normal[face]) > CREASE_COSINE
        return corner[smooth], face[smooth]

    def corner_normals(self, points):
        """Unit normals (f,3,3) at the corners, averaged over faces that meet smoothly."""
        area = area_vectors(points[self.faces])
        corner, face = self._pairs
        size = 3 * len(self.faces)
        summed = np.stack([np.bincount(corner, area[face, k], size) for k in range(3)], axis=1)
        return unit(summed).reshape(-1, 3, 3)

    def corner_values(self, values, on_nodes):
        """Node or cell values (f,3) at the corners of the faces."""
        return values[self.faces] if on_nodes else np.repeat(values[self.cell][:, None], 3, axis=1)
