"""Material axis 1 as short strokes on the surface, or as dots on end grain."""
import numpy as np

from .body import INK
from .errors import unknown
from .split import split_for
from .surface import area_vectors, unit

FIELD = "material_axis_1"
SPACING = 0.115  # inches on the page
GRAZING = 0.18  # cosine between a face's normal and the line of sight, below which it has no strokes
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
PALE = np.array([0.96, 0.96, 0.94])


class Grain:
    """Strokes are placed once in the rest shape and move with the material."""

    def __init__(self, surface, rest, spacing):
        """`spacing` of the strokes in m."""
        self.surface, self.spacing = surface, spacing
        centres = split_for(len(surface.faces), 40000).centres
        places = np.einsum("sk,fkx->fsx", centres, rest[surface.faces]).reshape(-1, 3)
        thinned = self._thinned(places)
        self.face, self.weights = thinned // len(centres), centres[thinned % len(centres)]

    def _thinned(self, places):
        """Indices of places, at most one in each box of the size `spacing`. Repeated for several shifts of the boxes,
        so that few strokes touch. The order is shuffled, always in the same way, so that no rows appear."""
        random = np.random.default_rng(1)
        kept = random.permutation(len(places))
        for shift in random.random((5, 3)):
            boxes = np.floor(places[kept] / self.spacing + shift).astype(np.int64)
            kept = kept[np.unique(boxes, axis=0, return_index=True)[1]]
        return kept

    def add(self, paint, frame, points, values, colouring, camera):
        """Adds strokes that stand out from the colours of `values` (f,3), which are given at the faces' corners."""
        if FIELD not in frame.cell_fields:
            raise unknown("field", FIELD, [*frame.node_fields, *frame.cell_fields])
        seen = self._well_seen(points, camera)[self.face]
        face, weights = self.face[seen], self.weights[seen]
        corners = points[self.surface.faces[face]]
        place = np.einsum("ik,ikx->ix", weights, corners)
        longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).max(axis=1)
        depth = camera.depth(place) + self.spacing + longest  # in front of the faces it spans and their edges
        behind = colouring(np.einsum("ik,ik->i", weights, values[face]))
        ink = np.where((behind @ LUMINANCE < 0.5)[:, None], PALE, INK)
        ends = self.ends(frame, points)[:, seen]
        paint.add_segments(*(camera.flat(end) for end in ends), depth, ink, 0.7)

    def ends(self, frame, points, field=FIELD):
        """Both ends (2,s,3) of all strokes along the axes of a field."""
        corners = points[self.surface.faces[self.face]]
        axis = unit(frame.cell_fields[field][self.surface.cell[self.face]].astype(float))
        normal = unit(area_vectors(corners))
        along = axis - np.einsum("ix,ix->i", axis, normal)[:, None] * normal
        half = 0.5 * self.spacing * np.maximum(np.linalg.norm(along, axis=1), 0.02)
        along = unit(along) * half[:, None]
        place = np.einsum("ik,ikx->ix", self.weights, corners)
        return np.stack([place + self._reach(self.face, self.weights, corners, step)[:, None] * step
                         for step in (along, -along)])

    def _well_seen(self, points, camera):
        normal = unit(area_vectors(points[self.surface.faces]))
        return camera.depth(normal) > GRAZING

    def _reach(self, face, weights, corners, step):
        """The fraction of `step`, at most 1, that does not cross a sharp edge of the face."""
        edges = corners[:, 1:] - corners[:, :1]
        gram = np.einsum("iax,ibx->iab", edges, edges)
        side = np.einsum("iax,ix->ia", edges, step)
        determinant = np.maximum(gram[:, 0, 0] * gram[:, 1, 1] - gram[:, 0, 1] ** 2, 1e-300)
        second = (gram[:, 1, 1] * side[:, 0] - gram[:, 0, 1] * side[:, 1]) / determinant
        third = (gram[:, 0, 0] * side[:, 1] - gram[:, 0, 1] * side[:, 0]) / determinant
        rate = np.stack([-second - third, second, third], axis=1)
        opposite_sharp = self.surface.sharp[face][:, [1, 2, 0]]
        limit = np.where(opposite_sharp & (rate < 0), 0.92 * weights / np.maximum(-rate, 1e-300), 1.0)
        return np.minimum(limit.min(axis=1), 1.0)
