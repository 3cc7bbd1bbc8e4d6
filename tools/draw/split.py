"""Splits triangles evenly, so that on coarse meshes too colours blend and hidden parts are sorted correctly."""
import functools

import numpy as np


class Split:
    """A triangle whose edges are divided into n parts: n * n small triangles, in barycentric coordinates of the large
    one."""

    def __init__(self, n):
        self.n = n
        grid = [(i, j) for i in range(n + 1) for j in range(n + 1 - i)]
        at = {ij: k for k, ij in enumerate(grid)}
        self.nodes = np.array([((n - i - j) / n, i / n, j / n) for i, j in grid])
        up = [(at[i, j], at[i + 1, j], at[i, j + 1]) for i in range(n) for j in range(n - i)]
        down = [(at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]) for i in range(n) for j in range(n - i - 1)]
        self.triangles = np.array(up + down)
        self.centres = self.nodes[self.triangles].mean(axis=1)
        self.edges = self._edges()

    def _edges(self):
        """For each edge of the large triangle, the rows (small triangle, start node, end node)."""
        rows = []
        for e in range(3):
            off = self.nodes[:, (e + 2) % 3] < 1e-12
            rows.append([(t, tri[k], tri[(k + 1) % 3]) for t, tri in enumerate(self.triangles)
                         for k in range(3) if off[tri[k]] and off[tri[(k + 1) % 3]]])
        return np.array(rows)


@functools.lru_cache(maxsize=None)
def split_for(num_faces, budget):
    """The finest Split, with n from 1 to 8, for which all faces have at most `budget` small triangles together."""
    return Split(int(np.clip(np.sqrt(budget / max(num_faces, 1)), 1, 8)))
