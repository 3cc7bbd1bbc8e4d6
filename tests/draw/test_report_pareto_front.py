"""Comparisons across meshes: the Pareto front in the figure and in sentences.

Run with  /usr/bin/python3 -m unittest tests/draw/test_report_pareto_front.py
"""
import random
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from draw.report import theme  # noqa: E402
from draw.report.pareto_front import draw_pareto_front, pareto_front_of  # noqa: E402
from draw.report.layout import NARROW, WIDE  # noqa: E402
from synthetic_comparison import comparison, completed  # noqa: E402
from report_page import OfAComparison, Page  # noqa: E402

MEASURE = "displacement.l2"


def across_meshes(mesh_error=1e-3):
    """Two meshes of one scene, with prescribed (CPU time in s, error) pairs for the methods in turn."""
    content = comparison(problems=2, methods=2, points=2)
    content["points"] = [completed(problem["id"], method["id"], rtol, random.Random(1))
                         for problem in content["problems"] for method in content["methods"] for rtol in (1e-2, 1e-3)]
    for point, (seconds, error) in zip(content["points"], ((1, 0.2), (3, 0.1), (2, 0.3), (4, 0.1),
                                                           (5, 0.05), (9, 0.0012), (8, 0.0018), (7, 0.06))):
        point["near_reference"] = []
        point["cpu"] = {"median": seconds, "min": seconds, "max": seconds}
        point["errors"]["displacement"]["l2"] = error
    for problem, mesh in zip(content["problems"], ("coarse", "fine")):
        problem["mesh"] = mesh
        problem["reference"].update(mesh_error=mesh_error, unknowns=12345)
    words = "at 10 %: coarse, cvode_bdf, rtol 0.001, 3 s; quadratic elements need 5 s"
    content.update(answers=[], orders=[], pareto_fronts=[{
        "id": "beam", "label": "beam", "problems": [p["id"] for p in content["problems"]], "points": [0, 1, 4, 6],
        "answers": [{"target": 0.1, "point": 1, "seconds": 3, "words": words}]}])
    return content


class TheFront(OfAComparison):
    def test_no_point_of_it_is_beaten_in_both_and_unresolved_errors_are_not_told_apart(self):
        read = self.read(across_meshes())
        # (9 s, 1.2e-3) and (8 s, 1.8e-3) lie below 2 x 1e-3 + 10 x 1e-8: the faster one stands for both.
        self.assertEqual([p.index for _, _, p in pareto_front_of(read, read.pareto_fronts[0], MEASURE, "cpu")], [0, 1, 4, 6])
        finer = self.read(across_meshes(mesh_error=1e-5))
        self.assertEqual([p.index for _, _, p in pareto_front_of(finer, finer.pareto_fronts[0], MEASURE, "cpu")],
                         [0, 1, 4, 6, 5])

    def test_a_colour_is_a_mesh_and_a_marker_a_method(self):
        read = self.read(across_meshes())
        for width in (WIDE, NARROW):
            axes = draw_pareto_front(read, read.pareto_fronts[0], MEASURE, "cpu", width).figure.axes[0]
            marks = {line.get_gid(): line for line in axes.lines if (line.get_gid() or "").startswith("pt-")}
            for point in read.points:
                mesh, method = int(point.problem == read.problems[1].id), read.method_index(point.method)
                mark = marks[f"pt-{point.index}-{mesh}"]
                self.assertEqual(tuple(mark.get_xydata()[0]), (point.seconds("cpu"), point.error(MEASURE)))
                self.assertEqual(mark.get_marker(), theme.marker(method))
                self.assertEqual(mark.get_markeredgecolor() if point.error(MEASURE) < 2e-3 else
                                 mark.get_markerfacecolor(), theme.colour(mesh))

    def test_the_page_begins_with_its_sentence_and_names_the_references_own_error(self):
        text = Page(self.html(across_meshes())).text
        self.assertIn("At 10 %: coarse, cvode_bdf, rtol 0.001, 3 s; quadratic elements need 5 s.", text)
        self.assertIn("is itself off by its mesh, by about 1e-3 (estimated)", text)
        self.assertIn("errors below 2e-3 are not resolved", text)

    def test_a_front_of_no_known_error_says_so(self):
        content = across_meshes()
        content["pareto_fronts"][0].update(points=[], answers=[])
        for problem in content["problems"]:
            problem["reference"]["mesh_error"] = None
        self.assertIn("no error is resolved, so nothing is concluded", Page(self.html(content)).text)


if __name__ == "__main__":
    unittest.main()
