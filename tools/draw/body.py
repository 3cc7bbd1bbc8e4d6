"""Paints a body into 2D axes: shaded front faces and lines, back to front."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from .split import split_for

FEW_FACES = 4000  # mesh edges are drawn as well for at most this number of faces
INK = np.array([0.13, 0.14, 0.17])


class Paint:
    """Triangles and segments with their depths, drawn in the order of depth."""

    def __init__(self):
        self._shapes = []

    def add(self, outline, depth, face_rgb, edge_rgb, width):
        """Adds triangles, `outline` (k,3,2). A segment is a triangle whose last two corners coincide."""
        k = len(outline)
        rgb = [np.broadcast_to(c, (k, 3)) for c in (face_rgb, edge_rgb)]
        self._shapes.append((outline, depth, *rgb, np.broadcast_to(width, k)))

    def add_segments(self, start, end, depth, rgb, width):
        self.add(np.stack([start, end, end], axis=1), depth, rgb, rgb, width)

    def draw(self, axes):
        outline, depth, face, edge, width = (np.concatenate(part) for part in zip(*self._shapes))
        order = np.argsort(depth, kind="stable")
        axes.add_collection(PolyCollection(outline[order], facecolors=face[order], edgecolors=edge[order],
                                           linewidths=width[order], joinstyle="round", zorder=2), autolim=False)


def front_faces(surface, flat):
    a, b, c = (flat[surface.faces[:, k]] for k in range(3))
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]) > 0


def outline_edges(surface, front):
    """(f,3): whether an edge of a face is drawn in the outline: the face is visible, and the edge is sharp or borders
    on an invisible face."""
    hidden = (surface.neighbour < 0) | ~front[surface.neighbour]
    return front[:, None] & (surface.sharp | hidden)


def add_body(paint, surface, points, values, colouring, camera, budget):
    """Adds faces and edges of the body at `points`; `values` (f,3) at the face corners."""
    split = split_for(len(surface.faces), budget)
    front = front_faces(surface, camera.flat(points))
    corners = points[surface.faces[front]]
    small = np.einsum("sk,fkx->fsx", split.nodes, corners)
    flat = camera.flat(small)
    depth = camera.depth(np.einsum("sk,fkx->fsx", split.centres, corners))
    normal = np.einsum("sk,fkx->fsx", split.centres, surface.corner_normals(points)[front])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True) + 1e-300
    rgb = colouring(values[front] @ split.centres.T) * camera.shade(normal)[..., None]
    paint.add(flat[:, split.triangles].reshape(-1, 3, 2), depth.ravel(), rgb.reshape(-1, 3), rgb.reshape(-1, 3), 0.4)

    outline = outline_edges(surface, front)[front]
    size = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).max(axis=1)[:, None] / split.n
    nearer = _nearer(surface, front, camera.depth(points), split.n) + 0.15 * size
    for e, rows in enumerate(split.edges):
        owner, start, end = rows.T
        inner = ~outline[:, e] & surface.of_cell[front, e]
        for chosen, darkness, width in ((inner, 0.16, 0.35), (outline[:, e], 0.72, 0.9)):
            if width < 0.5 and len(surface.faces) > FEW_FACES:
                continue
            ink = (1 - darkness) * rgb[chosen][:, owner] + darkness * INK
            paint.add_segments(flat[chosen][:, start].reshape(-1, 2), flat[chosen][:, end].reshape(-1, 2),
                               (depth[:, owner] + nearer[:, e, None])[chosen].ravel(), ink.reshape(-1, 3), width)


def _nearer(surface, front, depth, n):
    """How far the edges (v,3) of the visible faces are moved towards the eye: as far as the small triangle of the
    neighbour at the edge can be nearer than the edge. Otherwise this triangle would be drawn later and cover half of
    the line's width. An edge that is moved farther would show through a thin part in front of it."""
    start, end = surface.faces, np.roll(surface.faces, -1, axis=1)
    opposite = surface.faces[surface.neighbour].sum(axis=-1) - start - end
    is_seen = (surface.neighbour >= 0) & front[surface.neighbour]
    apex = depth[np.where(is_seen, opposite, 0)]
    return np.where(is_seen, np.maximum(apex - (depth[start] + depth[end]) / 2, 0) / n, 0)[front]


def draw_ghost(axes, surface, rest, camera):
    """Draws the outline of the rest shape behind the body, and faintly in front of it."""
    flat = camera.flat(rest)
    edge = outline_edges(surface, front_faces(surface, flat))
    ends = np.stack([surface.faces, np.roll(surface.faces, -1, axis=1)], axis=-1)[edge]
    segments = flat[np.unique(np.sort(ends, axis=1), axis=0)]
    for zorder, alpha in ((1, 1.0), (3, 0.2)):
        axes.add_collection(LineCollection(segments, colors="#8b93a1", linewidths=0.7, alpha=alpha,
                                           capstyle="butt", zorder=zorder), autolim=False)
