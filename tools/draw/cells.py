"""Splits the cells of a VTU file into linear tetrahedra, which is how they are drawn.

A quadratic tetrahedron becomes eight. Hexahedra and wedges are cut into tetrahedra with a common apex. Quadratic ones
first lose a tetrahedron at each corner; their mid-edge nodes then span a body of triangles and quadrilaterals. Each
quadrilateral is cut from its node with the smallest number, so that both cells at a face cut it alike. Nodes in the
middle of faces and cells are not drawn.
"""
import numpy as np

TET_PARTS = ((0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3), (6, 8, 4, 5), (6, 8, 5, 9), (6, 8, 9, 7),
             (6, 8, 7, 4))
# Number of corners, edges in the order of their middles, and faces by their corners, as in VTK.
TETRAHEDRON = (4, ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), ())
HEXAHEDRON = (8, ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
              ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)))
WEDGE = (6, ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
         ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)))
# VTK type: number of nodes, number of corners
SIZES = {10: (4, 4), 12: (8, 8), 13: (6, 6), 24: (10, 4), 25: (20, 8), 26: (15, 6), 29: (27, 8), 32: (18, 6)}
NAMES = "tetrahedra (VTK types 10, 24), hexahedra (12, 25, 29) and wedges (13, 26, 32)"


def _topology(kind):
    corners = SIZES[kind][1]
    return {4: TETRAHEDRON, 6: WEDGE, 8: HEXAHEDRON}[corners]


def edges_of(kind, cells):
    """Edges (m,2) of cells (c,k) of one VTK type; an edge with a middle consists of its two halves."""
    corners, edges, _ = _topology(kind)
    pairs = np.array(edges)
    if SIZES[kind][0] > corners:
        middles = corners + np.arange(len(edges))
        pairs = np.concatenate([np.column_stack([pairs[:, end], middles]) for end in (0, 1)])
    return cells[:, pairs].reshape(-1, 2)


def tets_of(kind, cells):
    """Tets (m,4) of cells (c,k) of one VTK type, and for each tet the row of its cell (m,)."""
    if kind == 10:
        return cells, np.arange(len(cells))
    if kind == 24:
        return cells[:, TET_PARTS].reshape(-1, 4), np.repeat(np.arange(len(cells)), len(TET_PARTS))
    corners, edges, faces = _topology(kind)
    rows, cut = [], list(faces)  # the faces of the body with a common apex
    if kind in (12, 13):
        apex = cells.min(axis=1)
    else:
        middle = {frozenset(edge): corners + k for k, edge in enumerate(edges)}
        at_corners = [[m for edge, m in middle.items() if corner in edge] for corner in range(corners)]
        rows = [(np.arange(len(cells)), cells[:, [corner, *nodes]]) for corner, nodes in enumerate(at_corners)]
        cut = at_corners + [[middle[frozenset((face[k - 1], face[k]))] for k in range(len(face))] for face in faces]
        apex = cells[:, corners:corners + len(edges)].min(axis=1)
    triangles = [face for face in cut if len(face) == 3]
    squares = [face for face in cut if len(face) == 4]

    for triangle in triangles:
        nodes = cells[:, triangle]
        keep = (nodes != apex[:, None]).all(axis=1)
        rows.append((np.flatnonzero(keep), np.column_stack([apex, nodes])[keep]))
    for square in squares:
        nodes = cells[:, square]
        keep = (nodes != apex[:, None]).all(axis=1)
        turn = (np.argmin(nodes, axis=1)[:, None] + np.arange(4)) % 4
        nodes = np.take_along_axis(nodes, turn, axis=1)
        for half in ([0, 1, 2], [0, 2, 3]):
            rows.append((np.flatnonzero(keep), np.column_stack([apex, nodes[:, half]])[keep]))
    owner = np.concatenate([own for own, _ in rows])
    order = np.argsort(owner, kind="stable")
    return np.concatenate([tets for _, tets in rows])[order], owner[order]
