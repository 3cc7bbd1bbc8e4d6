"""Scenes and results in Python equal those written by the program."""
import contextlib
import gc
import io
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

import orthodyn  # noqa: E402
from orthodyn.draw.vtu import read_vtu  # noqa: E402
from orthodyn.studies import program  # noqa: E402
from short_scene import beam  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted(file for folder in ("scenes", "benchmarks") for file in (ROOT / "configs" / folder).glob("*.yaml"))
SOME_SCENES = [ROOT / f"configs/scenes/{name}.yaml" for name in ("cantilever", "column", "drop", "toggle")]
LONG = bool(os.environ.get("ORTHODYN_LONG"))  # .ci/nightly
PART = 0.02  # fraction of a scene's time span


class InAFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        warnings.simplefilter("ignore", orthodyn.OrthodynWarning)


class AScene(InAFolder):
    def test_from_a_dict_and_a_file_give_the_same(self):
        scene = orthodyn.Scene(beam())
        (self.folder / "beam.yaml").write_text(scene.to_yaml())
        again = orthodyn.Scene.load(self.folder / "beam.yaml").run()
        np.testing.assert_array_equal(scene.run().displacement, again.displacement)

    def test_from_a_file_stays_what_it_was_when_it_was_read(self):
        file = self.folder / "beam.yaml"
        file.write_text(orthodyn.Scene(beam()).to_yaml())
        scene = orthodyn.Scene.load(file)
        file.unlink()
        self.assertEqual(scene.set("time.end", 0.05).run().times[-1], 0.05)

    def test_is_not_changed_by_set(self):
        scene = orthodyn.Scene(beam())
        other = scene.set("time.end", 0.1).set("materials.wood.young.0", "20 MPa")
        self.assertEqual((scene.run().times[-1], other.run().times[-1]), (0.2, 0.1))
        self.assertEqual(other.run().record["model"]["given"]["materials"]["wood"]["young"][0], "20 MPa")

    def test_takes_numbers_of_numpy(self):
        scene = orthodyn.Scene(beam(gravity=np.array([0, 0, -1.0]))).set("time.end", np.float64(0.05))
        self.assertEqual(scene.run().times[-1], 0.05)

    def test_with_another_integrator_keeps_its_options(self):
        result = orthodyn.Scene(beam()).with_integrator("ida_bdf").run()
        self.assertEqual(result.record["rtol"], 1e-4)
        self.assertIn("type: ida_bdf", (result.folder / "scene.yaml").read_text())

    def test_at_fault_says_where_and_what_to_do(self):
        (self.folder / "beam.yaml").write_text("mesh: {type: boxx}\n")
        with self.assertRaisesRegex(orthodyn.ConfigError, r"beam.yaml:1.*did you mean 'box'"):
            orthodyn.Scene.load(self.folder / "beam.yaml").run()
        with self.assertRaisesRegex(orthodyn.ConfigError, "nosuch.yaml"):
            orthodyn.Scene.load(self.folder / "nosuch.yaml")
        with self.assertRaisesRegex(ValueError, "rtoll: unknown key; did you mean 'rtol'"):
            orthodyn.Scene(beam()).set("integrator.rtoll", 1e-3).model()
        with self.assertRaisesRegex(orthodyn.ConfigError, "no integrator 'rk4'; there are .*cvode_bdf"):
            orthodyn.Scene(beam()).with_integrator("rk4")
        with self.assertRaisesRegex(TypeError, "expected a scene as a dict, found 'beam.yaml'"):
            orthodyn.Scene("beam.yaml")
        with self.assertRaisesRegex(TypeError, "set cannot be used in a scene"):
            orthodyn.Scene(beam()).set("time.end", {1, 2})

    def test_that_could_not_go_on_gives_what_it_computed(self):
        with self.assertRaises(orthodyn.RunError) as caught:
            orthodyn.Scene(beam()).set("integrator.max_steps", 10).run()
        result = caught.exception.result
        self.assertEqual(result.status, "failed")
        self.assertGreaterEqual(len(result.displacement), 1)

    def test_does_not_replace_a_result_unless_told(self):
        scene = orthodyn.Scene(beam())
        scene.run(self.folder / "r")
        with self.assertRaisesRegex(orthodyn.ConfigError, "force"):
            scene.run(self.folder / "r")
        scene.run(self.folder / "r", force=True)

    def test_warns_in_python(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            orthodyn.Scene(beam(gravity=[0, 0, -60])).run()
        texts = [str(w.message) for w in caught if w.category is orthodyn.OrthodynWarning]
        self.assertTrue(any("mesh is coarse" in text for text in texts), texts)
        self.assertEqual(len(texts), len(set(texts)))
        self.assertTrue(all(w.filename.endswith("test_scene.py") for w in caught), [w.filename for w in caught])


class AResult(InAFolder):
    def test_has_arrays_that_the_library_computed(self):
        result = orthodyn.Scene(beam()).run()
        self.assertEqual(result.displacement.shape, (9, len(result.points), 3))
        self.assertEqual(result.stress.shape, (9, len(result.cells), 6))
        self.assertEqual(result.displacement.dtype, np.float64)
        self.assertIsNotNone(result.displacement.base)  # no copy: memory of the library
        np.testing.assert_allclose(result.times, np.linspace(0, 0.2, 9))
        tip = np.argmin(np.linalg.norm(result.points - [1, 0, 0], axis=1))
        np.testing.assert_array_equal(result.displacement[:, tip, 2], result.probes["tip.displacement.z"])

    def test_has_sensitivities(self):
        def tip(gravity):
            return orthodyn.Scene(beam(gravity=[0, 0, gravity])).run().probes["tip.displacement.z"]
        result = orthodyn.Scene(beam(sensitivities=["gravity.2", "materials.wood.density"])).run()
        found = result.sensitivities["d tip.displacement.z / d gravity.2"]
        expected = (tip(-9.91) - tip(-9.71)) / -0.2
        np.testing.assert_allclose(found, expected, atol=0.02 * np.abs(expected).max())
        self.assertEqual(len(result.sensitivities["d energy.elastic / d materials.wood.density"]), len(result.times))

    def test_has_derivatives_of_extremes_and_events(self):
        def run(gravity, **more):
            event = {"quantity": "tip.displacement.z", "crosses": -1e-3}
            scene = orthodyn.Scene(beam(gravity=[0, 0, gravity], events=[event], **more))
            return scene.set("output.extremes", ["tip.displacement.z.smallest"]).run()
        result = run(-9.81, sensitivities=["gravity.2"])
        entry = result.extremes["tip.displacement.z.smallest"]
        values = [run(g).extremes["tip.displacement.z.smallest"]["value"] for g in (-9.91, -9.71)]
        self.assertAlmostEqual(entry["derivatives"]["gravity.2"] / ((values[0] - values[1]) / -0.2), 1, delta=0.02)
        event = result.event_sensitivities[0]
        self.assertEqual((event["event"], event["remark"]), ("tip.displacement.z", ""))
        self.assertGreater(event["derivatives"]["gravity.2"], 0)  # a smaller load: later

    def test_of_a_buckling_analysis_has_sensitivities(self):
        result = orthodyn.Scene({
            "analysis": "buckling", "mesh": {"type": "box", "size": [1, 0.05, 0.02], "cells": [10, 2, 2]},
            "materials": {"m": {"type": "isotropic", "density": 1000, "young": 1e9, "nu": 0}}, "clamps": [{"surface": "x0"}],
            "loads": [{"surface": "x1", "force": [-10, 0, 0]}], "buckling": {"count": 2},
            "sensitivities": ["materials.m.young", "loads.0.force.0"]}).run()
        found = result.sensitivities
        np.testing.assert_allclose(found["d load_factor / d materials.m.young"], found["load_factor"] / 1e9, rtol=1e-5)
        np.testing.assert_allclose(found["d load_factor / d loads.0.force.0"], found["load_factor"] / 10, rtol=1e-5)

    def test_of_a_harmonic_analysis_has_complex_amplitudes(self):
        result = orthodyn.Scene({
            "analysis": "harmonic", "mesh": beam()["mesh"] | {"size": [1, 0.2, 0.1]}, "materials": beam()["materials"],
            "clamps": [{"surface": "x0"}],
            "loads": [{"surface": "x1", "force": [0, 0, 1], "factor": {"type": "harmonic"}}],
            "harmonic": {"from": 1, "to": 60, "damping_ratio": 0.02}, "output": {"probes": {"tip": {"at": [1, 0, 0]}}}}).run()
        self.assertEqual(result.status, "completed")
        amplitudes, frequencies = result.response["tip.displacement.z"], result.response["frequency"]
        self.assertLess(abs(np.angle(amplitudes[0])), 0.05)  # far below resonance, in phase with the force
        peak = np.abs(amplitudes).argmax()
        self.assertAlmostEqual(np.angle(amplitudes[peak]), -np.pi / 2, delta=0.3)
        self.assertAlmostEqual(frequencies[peak], result.table("modes")["frequency"][0], delta=0.01 * frequencies[peak])
        self.assertIn("lowest frequency", repr(result))

    def test_outlives_its_scene_and_arrays_outlive_the_result(self):
        array = orthodyn.Scene(beam()).run().displacement
        kept = array.copy()
        gc.collect()
        for _ in range(3):
            orthodyn.Scene(beam()).run()
        np.testing.assert_array_equal(array, kept)

    def test_temporary_files_go_with_it(self):
        result = orthodyn.Scene(beam()).run()
        folder = result.folder
        self.assertTrue(folder.is_dir())
        del result
        gc.collect()
        self.assertFalse(folder.exists())

    def test_read_from_its_folder_is_the_same_in_single_precision(self):
        kept = orthodyn.Scene(beam()).run(self.folder / "r")
        read = orthodyn.Result.load(self.folder / "r")
        np.testing.assert_array_equal(read.displacement, kept.displacement.astype(np.float32))
        np.testing.assert_array_equal(read.stress, kept.stress.astype(np.float32))
        np.testing.assert_array_equal(read.cells, kept.cells)
        np.testing.assert_array_equal(read.cell_types, kept.cell_types)
        np.testing.assert_array_equal(read.points, kept.points)
        self.assertEqual(read.statistics["steps"], kept.statistics["steps"])

    def test_of_quadratic_elements_has_their_nodes(self):
        scene = orthodyn.Scene(beam()).set("mesh.order", 2).set("time.end", 0.02)
        kept = scene.run(self.folder / "r")
        self.assertEqual(kept.cells.shape[1], 10)
        np.testing.assert_array_equal(orthodyn.Result.load(self.folder / "r").cells, kept.cells)

    def test_of_hexahedra_has_their_nodes_and_types(self):
        scene = orthodyn.Scene(beam()).set("mesh.order", 2).set("mesh.elements", "hexahedra").set("time.end", 0.02)
        kept = scene.run(self.folder / "r")
        self.assertEqual(kept.cells.shape[1], 20)
        read = orthodyn.Result.load(self.folder / "r")
        np.testing.assert_array_equal(read.cells, kept.cells)
        np.testing.assert_array_equal(read.cell_types, np.full(len(kept.cells), 25))
        np.testing.assert_array_equal(read.stress, kept.stress.astype(np.float32))

    def test_keeps_only_the_fields_that_are_asked_for(self):
        result = orthodyn.Scene(beam()).run(fields=["det_f"])
        self.assertEqual(result["det_f"].shape, (9, len(result.cells), 1))
        with self.assertRaisesRegex(KeyError, "no field 'strain'; there are det_f, displacement"):
            result["strain"]
        with self.assertRaisesRegex(ValueError, "no field 'dispalcement'; there are displacement"):
            orthodyn.Scene(beam()).run(fields=["dispalcement"])

    def test_says_which_columns_and_tables_there_are(self):
        result = orthodyn.Scene(beam()).run(self.folder / "r")
        with self.assertRaisesRegex(KeyError, "no column 'tip'; there are t, tip.displacement.x"):
            result.probes["tip"]
        for found in (result, orthodyn.Scene(beam()).run()):
            with self.assertRaisesRegex(FileNotFoundError, "^no table 'bogus'; there are energy, probes") as caught:
                found.table("bogus")
            self.assertNotIn("/", str(caught.exception))

    def test_tells_nothing_of_temporary_folders(self):
        result = orthodyn.Scene(beam()).run()
        (result.folder / "probes.csv").write_text("t [s]\n")
        with self.assertRaisesRegex(FileNotFoundError, "^probes.csv: no rows below the header$"):
            result.probes
        (result.folder / "frames.pvd").unlink()
        with self.assertRaisesRegex(FileNotFoundError, "^frames.pvd: missing"):
            orthodyn.Result(result.folder).times

    def test_names_the_error_of_the_mesh(self):
        for record, words in (({"errors": {"mesh": 0.0374, "mesh_by": "finer elements"}},
                               ", mesh error 3.7 % of the elastic energy"), ({"errors": {}}, ""), ({}, ""),
                              ({"errors": None, "modes": [{"load_factor": 10.3, "mesh_error": 0.0782}]},
                               ", mesh error +7.8 % of the lowest load factor")):
            (self.folder / "run.json").write_text(json.dumps({"status": "completed", **record}))
            self.assertEqual(repr(orthodyn.Result.load(self.folder)), f"Result({self.folder}, completed{words})")

    def test_from_a_dict_goes_by_its_name_in_messages(self):
        scene = beam()
        scene["clamps"] = [{"surfcae": "x0"}]
        with self.assertRaises(orthodyn.ConfigError) as caught:
            orthodyn.Scene(scene, "bridge").model()
        self.assertTrue(str(caught.exception).startswith("bridge: clamps.0"), caught.exception)
        self.assertNotIn("bridge.yaml", str(caught.exception))

    def test_goes_on_where_it_was_interrupted(self):
        scene = orthodyn.Scene(beam(checkpoint={})).set("checkpoint.every", 0.01)
        with self.assertRaises(orthodyn.RunError):
            scene.set("integrator.max_steps", 12).run(self.folder / "r")
        result = scene.run(self.folder / "r", resume=True)
        self.assertEqual((result.status, len(result.times)), ("completed", 9))

    def test_becomes_a_data_frame_and_a_mesh(self):
        result = orthodyn.Scene(beam()).run()
        frame = result.to_pandas()
        self.assertEqual(frame.index.name, "t")
        self.assertEqual(list(frame.columns), [f"tip.displacement.{c}" for c in "xyz"])
        mesh = result.to_meshio(3)
        np.testing.assert_array_equal(mesh.point_data["displacement"], result.displacement[3])
        np.testing.assert_array_equal(mesh.cell_data["stress"][0], result.stress[3])
        mesh.write(self.folder / "frame.vtu")

    def test_is_seen_as_long_as_its_page(self):
        page = orthodyn.Scene(beam()).run().view(color="stress.xx")
        gc.collect()
        self.assertIn("srcdoc", page._repr_html_())
        with self.assertRaisesRegex(ValueError, "no colour 'colour'"):
            orthodyn.Scene(beam()).run().view(color="colour")

    def test_is_seen_as_a_page_and_as_curves(self):
        result = orthodyn.Scene(beam()).run()
        page = result.view(out=self.folder / "view.html", time=0.1)
        self.assertIn("<title>scene</title>", page.path.read_text())
        self.assertIn("srcdoc", page._repr_html_())
        import matplotlib
        matplotlib.use("Agg")
        lines = result.plot().get_lines()
        np.testing.assert_array_equal(lines[2].get_ydata(), result.probes["tip.displacement.z"])


class ASetUp(InAFolder):
    """setup.vtu, read by `orthodyn view` and ParaView."""

    def fields(self, **changes):
        orthodyn.Scene(beam(**changes)).run(self.folder / "r")
        frame = read_vtu(self.folder / "r/setup.vtu")
        return frame.points, frame.node_fields["held"], frame.node_fields["load"]

    def test_names_the_coordinates_that_are_held_or_moved(self):
        points, held, _ = self.fields(clamps=[{"surface": "x0"}, {"surface": "x1", "components": ["z"]}])
        expected = np.zeros((len(points), 3))
        expected[points[:, 0] == 0] = 1
        expected[points[:, 0] == 1, 2] = 1
        np.testing.assert_array_equal(held, expected)

    def test_has_loads_at_their_peak_without_weight_and_springs(self):
        load = {"surface": "x1", "force": [0, 0, -2], "factor": {"type": "ramp", "end": 0.1, "value": 3}}
        points, _, forces = self.fields(loads=[load])
        np.testing.assert_allclose(forces.sum(axis=0), [0, 0, -6], atol=1e-12)
        self.assertTrue((forces[points[:, 0] < 1] == 0).all())

    def test_of_statics_has_the_loads_of_the_whole(self):
        load = {"surface": "x1", "force": [0, 0, -2]}
        _, _, forces = self.fields(analysis="static", loads=[load], damping=None, integrator=None, time=None,
                                   output={"fields": ["displacement"]})
        np.testing.assert_allclose(forces.sum(axis=0), [0, 0, -2], atol=1e-12)


class ARun(InAFolder):
    def test_lets_other_threads_run(self):
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        orthodyn.Scene(beam()).set("integrator.rtol", 1e-7).run()
        end = time.monotonic()
        done.set()
        thread.join()
        self.assertGreater(sum(begin < t < end for t in ticks), 5)

    def test_in_threads_beside_each_other_gives_the_same(self):
        expected = orthodyn.Scene(beam()).run().displacement
        found = [None] * 4

        def run(k):
            found[k] = orthodyn.Scene(beam()).run(self.folder / str(k)).displacement

        threads = [threading.Thread(target=run, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for displacement in found:
            np.testing.assert_array_equal(displacement, expected)

    def test_ends_with_ctrl_c_and_keeps_what_it_has(self):
        code = ("import orthodyn, sys\nsys.path[:0] = [sys.argv[1]]\nfrom short_scene import beam\n"
                "s = orthodyn.Scene(beam(time={'end': 1000}))\nprint('ready', flush=True)\n"
                "try:\n    s.run(sys.argv[2])\nexcept KeyboardInterrupt as k:\n    print(k.result.status, flush=True)\n")
        child = subprocess.Popen([sys.executable, "-c", code, str(Path(__file__).parent), str(self.folder / "r")],
                                 stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.assertEqual(child.stdout.readline(), "ready\n")
        while not (self.folder / "r" / "frames.pvd").exists():
            time.sleep(0.05)
        os.kill(child.pid, signal.SIGINT)
        self.assertEqual(child.communicate(timeout=60)[0], "interrupted\n")
        self.assertEqual(orthodyn.Result.load(self.folder / "r").status, "interrupted")

    def test_holds_on_to_nothing(self):
        """Deleted results free their arrays."""
        import resource
        scene = orthodyn.Scene(beam()).set("output.frames", 200).set("time.end", 0.05)

        def run(times):
            for _ in range(times):
                scene.run(fields=["displacement", "stress", "strain", "det_f"])
            gc.collect()
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

        before = run(5)
        self.assertLess(run(20) - before, 8000)  # kB; one result has 700 kB


class WhatIsSeen(InAFolder):
    def test_progress_is_a_line_that_says_how_far_it_is(self):
        told = io.StringIO()
        with contextlib.redirect_stderr(told):
            orthodyn.Scene(beam(), "strip").set("time.end", 5).run(progress=True)
        self.assertRegex(told.getvalue(), r"\rstrip: +[0-9]+ %, t = [0-9.e-]+ s")

    def test_results_of_one_name_are_told_apart_by_what_was_set(self):
        scene = orthodyn.Scene(beam(), "strip")
        one, two = scene.run(), scene.set("gravity.2", -5).run()
        third = orthodyn.Scene(beam(gravity=[0, 0, -3]), "strip").run()
        text = one.view(two, third, out=self.folder / "all.html").path.read_text()
        self.assertEqual([r["name"] for r in json.loads(re.search(r'id="description">(.*?)</script>', text).group(1))["results"]],
                         ["strip (1)", "strip (gravity.2=-5)", "strip (3)"])

    @unittest.skipUnless(LONG, "takes a minute (ORTHODYN_LONG)")
    def test_the_example_of_the_docs_works(self):
        text = (ROOT / "docs/python.md").read_text()
        code = re.search(r"```python\n(.*?)```", text, re.DOTALL).group(1)
        self.assertLessEqual(len([line for line in code.splitlines() if line and not line.startswith("#")]), 15)
        (self.folder / "configs").symlink_to(ROOT / "configs")
        child = subprocess.run([sys.executable, "-c", code], cwd=self.folder, env={**os.environ, "MPLBACKEND": "Agg"}, check=True,
                               capture_output=True, text=True)
        self.assertIn("strip.html", child.stdout)
        self.assertTrue((self.folder / "strip.html").is_file() and (self.folder / "grain.png").is_file())


class EveryScene(InAFolder):
    def test_gives_the_same_bits_as_the_program(self):
        for file in SCENES if LONG else SOME_SCENES:
            with self.subTest(file.stem):
                scene, words = orthodyn.Scene.load(file), []
                for path, value in self.changes(file.read_text()).items():
                    scene = scene.set(path, value)
                    words += ["--set", f"{path}={value}"]
                scene.run(self.folder / "python" / file.stem)
                subprocess.run([program(), "run", str(file), *words, "--quiet", "--out",
                                str(self.folder / "program" / file.stem)], check=True, stderr=subprocess.DEVNULL)
                self.same_files(file.stem)

    @staticmethod
    def changes(text):
        """A fraction of the time span, for dynamic scenes."""
        end = re.search(r"^time: *\{end: *([0-9.]+)\}", text, re.MULTILINE)
        return {"time.end": str(PART * float(end.group(1))), "output.frames": "2"} if end else {}

    def same_files(self, name):
        ours, theirs = (self.folder / who / name for who in ("python", "program"))
        files = sorted(p.relative_to(theirs) for p in theirs.rglob("*")
                       if p.suffix in (".vtu", ".csv", ".pvd"))
        self.assertTrue(files)
        for file in files:
            self.assertEqual((ours / file).read_bytes(), (theirs / file).read_bytes(), file)


if __name__ == "__main__":
    unittest.main()
