"""Studies as data frames: what they hold is what the program wrote."""
import os
import signal
import sys
import tempfile
import threading
import unittest
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
        with self.assertRaisesRegex(ValueError, "no point has a frame; name `frames: {}` in the sweep"):
            study.view()

    def test_that_kept_frames_has_a_view(self):
        study = orthodyn.compare({"title": "t", "scenes": [orthodyn.Scene(beam())], "integrators": ["cvode_bdf"],
                                  "tolerances": [1e-2], "repeats": 1, "frames": {"count": 3}}, "c", quiet=True)
        page = study.view()
        self.assertIn("difference from the reference", Path(page.path).read_text())
        self.assertIn('href="view.html"', study.report.read_text())

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

    def test_is_interrupted_with_what_was_finished_and_goes_on_from_there(self):
        spec = {"title": "t", "scene": orthodyn.Scene(beam()), "vary": {"materials.wood.nu": [k / 2000 for k in range(400)]},
                "quantities": {"lowest": {"quantity": "tip.displacement.z", "take": "min"}}}
        threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt) as caught:
            orthodyn.sweep(spec, "s", quiet=True)
        self.assertIn("finished is in s; the same call goes on", caught.exception.__notes__[0])
        self.assertFalse(list(Path().glob(".sweep-*")))
        finished = len(list(Path("s/points").glob("*/result.json")))
        self.assertTrue(0 < finished < 400, finished)
        spec["vary"]["materials.wood.nu"] = spec["vary"]["materials.wood.nu"][:3]
        self.assertEqual(len(orthodyn.sweep(spec, "s", jobs=1, retry=True, quiet=True).table), 3)

    def test_that_cannot_be_says_so_in_words_of_python(self):
        with self.assertRaisesRegex(orthodyn.ConfigError, "^the study:1:[0-9]+: scnes: unknown key; did you mean 'scenes'"):
            orthodyn.compare({"title": "t", "scnes": []}, "c", quiet=True)
        Path("full").mkdir()
        Path("full/mine").write_text("")
        with self.assertRaisesRegex(orthodyn.ConfigError, "(use|choose) [^-]*out\\b") as caught:
            orthodyn.Scene(beam()).run("full", progress=False)
        self.assertNotIn("--", str(caught.exception))
        self.assertFalse(list(Path("there").glob(".compare-*")))

    def test_of_meshes_has_a_row_for_each(self):
        study = orthodyn.converge(orthodyn.Scene(beam()), "v", quiet=True)
        self.assertEqual(set(study.table["order"]), {1, 2})

    def test_at_fault_says_where(self):
        with self.assertRaisesRegex(orthodyn.ConfigError, "did you mean 'tolerances'"):
            orthodyn.compare({"title": "t", "scenes": ["beam.yaml"], "tolerance": [1e-2]}, "c", quiet=True)


if __name__ == "__main__":
    unittest.main()
