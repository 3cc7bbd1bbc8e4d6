"""The data in the page of a 3D view equals that of the frames.

Run with  /usr/bin/python3 -m unittest tests/draw/test_view.py  (Debian's numpy, matplotlib).
"""
import json
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

from folder_test import TOOLS  # noqa: E402
from tiny_result import POINTS, Vtu, fields_at, write_result  # noqa: E402
from view_page import OfAResult, page, unpacked, values_of  # noqa: E402

from draw.view.blocks import Blocks  # noqa: E402
from draw.view.bundle import digest  # noqa: E402
from draw.view.collect import Extent  # noqa: E402
from draw.view.skin import Skin  # noqa: E402
from draw.vtu import Frame  # noqa: E402


class InBlocks(unittest.TestCase):
    def kept(self, kind, array):
        blocks = Blocks()
        blocks.add("x", kind, array)
        return values_of(unpacked(blocks.text())["x"])

    def test_displacements_are_kept_to_a_part_in_130000_of_their_range(self):
        array = np.random.default_rng(1).uniform(-3, 5, (400, 3)) * [1, 1e-9, 1e6]
        error = np.abs(self.kept("linear", array) - array).max(axis=0)
        self.assertTrue((error <= np.ptp(array, axis=0) / 65535 * 0.5001).all())

    def test_fields_are_kept_to_three_digits_over_seven_decades(self):
        array = np.concatenate([s * 10.0 ** np.linspace(2, 9, 500) for s in (1, -1)])[:, None]
        self.assertLess(np.abs(self.kept("half", array) / array - 1).max(), 5e-4)

    def test_nothing_is_kept_too(self):
        blocks = Blocks()
        blocks.add("x", "u32", np.zeros((0, 2), int))
        self.assertEqual(unpacked(blocks.text())["x"], ({"kind": "u32", "components": 2}, b""))

    def test_what_differs_little_from_one_is_kept_to_three_digits_of_that(self):
        array = 1 + np.array([[2e-5], [-1.97e-5], [0.0]])
        blocks = Blocks()
        blocks.add("x", "half", array, offset=1.0)
        np.testing.assert_allclose(values_of(unpacked(blocks.text())["x"]) - 1, array - 1, atol=1e-8)

    def test_what_is_not_a_number_stays_so(self):
        kept = self.kept("half", np.array([[np.nan], [1.0], [0.0]]))
        self.assertTrue(np.isnan(kept[0, 0]) and kept[1, 0] == 1 and kept[2, 0] == 0)

    def test_what_never_changes_has_no_step(self):
        self.assertTrue((self.kept("linear", np.full((5, 3), 7.25)) == 7.25).all())


def box_frame():
    """A cube of five tets."""
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    tets = np.array([[0, 3, 5, 6], [1, 0, 3, 5], [2, 0, 3, 6], [4, 0, 5, 6], [7, 3, 5, 6]])
    return Frame(points, tets)


class ASkin(unittest.TestCase):
    def test_of_a_cube_has_a_normal_for_each_face_at_each_corner(self):
        skin = Skin(box_frame())
        self.assertEqual((len(skin.faces), skin.normal.max() + 1), (12, 24))
        self.assertEqual((len(skin.edges), len(skin.creases)), (18, 12))

    def test_of_quadratic_cells_shows_no_edge_between_the_parts_of_a_face(self):
        middles = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        points = np.concatenate([corners, [0.5 * (corners[a] + corners[b]) for a, b in middles]])
        from draw.cells import TET_PARTS
        skin = Skin(Frame(points, np.array(TET_PARTS), cell_of=np.zeros(8, int), cells=np.arange(10)[None],
                          cell_types=np.array([24])))
        self.assertEqual((len(skin.faces), len(skin.edges)), (16, 12))
        self.assertEqual(set(skin.cell), {0})


    def test_of_hexahedra_and_wedges_has_the_edges_of_these(self):
        from draw.cells import tets_of
        cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
        wedge = cube[[0, 1, 3, 4, 5, 7]]
        for kind, points, edges, volume in ((12, cube, 12, 1), (13, wedge, 9, 0.5)):
            cells = np.random.default_rng(3).permutation(len(points))[None]
            tets, row = tets_of(kind, cells)
            at = np.empty_like(points)
            at[cells[0]] = points
            p = at[tets]
            volumes = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
            self.assertAlmostEqual(np.abs(volumes).sum(), volume)
            skin = Skin(Frame(at, tets, cell_of=row, cells=cells, cell_types=np.array([kind])))
            self.assertEqual(len(skin.edges), edges)


