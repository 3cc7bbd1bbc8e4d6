"""tools/draw: readers give exact values, pictures show the deformed boundary, errors are one line.

Run with  /usr/bin/python3 -m unittest tests/draw/test_draw.py  (Debian's numpy, matplotlib, PIL).
"""
import contextlib
import io
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

from draw import animation, picture  # noqa: E402
from draw.body import front_faces  # noqa: E402
from draw.camera import Camera  # noqa: E402
from draw.chart import spread  # noqa: E402
from draw.cli import main  # noqa: E402
from draw.colouring import Colouring  # noqa: E402
from draw.errors import DrawError  # noqa: E402
from draw.grain import Grain  # noqa: E402
from draw.quantity import find_quantity, magnitude, von_mises  # noqa: E402
from draw.scene import Scene, Wish  # noqa: E402
from draw.series import Series  # noqa: E402
from draw.split import Split  # noqa: E402
from draw.surface import Surface, area_vectors, boundary_faces  # noqa: E402
from draw.table import Table  # noqa: E402
from draw.units import length_label, prefix, round_length, time_labels  # noqa: E402
from draw.vtu import read_vtu  # noqa: E402
from tiny_result import POINTS, TETS, Vtu, fields_at, write_curves, write_result  # noqa: E402


class InAFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def run_draw(self, *arguments):
        """Exit code, lines on stdout, lines on stderr."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([str(a) for a in arguments])
        return code, out.getvalue().splitlines(), err.getvalue().splitlines()

    def fails_with(self, pattern, *arguments):
        code, _, err = self.run_draw(*arguments)
        self.assertEqual((code, len(err)), (2, 1), err)
        self.assertRegex(err[0], pattern)


class Reading(InAFolder):
    def read(self, content):
        path = self.folder / "frame.vtu"
        path.write_bytes(content)
        return read_vtu(path)

    def test_every_layout_of_the_arrays_gives_the_exact_values(self):
        node, cell = fields_at(1 / 3)
        for options in ({}, {"index": "i4"}, {"header": "<I"}, {"form": "ascii"}):
            with self.subTest(**options):
                frame = self.read(Vtu(**options).content(node, cell))
                np.testing.assert_array_equal(frame.points, POINTS)
                np.testing.assert_array_equal(frame.tets, TETS)
                for wanted, found in ((node, frame.node_fields), (cell, frame.cell_fields)):
                    self.assertEqual(list(wanted), list(found))
                    for name in wanted:
                        np.testing.assert_array_equal(found[name], wanted[name])

    def test_a_file_cut_off_anywhere_is_damaged_and_says_so(self):
        content = Vtu().content(*fields_at(0))
        data = content.index(b"_", content.index(b"<AppendedData")) + 1
        end = content.index(b"</AppendedData>")
        for size in (0, 20, data // 2, data, data + 7, data + 60, (data + end) // 2, end - 1):
            with self.subTest(size=size), self.assertRaisesRegex(DrawError, "frame.vtu: .*(cut off|not readable)"):
                self.read(content[:size])

    def test_a_wrong_count_of_values_names_the_array(self):
        node, cell = fields_at(0)
        node["velocity"] = node["velocity"][:3]
        with self.assertRaisesRegex(DrawError, "array 'velocity' has 9 values where 5 x 3 belong"):
            self.read(Vtu().content(node, cell))

    def test_other_cells_and_points_out_of_range_are_refused(self):
        with self.assertRaisesRegex(DrawError, r"VTK type \[12\]"):
            self.read(Vtu().content({}, {}, types=12))
        with self.assertRaisesRegex(DrawError, "names point 9, but there are 5"):
            self.read(Vtu(tets=np.array([[0, 1, 2, 9]])).content({}, {}))

    def test_frames_are_in_the_order_of_their_times(self):
        series = Series(write_result(self.folder / "r", [0.0, 0.5, 1.0, 4.0]))
        self.assertEqual(series.index_at(0.7), 1)
        self.assertEqual(series.index_at(99), 3)
        self.assertEqual(series.evenly(3), [0, 2, 3])
        self.assertEqual(series.evenly(9), [0, 1, 2, 3])
        self.assertEqual(series.checked_index(-1), 3)

    def test_a_table_has_names_units_and_values(self):
        path = self.folder / "energy.csv"
        path.write_text("t [s], kinetic [J],order\n0,1.5,2\n1,,3\n2,7")
        table = Table(path)
        self.assertEqual([(c.name, c.unit) for c in table.columns.values()],
                         [("t", "s"), ("kinetic", "J"), ("order", "")])
        np.testing.assert_array_equal(table["kinetic"].values, [1.5, np.nan])
        path.write_text("t [s],kinetic [J]\n0,1\n1,x\n2,3\n")
        with self.assertRaisesRegex(DrawError, "energy.csv:3: .*'x'"):
            Table(path)


class Shape(unittest.TestCase):
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


class Quantities(InAFolder):
    def setUp(self):
        super().setUp()
        self.series = Series(write_result(self.folder / "r", [0.0, 1.0]))
        self.frame = self.series.frame(1)

    def test_von_mises_is_that_of_the_deviator_in_every_frame(self):
        s = np.random.default_rng(0).normal(size=(20, 6))
        full = np.stack([s[:, [0, 3, 5]], s[:, [3, 1, 4]], s[:, [5, 4, 2]]], axis=1)
        deviator = full - np.trace(full, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
        np.testing.assert_allclose(von_mises(s), np.sqrt(1.5 * (deviator ** 2).sum(axis=(1, 2))))
        np.testing.assert_allclose(magnitude(s), np.linalg.norm(full, axis=(1, 2)))
        np.testing.assert_allclose(von_mises(np.array([[3.0, 0, 0, 0, 0, 0], [0, 0, 0, 2, 0, 0], [5, 5, 5, 0, 0, 0]])),
                                   [3, 2 * np.sqrt(3), 0])

    def test_a_name_finds_its_component(self):
        for text, wanted in (("displacement.y", POINTS[:, 1]), ("displacement", np.linalg.norm(POINTS, axis=1)),
                             ("stress.xy", [0, 4e6]), ("stress", [6e6, 4e6 * np.sqrt(3)]), ("det_f", [8, 8]),
                             (None, [6e6, 4e6 * np.sqrt(3)])):
            with self.subTest(text=text):
                np.testing.assert_allclose(find_quantity(text, self.frame).values(self.frame), wanted)

    def test_an_unknown_name_lists_what_there_is_and_the_nearest(self):
        with self.assertRaisesRegex(DrawError, r"no field 'stres'; did you mean 'stress'\? \(present: .*displacement"):
            find_quantity("stres.xx", self.frame)
        with self.assertRaisesRegex(DrawError, "component of stress 'yx'.*xx, yy, zz, xy, yz, zx, mag.*von_mises"):
            find_quantity("stress.yx", self.frame)

    def test_a_colour_range_is_symmetric_about_the_neutral_value(self):
        signed, ratio = find_quantity("stress.xx", self.frame), find_quantity("det_f", self.frame)
        norm = Colouring(signed, [np.array([-1e6, 3e6])]).norm
        self.assertAlmostEqual(norm.vmin, -norm.vmax)
        norm = Colouring(ratio, [np.array([0.5, 1.2])]).norm
        self.assertAlmostEqual(norm.vmin + norm.vmax, 2)

    def test_cells_that_are_not_a_number_keep_their_own_colour(self):
        colouring = Colouring(find_quantity("stress", self.frame), [np.array([np.nan, 1e6, 2e6])])
        self.assertTrue(colouring.has_nan)
        red, green, blue = colouring(np.array([np.nan]))[0]
        self.assertTrue(red > 0.85 and green < 0.1 and blue < 0.6)


class Scenes(InAFolder):
    def setUp(self):
        super().setUp()
        self.series = Series(write_result(self.folder / "r", [0.0, 0.5, 1.0]))

    def test_the_displacement_is_added_to_the_rest_positions(self):
        for scale in (1.0, 3.0):
            scene = Scene(self.series, [2], Wish(scale=scale))
            np.testing.assert_allclose(scene.positions(self.series.frame(2)), (1 + scale) * POINTS)

    def test_window_and_colours_hold_every_frame(self):
        scene = Scene(self.series, [0, 1, 2], Wish())
        widest = Scene(self.series, [2], Wish()).window
        np.testing.assert_allclose(scene.window.high, widest.high)
        self.assertAlmostEqual(scene.colouring.norm.vmax, 4 * np.sqrt(3), places=1)  # MPa, at the last frame
        self.assertLess(scene.colouring.norm.vmin, 3.1)  # MPa, at the first

    def test_the_body_is_drawn_where_it_is_and_nowhere_else(self):
        path = self.folder / "r/frames/frame_00000.vtu"
        path.write_bytes(Vtu(tets=TETS[:1]).content({"displacement": 0 * POINTS}, {}))
        series = Series(self.folder / "r")
        scene = Scene(series, [0], Wish(view=(0, 0)))  # along x: the triangle below the diagonal of a square
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
        scene = Scene(Series(self.folder / "r"), [0], Wish("displacement"))
        camera, strokes = Camera(180, 0), []  # sees the face x = 0, y to the left

        class Recorder:
            def add_segments(self, start, end, *_):
                strokes.extend(zip(start, end))

        frame = scene.series.frame(0)
        values = np.zeros((len(scene.surface.faces), 3))
        Grain(scene.surface, POINTS, 1.5).add(Recorder(), frame, POINTS, values, scene.colouring, camera)
        self.assertGreater(len(strokes), 2)
        for start, end in strokes:
            step = (end - start) / np.linalg.norm(end - start)
            np.testing.assert_allclose(np.abs(step @ [-0.6, 0.8]), 1)
            for left, z in (start, end):
                self.assertTrue(left < 0 < z and z - left < 1)


class Commands(InAFolder):
    def setUp(self):
        super().setUp()
        self.result = write_result(self.folder / "r", [0.0, 0.25, 0.5, 0.75, 1.0])
        write_curves(self.result)

    def picture(self, *arguments):
        code, out, err = self.run_draw(*arguments)
        self.assertEqual((code, err), (0, []))
        with Image.open(out[-1]) as image:
            pixels = np.asarray(image.convert("RGB"))
        self.assertGreater(len(np.unique(pixels.reshape(-1, 3), axis=0)), 20)
        return Path(out[-1]), pixels.shape[1::-1]

    def test_a_frame_has_the_size_asked_for(self):
        path, size = self.picture("frame", self.result, "--time", 0.6, "--size", "800x600", "--grain", "--ghost")
        self.assertEqual(size, (800, 600))
        self.assertEqual(path, self.result / "pictures" / "frame_00002.png")

    def test_every_quantity_can_be_drawn_from_every_side(self):
        for k, color in enumerate(("displacement.x", "velocity", "region", "det_f", "stress.zz", "material_axis_1")):
            with self.subTest(color=color):
                view = f"{60 * k - 180},{30 * k - 90}"
                out = self.folder / "one.png"
                self.picture("frame", self.result, "--color", color, "--view", view, "--out", out, "--scale", 2)

    def test_a_strip_is_ten_inches_wide(self):
        self.assertEqual(self.picture("strip", self.result, "--times", "0,0.5,1")[1][0], 2000)

    def test_an_animation_has_every_kth_frame(self):
        for every, count in ((1, 5), (2, 3)):
            path, _ = self.picture("animate", self.result, "--every", every, "--out", self.folder / f"{every}.gif")
            with Image.open(path) as image:
                self.assertEqual((image.n_frames, image.format), (count, "GIF"))
                image.seek(count - 1)
                self.assertEqual(image.convert("RGB").getpixel((2, 2)), (255, 255, 255))

    def test_an_animation_shrinks_until_it_fits(self):
        scene = Scene(Series(self.result), range(5), Wish())
        full = animation.draw_animation(scene, range(5), self.folder / "a.gif")
        limit = 0.5e-6 * full.stat().st_size
        small = animation.draw_animation(scene, range(5), self.folder / "b.gif", most_megabytes=limit)
        self.assertLessEqual(small.stat().st_size, 1e6 * limit)
        with Image.open(small) as shrunk, Image.open(full) as large:
            self.assertLess(shrunk.size, large.size)
            self.assertEqual(shrunk.n_frames, 5)

    def test_curves_are_eight_inches_wide(self):
        for kind in ("energy", "steps", "probes", "momentum"):
            with self.subTest(kind=kind):
                self.assertEqual(self.picture(kind, self.result)[1][0], 1600)

    def test_all_writes_what_the_folder_has_and_names_it(self):
        (self.result / "momentum.csv").unlink()
        code, out, err = self.run_draw("all", self.result)
        self.assertEqual((code, err), (0, []))
        self.assertEqual([Path(p).name for p in out],
                         ["strip.png", "animation.gif", "energy.png", "steps.png", "probes.png"])
        self.assertTrue(all(Path(p).stat().st_size > 1000 for p in out))


class Failures(InAFolder):
    def setUp(self):
        super().setUp()
        self.result = write_result(self.folder / "r", [0.0, 1.0])

    def test_a_missing_folder_or_file_is_named(self):
        self.fails_with("nowhere: no such result folder", "frame", self.folder / "nowhere")
        self.fails_with("energy.csv: missing", "energy", self.result)
        self.fails_with("neither frames.pvd nor any of energy.csv", "all", self.folder)
        self.fails_with("frames.pvd: missing", "strip", self.folder)
        (self.result / "frames/frame_00001.vtu").unlink()
        self.fails_with("frame_00001.vtu: No such file", "frame", self.result)

    def test_a_damaged_frame_is_named(self):
        path = self.result / "frames/frame_00001.vtu"
        path.write_bytes(path.read_bytes()[:-100])
        self.fails_with("frame_00001.vtu: .*cut off", "animate", self.result)

    def test_an_unknown_field_or_frame_or_command_says_what_there_is(self):
        self.fails_with("no field 'displacment'; did you mean 'displacement'",
                        "frame", self.result, "--color", "displacment")
        self.fails_with(r"no frame 7; there are 2 frames \(0 to 1\)", "frame", self.result, "--index", 7)
        self.fails_with("invalid choice: 'fram'", "fram", self.result)
        self.fails_with("'1;2' should be 2 numbers", "frame", self.result, "--view", "1;2")

    def test_grain_without_material_axes_is_refused(self):
        (self.result / "frames/frame_00001.vtu").write_bytes(Vtu().content({"displacement": POINTS}, {}))
        self.fails_with("no field 'material_axis_1'.*present: displacement", "frame", self.result, "--grain")

    def test_a_run_that_diverged_is_no_traceback(self):
        node, cell = fields_at(0)
        node["displacement"] = np.full((5, 3), np.nan)
        (self.result / "frames/frame_00001.vtu").write_bytes(Vtu().content(node, cell))
        self.fails_with("has diverged", "frame", self.result)

    def test_the_program_itself_exits_with_two_and_helps_with_examples(self):
        program = str(TOOLS / "draw" / "draw")
        failed = subprocess.run([program, "frame", "nowhere"], capture_output=True, text=True)
        self.assertEqual((failed.returncode, failed.stdout), (2, ""))
        self.assertRegex(failed.stderr, r"\Adraw: nowhere: .*\n\Z")
        helped = subprocess.run([program, "--help"], capture_output=True, text=True)
        self.assertEqual(helped.returncode, 0)
        self.assertIn("draw strip out/beam", helped.stdout)


class Words(unittest.TestCase):
    def test_prefixes_and_lengths_are_round(self):
        self.assertEqual(prefix("Pa", 2.5e6), (1e6, "MPa"))
        self.assertEqual(prefix("s", 5000), (1.0, "s"))
        self.assertEqual(prefix("kg m/s", 5000), (1.0, "kg m/s"))
        self.assertEqual([round_length(x) for x in (0.9, 1.0, 3.4, 70)], [0.5, 1, 2, 50])
        self.assertEqual([length_label(x) for x in (0.02, 0.5, 2, 5000)], ["20 mm", "50 cm", "2 m", "5 km"])

    def test_times_can_be_told_apart(self):
        self.assertEqual(time_labels([0, 0.5, 1]), ["t = 0.0 s", "t = 0.5 s", "t = 1.0 s"])
        self.assertEqual(time_labels([0, 1e-3, 2.25e-3]), ["t = 0.00 ms", "t = 1.00 ms", "t = 2.25 ms"])
        labels = time_labels(list(np.linspace(0, 1, 61)))
        self.assertEqual(len(set(labels)), 61)
        self.assertTrue(all(re.fullmatch(r"t = \d\.\d{3,4} s", label) for label in labels))

    def test_names_of_curves_are_moved_apart_and_keep_their_order(self):
        np.testing.assert_allclose(spread([0.5, 0.5, 0.9], 0.1), [0.45, 0.55, 0.9])
        placed = spread(np.array([0.3, 0.1, 0.32, 0.31]), 0.1)
        self.assertTrue((np.diff(np.sort(placed)) > 0.1 - 1e-12).all())
        self.assertEqual(np.argsort(placed).tolist(), [1, 0, 3, 2])


if __name__ == "__main__":
    unittest.main()
