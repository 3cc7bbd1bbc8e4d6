"""tools/draw: each command writes its pictures; errors are one line.

Run with  /usr/bin/python3 -m unittest tests/draw/test_commands.py  (Debian's numpy, matplotlib, PIL).
"""
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

from folder_test import InAFolder, TOOLS  # noqa: E402
from tiny_result import POINTS, Vtu, fields_at, write_curves, write_result  # noqa: E402

from draw import animation  # noqa: E402
from draw.compare import _difference  # noqa: E402
from draw.curves import relative_drift  # noqa: E402
from draw.scene import PictureSpec, Scene  # noqa: E402
from draw.series import SMALL, Series  # noqa: E402
from draw.table import Table  # noqa: E402


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

    @unittest.skipUnless(os.environ.get("ORTHODYN_LONG"), "takes long; .ci/nightly runs it")
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
        scene = Scene(Series(self.result), range(5), PictureSpec())
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

    def test_the_drift_is_relative_to_the_largest_kinetic_or_elastic_energy(self):
        path = self.result / "energy.csv"
        path.write_text("t [s],kinetic [J],elastic [J],loads [J],balance [J]\n0,0,0,0,0\n1,1,2,10,-0.5\n2,1,1,10,0.1\n")
        self.assertEqual(relative_drift(Table(path)), 0.5 / 2)
        (self.result / "run.json").write_text('{"energy": {"balance_drift": 0.6, "scale": 3}}')
        self.assertEqual(relative_drift(Table(path)), 0.6 / 3)

    def test_all_writes_what_the_folder_has_and_names_it(self):
        (self.result / "momentum.csv").unlink()
        code, out, err = self.run_draw("all", self.result)
        self.assertEqual((code, err), (0, []))
        self.assertEqual([Path(p).name for p in out],
                         ["strip.png", "animation.gif", "energy.png", "steps.png", "probes.png"])
        self.assertTrue(all(Path(p).stat().st_size > 1000 for p in out))


class OfASmallMotion(InAFolder):
    """Two tets with an extent of 1 m and a largest displacement of 4 mm."""
    def setUp(self):
        super().setUp()
        times = [0.1 * k for k in range(11)]
        self.result = write_result(self.folder / "r", times)
        for k, _ in enumerate(times):
            node, cell = fields_at(0)
            node["displacement"] = np.zeros((5, 3))
            node["displacement"][4, 0] = 4e-3 if k == 3 else 1e-4 * (k % 2)
            (self.result / f"frames/frame_{k:05d}.vtu").write_bytes(Vtu().content(node, cell))

    def test_all_says_by_how_much_to_enlarge_it(self):
        code, _, err = self.run_draw("all", self.result)
        self.assertEqual((code, err), (0, ["draw: the largest motion is 0.4 % of the body: --scale 20 shows it"]))
        self.assertEqual(self.run_draw("all", self.result, "--scale", 20)[2], [])

    def test_a_strip_has_the_frame_of_the_largest_displacement(self):
        frames = Series(self.result)
        self.assertEqual(frames.evenly(6), [0, 2, 4, 6, 8, 10])
        self.assertIn(3, frames.telling(6))
        self.assertEqual((len(frames.telling(6)), frames.telling(6)[0], frames.telling(6)[-1]), (6, 0, 10))
        self.assertEqual(frames.telling(2), [0, 10])


class OfStatics(InAFolder):
    """A static analysis: load_factor instead of t."""
    def setUp(self):
        super().setUp()
        self.result = write_result(self.folder / "s", [0.0, 0.25, 1.0])
        (self.result / "run.json").write_text('{"analysis": "static"}')
        (self.result / "probes.csv").write_text("load_factor,tip.displacement.x [m],tip.displacement.z [m]\n"
                                                "0,0,0\n0.25,1e-4,-2e-3\n1,2e-4,-4e-3\n")
        (self.result / "load_steps.csv").write_text("load_factor,newton_iterations,largest_displacement [m]\n"
                                                    "0,0,0\n0.25,3,2e-3\n1,4,4e-3\n")

    def test_all_draws_frames_and_the_load_over_the_displacement(self):
        code, out, err = self.run_draw("all", self.result)
        self.assertEqual((code, err), (0, []))
        self.assertEqual([Path(p).name for p in out], ["strip.png", "animation.gif", "probes.png", "load.png"])

    def test_frames_are_those_of_load_factors(self):
        scene = Scene(Series(self.result), [0, 1, 2], PictureSpec())
        self.assertEqual(scene.labels, {0: "load factor 0.00", 1: "load factor 0.25", 2: "load factor 1.00"})

    def test_the_largest_displacement_stands_in_for_probes(self):
        (self.result / "probes.csv").unlink()
        self.assertEqual(self.run_draw("load", self.result)[0], 0)
        (self.result / "load_steps.csv").unlink()
        self.fails_with("no displacements in probes.csv or load_steps.csv", "load", self.result)


