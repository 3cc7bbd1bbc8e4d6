"""Material axes as strokes that move with the faces on which they lie."""
import numpy as np

from ..grain import Grain
from ..surface import area_vectors

COUNT = 2500  # approximate number of strokes on a flat surface


def strokes(skin, frame, points, field):
    """For each stroke its face (s,), and the barycentric coordinates of its two ends in the face (s,2,3)."""
    area = 0.5 * np.linalg.norm(area_vectors(points[skin.faces]), axis=1).sum()
    grain = Grain(skin.surface, points, np.sqrt(area / COUNT))
    corners = points[skin.faces[grain.face]]
    return grain.face, np.stack([_barycentric(corners, end) for end in grain.ends(frame, points, field)], axis=1)


def _barycentric(corners, points):
    """Barycentric coordinates of points in the planes of triangles. The points may lie outside the triangles."""
    a, b, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], points - corners[:, 0]
    aa, ab, bb, av, bv = (np.einsum("ix,ix->i", x, y) for x, y in ((a, a), (a, b), (b, b), (a, v), (b, v)))
    determinant = np.maximum(aa * bb - ab * ab, 1e-300)
    second, third = (bb * av - ab * bv) / determinant, (aa * bv - ab * av) / determinant
    return np.stack([1 - second - third, second, third], axis=1)
