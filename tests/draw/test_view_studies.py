"""The 3D view of studies: comparisons, hard cases, sweeps, modes.

Run with  /usr/bin/python3 -m unittest tests/draw/test_view_studies.py  (Debian's numpy, matplotlib).
"""
import json
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402

from folder_test import InAFolder  # noqa: E402
from synthetic_comparison import comparison as a_comparison  # noqa: E402
from synthetic_matrix import matrix, write_end_state, write_matrix  # noqa: E402
from synthetic_sweep import sweep, write_frames  # noqa: E402
from tiny_result import POINTS, TETS, Vtu, fields_at, write_result  # noqa: E402
from view_page import page, unpacked, values_of  # noqa: E402

from draw.view.collect import Extent  # noqa: E402


class OfAStudy(InAFolder):
    def described(self, folder, start=None):
        text = page([folder], Extent(), start)
        return json.loads(re.search(r'id="description">(.*?)</script>', text).group(1)), unpacked(text)

    def test_of_a_comparison_holds_how_far_a_run_is_from_its_reference(self):
        comparison = a_comparison(problems=2, methods=2, points=1)
        comparison["problems"][0]["reference"]["folder"] = "references/a"
        (self.folder / "compare.json").write_text(json.dumps(comparison), encoding="utf-8")
        self.fails_with("no point kept frames; add `frames: {}`", "view", self.folder)
        times = [0.0, 0.5, 1.0]
        write_result(self.folder / "references/a", times)
        point = comparison["points"][0]
        run = write_result((self.folder / point["scene"]).parent, times)
        for k, t in enumerate(times):
            node, cell = fields_at(1.25 * t)
            (run / f"frames/frame_{k:05d}.vtu").write_bytes(Vtu().content(node, cell))
        about, blocks = self.described(self.folder)
        self.assertEqual([r["name"] for r in about["results"]][0], "reference")
        self.assertEqual({r["group"] for r in about["results"]}, {comparison["problems"][0]["label"]})
        self.assertEqual((about["start"]["panes"], about["start"]["time"]), ([0, 1], 1.0))
        np.testing.assert_allclose(values_of(blocks["r1/difference/2"]), 0.25 * POINTS, atol=2e-4)
        self.assertNotIn("r0/difference/2", blocks)
        unit = next(q["unit"] for q in about["results"][1]["quantities"] if q["field"] == "difference")
        self.assertEqual(unit, "m")

    def comparison(self, problems=1):
        """A comparison with a reference at three times; returns the folders of its points."""
        content = a_comparison(problems=problems, methods=2, points=1)
        content["problems"][0]["reference"]["folder"] = "references/a"
        (self.folder / "compare.json").write_text(json.dumps(content), encoding="utf-8")
        write_result(self.folder / "references/a", [0.0, 0.5, 1.0])
        return [(self.folder / point["scene"]).parent for point in content["points"]]

    def test_of_a_run_that_failed_holds_what_there_is(self):
        run = write_result(self.comparison()[0], [0.0, 0.5])
        (run / "frames/frame_00001.vtu").write_bytes(Vtu().content(*fields_at(0.75)))
        about, blocks = self.described(self.folder)
        self.assertEqual(len(about["results"][1]["times"]), 2)
        np.testing.assert_allclose(values_of(blocks["r1/difference/1"]), 0.25 * POINTS, atol=2e-4)

    def test_compares_no_run_with_a_reference_of_other_times_or_another_mesh(self):
        first, second = self.comparison()
        write_result(first, [0.0, 0.7, 1.0])
        write_result(second, [0.0, 0.5, 1.0])
        for path in second.glob("frames/*.vtu"):
            path.write_bytes(Vtu(points=POINTS + 0.1).content(*fields_at(0.5)))
        about, blocks = self.described(self.folder)
        self.assertEqual(len(about["results"]), 3)
        self.assertFalse([name for name in blocks if "difference" in name])
        self.assertNotIn("time", about["start"])

    def test_of_a_run_without_finite_places_or_frames_is_left_out(self):
        first, second = self.comparison()
        write_result(first, [0.0, 0.5, 1.0])
        (first / "frames/frame_00002.vtu").write_bytes(Vtu().content({"displacement": np.full((5, 3), np.nan)}, {}))
        second.mkdir(parents=True)
        (second / "frames.pvd").write_text('<VTKFile type="Collection"><Collection></Collection></VTKFile>')
        about, _ = self.described(self.folder)
        self.assertEqual([r["name"] for r in about["results"]], ["reference"])

    def test_of_two_comparisons_begins_with_one_of_each(self):
        self.comparison()
        other = self.folder / "other"
        write_result(other, [0.0, 1.0])
        text = page([self.folder, other], Extent())
        about = json.loads(re.search(r'id="description">(.*?)</script>', text).group(1))
        self.assertEqual((about["start"]["panes"], len(about["results"])), ([0, 1], 2))

    def test_that_cannot_be_drawn_leaves_the_report(self):
        write_matrix(self.folder, content := matrix())
        for t in content["trials"]:
            write_end_state(self.folder, t, np.full_like(POINTS, np.nan))
        code, out, err = self.run_draw("report", self.folder)
        self.assertEqual((code, len(err)), (0, 1), err)
        self.assertIn("no 3D view: ", err[0])
        self.assertNotIn("In 3D", (self.folder / "report.html").read_text(encoding="utf-8"))

    def test_is_linked_from_the_report(self):
        write_result(self.comparison()[0], [0.0, 0.5, 1.0])
        code, out, err = self.run_draw("report", self.folder)
        self.assertEqual((code, err), (0, []))
        self.assertIn(str(self.folder / "view.html"), out)
        self.assertIn('<a href="view.html">In 3D</a>', (self.folder / "report.html").read_text(encoding="utf-8"))

    def test_of_hard_cases_holds_the_end_states_that_differ(self):
        content = matrix()
        write_matrix(self.folder, content)
        self.fails_with("no trial has an end state", "view", self.folder)
        of_case = [t for t in content["trials"] if t["case"] == "mirrored"]
        for t in of_case:
            write_end_state(self.folder, t, (2 if t["integrator"] == "gamma" else 1) * POINTS)
        about, blocks = self.described(self.folder)
        self.assertEqual([(r["name"], r["labels"]) for r in about["results"]],
                         [("mirrored", ["exact; pass: alpha, beta", "exact; degraded: gamma",
                                        "warped; pass: alpha; fail: beta", "warped; refused: gamma"])])
        np.testing.assert_allclose(values_of(blocks["r0/displacement/1"]), POINTS, atol=2e-5)
        self.assertEqual((about["start"]["color"], about["start"]["range"], about["start"]["rest"]), ("det_f", [0, 2], True))
        self.assertNotIn("range", self.described(self.folder, {"color": "displacement"})[0]["start"])

    def test_of_a_sweep_over_meshes_shows_the_points_of_each(self):
        content = sweep({"mesh": ["coarse", "fine"], "angle": [0.0, 30.0]})
        (self.folder / "s").mkdir()
        write_frames(self.folder / "s", content)
        for point in content["points"]:
            if point["values"]["mesh"] == "fine":
                path = self.folder / "s" / point["folder"] / point["frame"]
                path.write_bytes(Vtu(tets=TETS[:1]).content({"displacement": 0 * POINTS}, {"det_f": np.ones((1, 1))}))
        (self.folder / "s/sweep.json").write_text(json.dumps(content), encoding="utf-8")
        about, _ = self.described(self.folder / "s")
        self.assertEqual([(r["name"], len(r["labels"])) for r in about["results"]], [("mesh coarse", 2), ("mesh fine", 2)])

    def test_of_modes_begins_enlarged_to_be_seen(self):
        folder = write_result(self.folder / "m", [1.0, 2.0])
        (folder / "frames.pvd").rename(folder / "modes.pvd")
        (folder / "modes.csv").write_text("mode,frequency [Hz]\n1,2.5\n2,2500\n")
        for k in range(2):
            (folder / f"frames/frame_{k:05d}.vtu").write_bytes(Vtu().content({"shape": POINTS / np.sqrt(3)}, {}))
        about, _ = self.described(folder)
        self.assertEqual(about["results"][0]["labels"], ["1: 2.5 Hz", "2: 2.5 kHz"])
        self.assertEqual((about["start"]["color"], about["start"]["range"], about["start"]["scale"]), ("swing", [-1, 1], 0.12))
        self.assertTrue(about["start"]["swing"])
        self.assertTrue(about["results"][0]["shape"])

    def test_of_a_run_begins_at_its_largest_motion(self):
        about, _ = self.described(write_result(self.folder / "r", [0.0, 0.5, 0.25]))
        self.assertEqual((about["start"]["time"], about["start"]["scale"]), (0.5, 1.0))
        self.assertFalse(about["results"][0]["shape"])
        self.assertEqual(self.described(self.folder / "r", {"time": 0.25, "scale": 3.0})[0]["start"]["time"], 0.25)

    def test_of_a_run_enlarges_what_could_not_be_seen(self):
        about, _ = self.described(write_result(self.folder / "r", [0.0, 0.001]))
        moved = 0.001 * np.sqrt(3) * about["start"]["scale"]
        self.assertTrue(0.03 < moved < 0.11, moved)  # of a body of size 1


if __name__ == "__main__":
    unittest.main()
