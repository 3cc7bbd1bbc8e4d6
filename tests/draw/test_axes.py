"""tools/draw axes: sections are exact, strokes lie along the axes, errors are one line."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402
from PIL import Image  # noqa: E402

from draw.annotations import AXIS_COLOURS  # noqa: E402
from draw.axes import Axes, direction_colours  # noqa: E402
from draw.cli import main  # noqa: E402
from draw.slicing import Section  # noqa: E402
from draw.surface import Surface, area_vectors  # noqa: E402
from draw.vtu import Frame, read_vtu  # noqa: E402
from tiny_result import Vtu  # noqa: E402

CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
SIX = ((0, 4, 6, 7), (0, 6, 2, 7), (0, 2, 3, 7), (0, 3, 1, 7), (0, 1, 5, 7), (0, 5, 4, 7))


def bar(cells, size):
    """Points and tets of a bar of `cells` cubes along z, scaled to `size`."""
    points = np.concatenate([CORNERS + [0, 0, k] for k in range(cells)])
    tets = np.array([[8 * k + c for c in tet] for k in range(cells) for tet in SIX])
    points, inverse = np.unique(points, axis=0, return_inverse=True)
    return points / [1, 1, cells] * size, inverse.ravel()[tets]


def frame_of(points, tets, axis_1=(0, 0, 1), axis_2=(1, 0, 0)):
    fields = {f"axis_{k}": np.tile(np.array(a, float), (len(tets), 1)) for k, a in ((1, axis_1), (2, axis_2))}
    return Frame(points, tets, {}, fields)


class Slicing(unittest.TestCase):
    def section(self, point, normal, size=(1, 2, 3)):
        points, tets = bar(3, size)
        return Section(points, tets, Surface(points, tets), np.array(point, float), normal)

    def area(self, section):
        return np.linalg.norm(area_vectors(section.triangles), axis=1).sum() / 2

    def test_a_section_has_the_area_of_the_body_there(self):
        for point, normal, area in (((0, 0, 1.3), (0, 0, 1), 2), ((0.4, 0, 0), (2, 0, 0), 6), ((0, 1.9, 0), (0, -1, 0), 3),
                                    ((0.5, 1, 1.5), (1, 0, 1), 2 * np.sqrt(2))):
            with self.subTest(normal=normal):
                self.assertAlmostEqual(self.area(self.section(point, normal)), area, places=5)

    def test_a_plane_through_nodes_cuts_as_one_beside_them(self):
        self.assertAlmostEqual(self.area(self.section((0, 0, 1), (0, 0, 1))), 2, places=5)

    def test_its_outline_is_as_long_as_its_rim(self):
        outline = self.section((0, 0, 1.3), (0, 0, 1)).outline
        self.assertAlmostEqual(np.linalg.norm(outline[:, 1] - outline[:, 0], axis=1).sum(), 6, places=5)

    def test_a_section_beside_the_body_is_empty(self):
        section = self.section((0, 0, 9), (0, 0, 1))
        self.assertEqual((len(section.triangles), len(section.outline)), (0, 0))

    def test_a_place_is_found_in_the_tet_that_holds_it(self):
        section = self.section((0, 0, 1.3), (0, 0, 1))
        flat = section.triangles[:, :, :2]
        inside = flat.mean(axis=1)
        np.testing.assert_array_equal(section.find(flat, inside), np.arange(len(flat)))
        self.assertEqual(section.find(flat, np.array([[5.0, 5.0]]))[0], -1)


class Colours(unittest.TestCase):
    def test_a_coordinate_axis_has_its_colour_whichever_way_it_points(self):
        found = direction_colours(np.array([[1.0, 0, 0], [0, -3, 0], [0, 0, 1]]))
        np.testing.assert_allclose(found, [to_rgb(c) for c in AXIS_COLOURS])


class Pictures(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.file = Path(holder.name) / "axes.vtu"

    def write(self, fields=None, size=(1, 1, 3)):
        points, tets = bar(3, size)
        frame = frame_of(points, tets)
        self.file.write_bytes(Vtu(points, tets).content({}, frame.cell_fields if fields is None else fields))

    def run_draw(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["axes", str(self.file), *arguments])
        return code, out.getvalue().splitlines(), err.getvalue().splitlines()

    def test_bodies_of_any_shape_give_a_picture_beside_the_file(self):
        for size in ((1, 1, 3), (3, 1, 0.2), (1, 1, 1), (0.001, 1, 1), (1e-4, 1e-4, 1e-2)):
            with self.subTest(size=size):
                self.write(size=size)
                code, out, err = self.run_draw()
                self.assertEqual((code, err, out), (0, [], [str(self.file.with_suffix(".png"))]))
                with Image.open(out[0]) as picture:
                    self.assertLess(max(picture.size), 3400)
                    self.assertGreater(len(picture.convert("RGB").getcolors(1 << 24)), 50)

    def test_the_sections_are_across_the_longest_extent_and_the_shortest(self):
        self.write(size=(1, 3, 0.2))
        panels = Axes(self.file, read_vtu(self.file)).panels
        self.assertEqual([p.title for p in panels], ["surface", "section at z = 0.1 m", "section at y = 1.5 m"])

    def test_what_is_missing_is_said_in_one_line(self):
        self.write(fields={"axis_1": np.ones((18, 3))})
        self.assertRegex(" ".join(self.run_draw()[2]), "no field 'axis_2'.*present: axis_1")
        self.write()
        code, _, err = self.run_draw("--at", "9,0,0")
        self.assertEqual((code, len(err)), (2, 1))
        self.assertRegex(err[0], "outside of the body, which extends from 0,0,0 to 1,1,3 m")
        self.file.unlink()
        self.assertRegex(" ".join(self.run_draw()[2]), "No such file")


if __name__ == "__main__":
    unittest.main()
