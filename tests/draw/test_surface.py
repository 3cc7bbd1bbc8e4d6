"""tools/draw: surface, splitting of faces, and camera.

Run with  /usr/bin/python3 -m unittest tests/draw/test_surface.py  (Debian's numpy, matplotlib, PIL).
"""
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

import folder_test  # noqa: E402,F401  (finds the package draw)
from tiny_result import POINTS, TETS  # noqa: E402

from draw.body import front_faces  # noqa: E402
from draw.camera import Camera  # noqa: E402
from draw.split import Split  # noqa: E402
from draw.surface import Surface, area_vectors, boundary_faces  # noqa: E402


class Surfaces(unittest.TestCase):
    def test_two_tets_have_six_boundary_faces_that_look_outward(self):
        faces, cells = boundary_faces(POINTS, TETS)
        self.assertEqual({frozenset(f) for f in faces.tolist()},
                         {frozenset(f) for f in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (4, 1, 2), (4, 1, 3), (4, 2, 3))})
        self.assertEqual(sorted(cells.tolist()), [0, 0, 0, 1, 1, 1])
        corners = POINTS[faces]
        outward = np.einsum("ij,ij->i", area_vectors(corners), corners.mean(axis=1) - POINTS.mean(axis=0))
        self.assertTrue((outward > 0).all())
        volume = np.einsum("ij,ij->i", area_vectors(corners), corners[:, 0]).sum() / 6  # divergence theorem
        self.assertAlmostEqual(volume, 1 / 6 + 1 / 3)

    def test_a_closed_surface_has_neighbours_everywhere_and_edges_where_it_is_sharp(self):
        surface = Surface(POINTS, TETS)
        self.assertTrue((surface.neighbour >= 0).all())
        for face, row in enumerate(surface.neighbour):
            for e, other in enumerate(row):
                shared = {surface.faces[face, e], surface.faces[face, (e + 1) % 3]}
                self.assertLessEqual(shared, set(surface.faces[other].tolist()))
        normal = area_vectors(POINTS[surface.faces])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        cosine = np.einsum("fk,fek->fe", normal, normal[surface.neighbour])
        np.testing.assert_array_equal(surface.sharp, np.degrees(np.arccos(cosine.clip(-1, 1))) > 35)

    def test_faces_in_front_are_those_whose_normals_point_to_the_eye(self):
        surface = Surface(POINTS, TETS)
        for view in ((-60, 20), (10, -70), (130, 5)):
            camera = Camera(*view)
            toward = camera.depth(area_vectors(POINTS[surface.faces])) > 0
            np.testing.assert_array_equal(front_faces(surface, camera.flat(POINTS)), toward)

    def test_split_triangles_fill_the_large_one(self):
        for n in (1, 2, 5):
            split = Split(n)
            self.assertEqual((len(split.triangles), split.edges.shape), (n * n, (3, n, 3)))
            area = np.linalg.det(split.nodes[split.triangles])  # of a barycentric triangle, relative
            np.testing.assert_allclose(area, 1 / n ** 2)

    def test_the_camera_looks_along_its_direction_with_z_up(self):
        camera = Camera(0, 0)  # the eye is on the x axis
        np.testing.assert_allclose(camera.flat(np.eye(3)), [[0, 0], [1, 0], [0, 1]], atol=1e-15)
        np.testing.assert_allclose(camera.depth(np.eye(3)), [1, 0, 0], atol=1e-15)
        camera = Camera(-60, 20)
        frame = np.array([camera.right, camera.up, camera.toward])
        np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-15)
        self.assertGreater(camera.up[2], 0)
