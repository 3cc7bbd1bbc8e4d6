"""tools/draw modes: draws modes that deform the body, with their frequencies; errors are one line."""
import contextlib
import io
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

from draw.cli import main  # noqa: E402
from draw.modes import Picture, Shapes, factor_label, faint_nodes, frequency_label, read_modes  # noqa: E402
from draw.scene import PictureSpec  # noqa: E402
from tiny_result import POINTS, Vtu  # noqa: E402


def write_modes(folder, hertz):
    (folder / "modes").mkdir(parents=True)
    sets = ""
    for k in range(len(hertz)):
        name = f"modes/mode_{k + 1:03d}.vtu"
        shape = np.roll(POINTS, k, axis=1)
        (folder / name).write_bytes(Vtu().content({"shape": shape, "displacement": 0 * POINTS}, {}))
        sets += f'<DataSet timestep="{k + 1}" file="{name}"/>'
    (folder / "modes.pvd").write_text(f'<VTKFile type="Collection"><Collection>{sets}</Collection></VTKFile>')
    rows = "\n".join(f"{k + 1},{f}" for k, f in enumerate(hertz))
    (folder / "modes.csv").write_text(f"mode,frequency [Hz]\n{rows}\n")
    return folder


class Modes(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory())) / "out"

    def draw(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["modes", str(self.folder), *arguments])
        return code, out.getvalue().splitlines(), err.getvalue().splitlines()

    def test_a_picture_stands_beside_the_table(self):
        write_modes(self.folder, [0, 0, 12.5, 1250.0])
        code, out, err = self.draw()
        self.assertEqual((code, out, err), (0, [str(self.folder / "modes.png")], []))
        self.assertGreater(np.ptp(np.asarray(Image.open(out[0]).convert("L"))), 50)

    def test_shapes_are_read_as_what_moves_the_body(self):
        write_modes(self.folder, [1.0, 2.0])
        np.testing.assert_array_equal(Shapes(self.folder).frame(1).node_fields["displacement"], np.roll(POINTS, 1, axis=1))
        self.assertEqual(read_modes(self.folder), ([1.0, 2.0], ["1 Hz", "2 Hz"]))

    def test_signs_tell_what_moves_against_the_largest(self):
        folder = write_modes(self.folder, [1.0])
        shape = np.zeros_like(POINTS)
        shape[:, 2] = [0.2, -1, 0.5, 0, 0.3]
        (folder / "modes/mode_001.vtu").write_bytes(Vtu().content({"shape": shape}, {}))
        swing = Shapes(folder).frame(0).node_fields["swing"][:, 0]
        np.testing.assert_allclose(swing, [-0.2, 1, -0.5, 0, -0.3], atol=1e-12)

    def test_nodal_lines_are_where_the_sign_changes(self):
        folder = write_modes(self.folder, [1.0])
        shape = np.zeros_like(POINTS)
        shape[:, 0] = POINTS[:, 2] - 0.25  # a plane across the body
        (folder / "modes/mode_001.vtu").write_bytes(Vtu().content({"shape": shape}, {}))
        series, drawn = Shapes(folder), []
        picture = Picture(series, [0], PictureSpec(color="swing"))
        frame = series.frame(0)

        class Lines:
            def add_segments(self, start, end, *_):
                drawn.append((start, end))
        picture.add_lines(Lines(), frame.points, picture.corner_values(frame))
        height = picture.camera.flat(np.array([[0, 0, 0.25], [1, 0, 0.25], [0, 1, 0.25]]))
        (start, end), = drawn
        for ends in (start, end):  # in the plane z = 1/4, seen by the camera
            share = np.linalg.lstsq((height[1:] - height[0]).T, (ends - height[0]).T, rcond=None)[0]
            np.testing.assert_allclose(height[0] + (share.T @ (height[1:] - height[0])), ends, atol=1e-9)

    def lines_of(self, values):
        """Number of faces of a plate with a nodal line; `values` at the grid nodes, rows along y."""
        faces, n = [], values.shape[1]
        for j in range(values.shape[0] - 1):
            for i in range(n - 1):
                a = j * n + i
                faces += [[a, a + 1, a + n], [a + 1, a + n + 1, a + n]]
        faces, flat = np.array(faces), values.ravel()
        crossed = (flat[faces].min(axis=1) < 0) & (flat[faces].max(axis=1) > 0)
        return int(crossed.sum()), int((crossed & ~faint_nodes(faces, flat)[faces].any(axis=1)).sum())

    def test_a_corner_that_hardly_moves_has_no_nodal_line(self):
        x, y = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 9))
        plate = (np.sin(np.pi * x) * np.sin(np.pi * y)) ** 2  # clamped all around
        plate[1, 1] = plate[-2, -2] = -0.002
        plate[1, 2] *= -0.01
        every, drawn = self.lines_of(plate)
        self.assertGreater(every, 5)
        self.assertEqual(drawn, 0)

    def test_a_nodal_line_reaches_to_where_the_body_is_held_also_on_a_fine_mesh(self):
        """Values next to the line are below 2 % of the largest on both sides."""
        x, y = np.meshgrid(np.linspace(0, 1, 202), np.linspace(0, 1, 9))
        plate = np.sin(2 * np.pi * x) * np.sin(np.pi * y) ** 2
        self.assertLess(abs(plate[:, 100:102]).max(), 0.02)
        plate[:, [0, -1]] = plate[[0, -1]] = 0  # exactly
        every, drawn = self.lines_of(plate)
        self.assertEqual(every, 14)  # of the eight rows of two faces, those with corners of both signs
        self.assertEqual(drawn, every)

    def test_the_picture_has_no_line_around_a_part_that_hardly_moves(self):
        folder = write_modes(self.folder, [1.0])
        for least, expected in ((-0.5, True), (-0.01, False)):
            shape = np.zeros_like(POINTS)
            shape[:, 0] = [1, 1, 1, least, 1]
            (folder / "modes/mode_001.vtu").write_bytes(Vtu().content({"shape": shape}, {}))
            series, drawn = Shapes(folder), []
            picture = Picture(series, [0], PictureSpec(color="swing"))
            lines = unittest.mock.Mock(add_segments=lambda start, *_: drawn.extend(start))
            picture.add_lines(lines, POINTS, picture.corner_values(series.frame(0)))
            self.assertEqual(bool(drawn), expected)

    def test_labels_are_short(self):
        self.assertEqual([frequency_label(f) for f in (12.5, 1299.0381, -3.0)], ["12.5 Hz", "1.299 kHz", "-3 Hz"])
        self.assertEqual([frequency_label(1299.0381, e) for e in (0.3, 0.01, 1e-4, 0.0)],
                         ["1.3 kHz", "1.30 kHz", "1.299 kHz", "1.299 kHz"])

    def test_what_is_missing_is_said_in_one_line(self):
        write_modes(self.folder, [0, 0])
        self.assertIn("all 2 modes are rigid; compute more with -n", self.draw()[2][0])
        (self.folder / "modes.csv").write_text("mode,frequency [Hz]\n1,2\n")
        self.assertIn("have different modes", self.draw()[2][0])
        (self.folder / "modes.pvd").unlink()
        code, _, err = self.draw()
        self.assertEqual((code, len(err)), (2, 1))


if __name__ == "__main__":
    unittest.main()