class Comparisons(InAFolder):
    def setUp(self):
        super().setUp()
        self.results = [write_result(self.folder / name, [0.0, 1.0]) for name in "ab"]
        for result in self.results:
            write_curves(result)

    def test_two_results_are_drawn_over_each_other(self):
        code, out, err = self.run_draw("compare", *self.results)
        self.assertEqual((code, err), (0, []))
        self.assertEqual([Path(p).name for p in out], ["compare_probes.png", "compare_energy.png"])
        self.assertEqual(Path(out[0]).parent, self.results[1] / "pictures")

    def test_their_difference_is_that_of_the_curves(self):
        tables = []
        for result, last in zip(self.results, (2.0, 1.5)):
            (result / "probes.csv").write_text(f"t [s],tip.displacement.x [m]\n0,0\n1,{last}\n")
            tables.append(Table(result / "probes.csv"))
        self.assertAlmostEqual(_difference(tables, 1, ["tip.displacement.x"]), 0.25)

    def test_what_cannot_be_compared_is_refused(self):
        self.fails_with("2 to 4 results, found 1", "compare", self.results[0])
        for name in ("probes", "energy"):
            (self.results[1] / f"{name}.csv").unlink()
        self.fails_with("none of the files probes.csv, energy.csv is in all of", "compare", *self.results)
        (self.results[1] / "probes.csv").write_text("load_factor,tip.displacement.x [m]\n0,0\n1,1\n")
        self.fails_with("static", "compare", *self.results)


class Failures(InAFolder):
    def setUp(self):
        super().setUp()
        self.result = write_result(self.folder / "r", [0.0, 1.0])

    def test_a_missing_folder_or_file_is_named(self):
        self.fails_with("nowhere: no such result folder", "frame", self.folder / "nowhere")
        self.fails_with("energy.csv: missing", "energy", self.result)
        self.fails_with("neither frames.pvd nor any of energy.csv", "all", self.folder)
        for analysis, instead in (("static", "draw load"), ("buckling", "draw modes"), ("harmonic", "draw response")):
            (self.result / "run.json").write_text(f'{{"analysis": "{analysis}"}}')
            self.fails_with(f"no energy over time: a {analysis} analysis has no motion", "energy", self.result)
            self.fails_with(instead, "energy", self.result)
        (self.result / "run.json").unlink()
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
        self.fails_with("'1;2' is not 2 numbers", "frame", self.result, "--view", "1;2")

    def test_a_time_outside_of_the_run_is_refused_with_its_span(self):
        self.fails_with("no frame at the time 50 s; its frames are from 0 to 1 s", "frame", self.result, "--time", 50)
        self.fails_with("no frame at the time -1 s", "strip", self.result, "--times", "-1,0.5")

    def test_a_motion_has_no_load_path(self):
        write_curves(self.result)
        (self.result / "run.json").write_text('{"status": "completed"}')
        self.fails_with("not a static analysis; draw its probes", "load", self.result)
        (self.result / "run.json").unlink()
        self.fails_with("is it a static analysis", "load", self.result)

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

    def test_the_help_of_view_says_that_small_deflections_are_enlarged(self):
        helped = subprocess.run([TOOLS / "draw/draw", "view", "--help"], capture_output=True, text=True, check=True)
        self.assertIn(f"more if displacements are below {100 * SMALL:g} % of the body's size",
                      " ".join(helped.stdout.split()))
