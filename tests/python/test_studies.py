"""Studies as data frames equal the tables written by the program."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import matplotlib  # noqa: E402

matplotlib.use("Agg")

import orthodyn  # noqa: E402
from short_scene import beam  # noqa: E402


class AStudy(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(holder.name)
        Path("beam.yaml").write_text(orthodyn.Scene(beam()).to_yaml())

    def test_of_integrators_has_their_errors_and_times(self):
        study = orthodyn.compare({"title": "t", "scenes": ["beam.yaml"], "integrators": ["cvode_bdf", "tr_bdf2"],
                                  "tolerances": [1e-2, 1e-4]}, "c", quiet=True)
        self.assertEqual(len(study.table), 4)
        self.assertTrue((study.table["error.displacement.l2"] < 0.1).all())
        self.assertTrue(study.report.is_file())
        self.assertEqual(len(study.plot("wall.median [s]", "error.displacement.l2", "method", log=True).get_lines()), 2)
        self.assertFalse(list(Path().glob(".compare-*")))

    def test_has_a_folder_by_its_title(self):
        spec = {"scene": "beam.yaml", "vary": {"materials.wood.nu": [0.1, 0.2]},
                "quantities": {"lowest": {"quantity": "tip.displacement.z", "take": "min"}}}
        one, two = (orthodyn.sweep({"title": title, **spec}, quiet=True) for title in ("One sweep", "Another"))
        self.assertEqual((str(one.folder), str(two.folder)), ("out/sweeps/one_sweep", "out/sweeps/another"))

    def test_of_values_has_a_row_for_each(self):
        study = orthodyn.sweep({"title": "t", "scene": orthodyn.Scene(beam()), "vary": {"materials.wood.nu": [0.1, 0.2, 0.3]},
                                "quantities": {"lowest": {"quantity": "tip.displacement.z", "take": "min"}}}, "s", quiet=True)
        self.assertEqual(list(study.table["nu"]), [0.1, 0.2, 0.3])
        self.assertTrue((study.table["lowest [m]"] < 0).all())
        self.assertEqual(study.plot("nu", "lowest").get_ylabel(), "lowest [m]")
        with self.assertRaisesRegex(KeyError, "no column 'lowset'; there are point, nu, lowest"):
            study.plot("nu", "lowset")
        self.assertFalse(list(Path().glob(".sweep-*")))
        with self.assertRaisesRegex(ValueError, "no point has a frame; .*frames: {}"):
            study.view()

    def test_of_measured_values_has_a_row_for_each_parameter(self):
        scene = {"analysis": "static", "mesh": {"type": "box", "size": [0.5, 0.1, 0.2], "cells": [2, 1, 1], "order": 1},
                 "materials": {"m": {"type": "isotropic", "density": 1000, "young": "1 GPa", "nu": 0}},
                 "elasticity": {"kinematics": "linear"}, "clamps": [{"surface": "x0"}],
                 "loads": [{"surface": "x1", "force": [100, 0, 0]}], "output": {"probes": {"end": {"at": [0.5, 0, 0]}}}}
        study = orthodyn.fit({"title": "Bar", "experiments": {"bar": {"scene": orthodyn.Scene(scene), "measured": [
            {"quantity": "end.displacement.x", "value": "1.25 um", "deviation": "0.0125 um"}]}},
            "parameters": {"E": "materials.m.young"}}, quiet=True)
        row = study.table.iloc[0]
        self.assertEqual((row["parameter"], row["unit"]), ("E", "GPa"))
        self.assertAlmostEqual(row["value"], 2, places=6)  # F L / (A u) = 2 GPa, with 1 % like the deflection
        self.assertAlmostEqual(row["deviation"] / row["value"], 0.01, places=4)
        self.assertTrue(study.report.is_file())

    def test_that_kept_frames_has_a_view(self):
        study = orthodyn.compare({"title": "t", "scenes": [orthodyn.Scene(beam())], "integrators": ["cvode_bdf"],
                                  "tolerances": [1e-2], "repeats": 1, "frames": {"count": 3}}, "c", quiet=True)
        page = study.view()
        self.assertIn("difference from the reference", Path(page.path).read_text())
        self.assertIn('href="view.html"', study.report.read_text())

    @unittest.skipUnless(os.environ.get("ORTHODYN_LONG"), "takes long; .ci/nightly runs it")
    def test_of_a_scene_of_another_folder_finds_its_mesh(self):
        Path("there").mkdir()
        scenes = Path(__file__).resolve().parents[2] / "configs/scenes"
        Path("there/meshes").symlink_to(scenes / "meshes")
        Path("there/muscle.yaml").write_text((scenes / "muscle.yaml").read_text())
        scene = orthodyn.Scene.load("there/muscle.yaml").set("time.end", 0.001)
        study = orthodyn.compare({"title": "t", "scenes": [scene], "integrators": ["cvode_bdf"], "tolerances": [1e-2],
                                  "reference": {"integrator": {"type": "tr_bdf2", "rtol": 1e-3}}}, "c", quiet=True)
        self.assertEqual(list(study.table.status), ["completed"])
        self.assertEqual(list(study.table.problem), ["muscle"])

    def test_of_scenes_of_one_name_tells_them_apart(self):
        scene = orthodyn.Scene(beam(), "strip")
        study = orthodyn.compare({"title": "t", "scenes": [scene, scene.set("gravity.2", -5)], "integrators": ["cvode_bdf"],
                                  "tolerances": [1e-2], "reference": {"kind": "none"}, "repeats": 1}, "c", quiet=True)
        self.assertEqual(list(study.table.problem), ["strip", "strip-2"])
        for wrong, words in (("beam.yaml", "scenes: .*list"), (None, "key 'scenes' is missing")):
            with self.assertRaisesRegex(orthodyn.ConfigError, f"^the study:1:[0-9]+: {words}"):
                orthodyn.compare({"title": "t", "scenes": wrong, "tolerances": [1e-2]}, "w", quiet=True)

    def long_sweep(self):
        return {"title": "t", "scene": orthodyn.Scene(beam()), "vary": {"materials.wood.nu": [k / 2000 for k in range(400)]},
                "quantities": {"lowest": {"quantity": "tip.displacement.z", "take": "min"}}}

    def finished(self):
        return {path: path.read_bytes() for path in Path("s/points").glob("*/result.json")}

    def interrupt_when_begun(self):
        """Sends Ctrl-C to the interpreter only, as in a notebook."""
        def wait():
            while not self.finished():
                time.sleep(0.02)
            os.kill(os.getpid(), signal.SIGINT)
        thread = threading.Thread(target=wait, daemon=True)
        thread.start()

    def test_is_interrupted_with_what_was_finished_and_goes_on_from_there(self):
        self.interrupt_when_begun()
        with self.assertRaises(KeyboardInterrupt) as caught:
            orthodyn.sweep(self.long_sweep(), "s", quiet=True)
        self.assertIn("Finished points are kept in s", caught.exception.__notes__[0])
        self.assertFalse(list(Path().glob(".sweep-*")))
        before = self.finished()
        self.assertTrue(0 < len(before) < 400, len(before))
        self.assertEqual(list(Path("s").glob("report.html")), [Path("s/report.html")])
        spec = self.long_sweep()
        spec["vary"]["materials.wood.nu"] = spec["vary"]["materials.wood.nu"][:len(before)]
        self.assertEqual(len(orthodyn.sweep(spec, "s", jobs=1, retry=True, quiet=True).table), len(before))
        self.assertEqual({path: text for path, text in self.finished().items() if path in before}, before)

    def test_has_points_computed_by_several_ranks(self):
        spec = self.long_sweep()
        spec["vary"]["materials.wood.nu"] = spec["vary"]["materials.wood.nu"][:1]
        alone = orthodyn.sweep(spec, "one", quiet=True).table
        for_any_user = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        with unittest.mock.patch.dict(os.environ, for_any_user):
            shared = orthodyn.sweep(spec, "two", quiet=True, ranks=2).table
        self.assertEqual(list(shared["status"]), ["completed"])
        self.assertEqual(list(shared["unknowns"]), list(alone["unknowns"]))
        self.assertEqual(json.loads(Path("two/sweep.json").read_text())["ranks"], 2)

    def test_ends_with_the_interpreter_that_asked_for_it(self):
        """Also if the interpreter is killed."""
        code = (f"import sys; sys.path[:0] = {sys.path!r}; import orthodyn; from short_scene import beam; "
                f"orthodyn.sweep({{**{{'scene': orthodyn.Scene(beam())}}, **{ {k: v for k, v in self.long_sweep().items() if k != 'scene'}!r}}}, "
                "'s', quiet=True)")
        with subprocess.Popen([sys.executable, "-c", code]) as asking:
            while not self.finished():
                time.sleep(0.02)
            asking.kill()
        for _ in range(20):  # SIGTERM: it ends within four seconds
            before = len(self.finished())
            time.sleep(1)
            if len(self.finished()) == before:
                break
        else:
            self.fail("the study goes on without the one that asked for it")
        self.assertLess(before, 400)

    def test_that_cannot_be_says_so_in_words_of_python(self):
        with self.assertRaisesRegex(orthodyn.ConfigError, "^the study:1:[0-9]+: scnes: unknown key; did you mean 'scenes'"):
            orthodyn.compare({"title": "t", "scnes": []}, "c", quiet=True)
        Path("full").mkdir()
        Path("full/mine").write_text("")
        with self.assertRaisesRegex(orthodyn.ConfigError, "(use|choose) [^-]*out\\b") as caught:
            orthodyn.Scene(beam()).run("full", progress=False)
        self.assertNotIn("--", str(caught.exception))

    def test_of_hard_cases_has_a_grade_for_each(self):
        case = Path(__file__).resolve().parents[2] / "configs/stability/cases/snap_through.yaml"
        study = orthodyn.stability({"title": "t", "cases": [str(case)], "integrators": ["tr_bdf2", "newmark"]}, "h", quiet=True)
        self.assertEqual(list(study.table.grade), ["pass", "pass"])
        self.assertTrue(study.view().path.is_file())

    def test_of_meshes_has_a_row_for_each(self):
        study = orthodyn.converge(orthodyn.Scene(beam()), "v", quiet=True)
        self.assertEqual(set(study.table["order"]), {1, 2})

    def test_at_fault_says_where(self):
        with self.assertRaisesRegex(orthodyn.ConfigError, "did you mean 'tolerances'"):
            orthodyn.compare({"title": "t", "scenes": ["beam.yaml"], "tolerance": [1e-2]}, "c", quiet=True)


if __name__ == "__main__":
    unittest.main()