class APage(OfAResult):
    def test_holds_the_values_of_each_frame(self):
        blocks = unpacked(self.page())
        for k, t in enumerate(self.times):
            node, cell = fields_at(t)
            for name, array, tolerance in (("displacement", node["displacement"], 1e-5), ("stress", cell["stress"], 5e-4),
                                           ("det_f", cell["det_f"], 5e-4)):
                kept = values_of(blocks[f"r0/{name}/{k}"])
                np.testing.assert_allclose(kept, array, rtol=tolerance, atol=tolerance * 1e-2)

    def test_holds_a_field_once_that_never_changes(self):
        blocks = unpacked(self.page())
        self.assertIn("r0/region/0", blocks)
        self.assertNotIn("r0/region/1", blocks)

    def test_holds_all_frames_of_a_field_that_comes_back(self):
        for k, values in enumerate((1, 1, 9, 1)):
            node, cell = fields_at(self.times[k])
            (self.result / f"frames/frame_{k:05d}.vtu").write_bytes(Vtu().content(node, {"det_f": np.full((2, 1), float(values))}))
        text = self.page()
        self.assertEqual(values_of(unpacked(text)["r0/det_f/2"]).max(), 9)
        described = json.loads(re.search(r'id="description">(.*?)</script>', text).group(1))
        self.assertEqual(described["results"][0]["reach"][1], (2 * POINTS - 0.5).max(axis=0).tolist())

    def test_holds_what_is_inside_only_where_it_is_asked_for(self):
        self.assertNotIn("r0/tets", unpacked(self.page()))
        self.assertEqual(len(values_of(unpacked(self.page(volume=True))["r0/tets"])), 2)

    def test_holds_the_fields_and_frames_that_are_asked_for(self):
        blocks = unpacked(self.page(fields=("det_f",), every=2))
        self.assertEqual({name.split("/")[1] for name in blocks if re.search(r"/\d+$", name)}, {"displacement", "det_f"})
        self.assertIn("r0/det_f/2", blocks)  # the last frame, though it is none of the second ones
        self.assertNotIn("r0/det_f/3", blocks)

    def test_has_the_curves_of_all_tables(self):
        name = "d tip.displacement.z / d materials.m.young"
        (self.result / "sensitivities.csv").write_text(f"t [s],{name} [m / SI unit]\n0,0\n1,-2e-9\n")
        text = self.page()
        described = json.loads(re.search(r'id="description">(.*?)</script>', text).group(1))
        curves = described["results"][0]["curves"]
        self.assertEqual({curve["table"] for curve in curves}, {"probes", "energy", "momentum", "sensitivities"})
        self.assertIn({"table": "sensitivities", "column": 1, "name": name, "unit": "m / SI unit"}, curves)
        np.testing.assert_allclose(values_of(unpacked(text)["r0/sensitivities.csv"]), [[0, 0], [1, -2e-9]])

    def test_shows_where_the_body_is_held_and_loaded(self):
        held, load = np.zeros((5, 3)), np.zeros((5, 3))
        held[1], load[4, 2] = 1, -3
        (self.result / "setup.vtu").write_bytes(Vtu().content({"held": held, "load": load}, {}))
        blocks = unpacked(self.page())
        self.assertEqual(values_of(blocks["r0/held"]).tolist(), [[1]])
        self.assertEqual(values_of(blocks["r0/load_values"]).tolist(), [[0, 0, -3]])

    def test_holds_the_same_mesh_once(self):
        text = page(3 * [self.result], Extent())
        self.assertEqual(set(re.findall(r'id="(r[12]/rest)" data-same="([^"]*)"', text)), {("r1/rest", "r0/rest"), ("r2/rest", "r0/rest")})

    def test_of_an_unknown_field_is_refused(self):
        self.fails_with("no field 'strss'; did you mean 'stress'", "view", self.result, "--fields", "strss")

    def test_is_written_beside_the_frames(self):
        code, out, err = self.run_draw("view", self.result)
        self.assertEqual((code, out, err), (0, [str(self.result / "view.html")], []))

    def test_does_not_run_what_a_name_holds(self):
        evil = write_result(self.folder / "<script>alert(1)<", self.times)
        self.assertNotIn("<script>alert", page([evil], Extent()))


class ThePageOfTheReadme(unittest.TestCase):
    def test_has_the_bundle_of_the_sources(self):
        text = (TOOLS.parent / "docs/results/cantilever_view.html").read_text(encoding="utf-8")
        self.assertIn(f"/* sources {digest()}", text)


class TheBundle(unittest.TestCase):
    def test_is_that_of_the_sources(self):
        """`npm run bundle` writes the digest of the sources it was made of."""
        bundle = (TOOLS / "draw/view/viewer.js").read_text(encoding="utf-8")
        self.assertIn(digest(), bundle[:200], "tools/draw/view/web/src was changed: npm run bundle")
        self.assertIn("MIT", bundle[:3000])


if __name__ == "__main__":
    unittest.main()
