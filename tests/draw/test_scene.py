"""tools/draw: bodies are drawn at their deformed positions, with a common window and colour range.

Run with  /usr/bin/python3 -m unittest tests/draw/test_scene.py  (Debian's numpy, matplotlib, PIL).
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

from folder_test import InAFolder  # noqa: E402
from tiny_result import POINTS, TETS, Vtu, write_result  # noqa: E402

from draw import picture  # noqa: E402
from draw.camera import Camera  # noqa: E402
from draw.grain import Grain  # noqa: E402
from draw.scene import PictureSpec, Scene  # noqa: E402
from draw.series import Series  # noqa: E402


class Scenes(InAFolder):
    def setUp(self):
        super().setUp()
        self.series = Series(write_result(self.folder / "r", [0.0, 0.5, 1.0]))

    def test_the_displacement_is_added_to_the_rest_positions(self):
        for scale in (1.0, 3.0):
            scene = Scene(self.series, [2], PictureSpec(scale=scale))
            np.testing.assert_allclose(scene.positions(self.series.frame(2)), (1 + scale) * POINTS)

    def test_window_and_colours_hold_every_frame(self):
        scene = Scene(self.series, [0, 1, 2], PictureSpec())
        widest = Scene(self.series, [2], PictureSpec()).window
        np.testing.assert_allclose(scene.window.high, widest.high)
        self.assertAlmostEqual(scene.colouring.norm.vmax, 4 * np.sqrt(3), places=1)  # MPa, at the last frame
        self.assertLess(scene.colouring.norm.vmin, 3.1)  # MPa, at the first

    def test_the_body_is_drawn_where_it_is_and_nowhere_else(self):
        path = self.folder / "r/frames/frame_00000.vtu"
        path.write_bytes(Vtu(tets=TETS[:1]).content({"displacement": 0 * POINTS}, {}))
        series = Series(self.folder / "r")
        scene = Scene(series, [0], PictureSpec(view=(0, 0)))  # along x: the triangle below the diagonal of a square
        figure = picture.frame_figure(scene, 0)
        figure.set_dpi(50)
        figure.canvas.draw()
        axes = figure.axes[1]
        pixels = np.asarray(figure.canvas.buffer_rgba())[..., :3]
        picture.pyplot.close(figure)

        def colour_at(y, z):
            column, row = axes.transData.transform((y, z))
            return pixels[len(pixels) - 1 - int(row), int(column)]

        for inside in ((0.3, 0.2), (0.1, 0.8), (0.8, 0.1)):
            self.assertLess(colour_at(*inside).min(), 230)
        for outside in ((0.95, 0.2), (0.2, 0.95), (0.55, 0.55)):
            self.assertEqual(colour_at(*outside).min(), 255)

    def test_grain_strokes_run_along_the_axis_and_stay_within_sharp_edges(self):
        path = self.folder / "r/frames/frame_00000.vtu"
        axis = {"material_axis_1": np.array([[0, 0.6, 0.8]])}
        path.write_bytes(Vtu(tets=TETS[:1]).content({"displacement": 0 * POINTS}, axis))
        scene = Scene(Series(self.folder / "r"), [0], PictureSpec("displacement"))
        camera, strokes = Camera(180, 0), []  # sees the face x = 0, y to the left

        class Recorder:
            def add_segments(self, start, end, *_):
                strokes.extend(zip(start, end))

        frame = scene.series.frame(0)
        values = np.zeros((len(scene.surface.faces), 3))
        Grain(scene.surface, POINTS, 0.17).add(Recorder(), frame, POINTS, values, scene.colouring, camera)
        self.assertGreater(len(strokes), 2)
        for start, end in strokes:
            step = (end - start) / np.linalg.norm(end - start)
            np.testing.assert_allclose(np.abs(step @ [-0.6, 0.8]), 1)
            for left, z in (start, end):
                self.assertTrue(left < 0 < z and z - left < 1)
