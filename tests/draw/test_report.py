"""tools/draw/report: the page shows the content of compare.json and opens offline.

Run with  /usr/bin/python3 -m unittest tests/draw/test_report.py
"""
import json
import math
import os
import random
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from draw.report import comparable, cost, drift, theme, tolerance, formatting  # noqa: E402
from draw.report.layout import NARROW, WIDE  # noqa: E402
from draw.report.work_precision import draw_work_precision  # noqa: E402
from synthetic_comparison import comparison, completed, failed  # noqa: E402
from report_page import EVIL, OfAComparison, Page  # noqa: E402


class TheNumbers(OfAComparison):
    def test_every_run_is_a_row_with_its_numbers(self):
        content = self.small()
        table = next(t for t in Page(self.html(content)).tables if "Newton" in t[0])
        self.assertEqual(len(table) - 1, len(content["points"]))
        rows = {(row[0], row[1]): row for row in table[1:]}
        for point in self.read(content).points:
            row = rows[point.method, formatting.control(point.control)]
            if point.completed:
                self.assertAlmostEqual(float(row[3]), point.error("displacement.l2"),
                                       delta=0.051 * point.error("displacement.l2"))
                self.assertAlmostEqual(float(row[4]), point.seconds(), delta=5.1e-4)
                self.assertEqual(row[7].replace(formatting.THIN, ""), f"{point.counts['steps']:.0f}")
            else:
                self.assertEqual(row[2:4], [point.reason, formatting.UNKNOWN])

    def test_the_answer_names_the_fastest_and_who_did_not_reach_it(self):
        answers = [{"problem": "damped_beam", "error": "displacement.l2", "target": 1e-3, "methods": [
            {"method": "cvode_bdf", "seconds": 0.24}, {"method": "ida_bdf", "seconds": 0.12},
            {"method": "arkode_dirk", "seconds": None, "best_error": 3e-3}]}]
        text = Page(self.html(self.small(answers=answers))).text
        self.assertIn("For an error of 1e-3 (0.1 %), ida_bdf is fastest: 0.12 s; next is cvode_bdf with 0.24 s.", text)
        self.assertIn("To reach an error of 1e-3 (0.1 %) on damped_beam: ida_bdf 0.12 s, cvode_bdf 0.24 s (2.0×); "
                      "arkode_dirk did not reach it (best 3e-3).", text)

    def test_drifts_are_compared_at_the_tolerance_that_most_methods_share(self):
        content = self.small(methods=3, points=4)
        rtols = {"cvode_bdf": (1e-2, 1e-3, 1e-4), "ida_bdf": (1e-3, 1e-4), "arkode_dirk": (1e-2, 1e-5)}
        content["points"] = [p for p in (completed("damped_beam", m, v, random.Random(1)) for m in rtols
                                         for v in rtols[m])]
        read = self.read(content)
        self.assertEqual(drift.shared_tolerance(read, read.problems[0]), 1e-3)
        shown = {p.method: p.control.value for p in drift.drift_runs(read, read.problems[0])}
        self.assertEqual(shown, {"cvode_bdf": 1e-3, "ida_bdf": 1e-3, "arkode_dirk": 1e-2})
        text = self.html(content)
        self.assertIn("Energy drift at rtol 1e-3", text)
        self.assertIn("arkode_dirk, rtol 1e-2", text)

    def test_a_method_without_a_finished_run_stands_last_everywhere(self):
        content = self.small(problems=2, methods=3, points=2)
        for k, point in enumerate(content["points"]):
            if point["method"] == "cvode_bdf":
                content["points"][k] = failed(point["problem"], "cvode_bdf", point["control"]["value"], "refused")
        content["answers"] = [{"problem": p["id"], "error": "displacement.l2", "target": 1e-9, "methods": [
            {"method": "cvode_bdf", "seconds": None, "best_error": None},
            {"method": "ida_bdf", "seconds": None, "best_error": 3e-3},
            {"method": "arkode_dirk", "seconds": None, "best_error": 2e-3}]} for p in content["problems"]]
        for table in Page(self.html(content)).tables:
            names = list(dict.fromkeys(row[0] for row in table if row[0] in ("cvode_bdf", "ida_bdf", "arkode_dirk")))
            if len(names) > 1 and "cvode_bdf" in names and "Problem" not in table[0]:  # that one is by problem
                self.assertEqual(names[-1], "cvode_bdf", table)

    def test_methods_that_agree_with_each_other_put_the_reference_in_doubt(self):
        content, words = self.small(), "agree with each other rather than with the reference"
        self.assertNotIn(words, Page(self.html(content)).text)
        for k, point in enumerate(content["points"]):
            if point["errors"]:
                point["errors"]["displacement"]["l2"] = 3.2e-3 * (1 + 1e-3 * k)
        self.assertIn(words, Page(self.html(content)).text)

    def test_methods_that_are_equally_fast_are_named_together(self):
        answers = [{"problem": "damped_beam", "error": "displacement.l2", "target": 1e-3, "methods": [
            {"method": "cvode_bdf", "seconds": 0.24}, {"method": "ida_bdf", "seconds": 0.25},
            {"method": "arkode_dirk", "seconds": 0.5}]}]
        self.assertIn("cvode_bdf and ida_bdf are fastest, 0.24 s to 0.25 s; next is arkode_dirk with 0.50 s.",
                      Page(self.html(self.small(answers=answers))).text)

    def test_the_smallest_error_that_several_reach_has_an_answer_too(self):
        def answer(target, *seconds):
            names = ("cvode_bdf", "ida_bdf", "arkode_dirk")
            return {"problem": "damped_beam", "error": "displacement.l2", "target": target,
                    "methods": [{"method": m, "seconds": s, "best_error": 2e-5} for m, s in zip(names, seconds)]}
        content = self.small(answers=[answer(1e-3, 0.2, 0.3, 0.4), answer(1e-4, None, 0.5, 0.4), answer(1e-5, None, None, 2)])
        text = Page(self.html(content)).text
        self.assertIn("To reach an error of 1e-4 (0.01 %) on damped_beam: arkode_dirk 0.40 s, ida_bdf 0.50 s", text)
        self.assertNotIn("To reach an error of 1e-5", text)

    def test_the_named_quantities_are_in_the_answer(self):
        content = self.small()
        for point in content["points"]:
            if point["errors"]:
                point["errors"]["quantities"] = {"von_mises.largest": {"l2": 0.032, "final": 0.1, "max": 0.2}}
        self.assertRegex(Page(self.html(content)).text, "the named quantities are off by, relative to their largest size: "
                         r"von_mises.largest 3.2e-2 \(over time \(L2\)\)")
        self.assertNotIn("the named quantities", Page(self.html(self.small())).text)

    def test_names_of_methods_with_a_fixed_step_are_whole(self):
        content = self.small()
        content["methods"][0]["label"] = "generalized_alpha, fixed step"
        self.assertNotIn("…", re.sub(r"<script.*?</script>", "", self.html(content), flags=re.S).split("<section", 1)[1]
                         .split("<h2>Details", 1)[0].replace("error of …", ""))

    def test_several_problems_have_a_table_of_all(self):
        content = self.small(problems=3, methods=2, points=2)
        content["answers"] = [{"problem": p["id"], "error": "displacement.l2", "target": 1e-2, "methods": [
            {"method": "cvode_bdf", "seconds": 1 + k}, {"method": "ida_bdf", "seconds": 2.0}]}
            for k, p in enumerate(content["problems"])]
        parsed = Page(self.html(content))
        self.assertIn("fastest (or within 10 % of it) is cvode_bdf on 2 of 3 problems (damped_beam and free_flight); "
                      "ida_bdf on 2 of 3 problems (free_flight and laminate).", parsed.text)
        self.assertEqual(parsed.tables[0][0], ["Method", "damped_beam", "free_flight", "laminate"])

    def test_problems_on_which_nobody_got_there_are_named(self):
        content = self.small(problems=2, methods=2, points=2)
        content["answers"] = [{"problem": content["problems"][0]["id"], "error": "displacement.l2", "target": 1e-2,
                               "methods": [{"method": "cvode_bdf", "seconds": 1.0}]}]
        self.assertIn("cvode_bdf on damped_beam; no method reached it on free_flight.", Page(self.html(content)).text)

    def test_markers_stand_at_their_runs_values(self):
        read = self.read(self.small())
        layout = draw_work_precision(read, read.problems[0], "displacement.l2", "wall", WIDE)
        drawn = {line.get_gid(): line.get_xydata()[0] for line in layout.figure.axes[0].lines}
        for point in read.points:
            gid = f"pt-{point.index}-{read.method_index(point.method)}"
            if point.completed:
                self.assertEqual(tuple(drawn[gid]), (point.seconds(), point.error("displacement.l2")))
            else:
                self.assertNotIn(gid, drawn)
                lane = {line.get_gid(): line.get_xydata()[0] for line in layout.figure.axes[1].lines}
                self.assertEqual(lane[gid][0], point.seconds())

    def test_parts_of_the_cost_sum_to_the_wall_time(self):
        for point in self.read(self.small()).points:
            if point.completed:
                self.assertAlmostEqual(sum(cost.parts_of(point).values()), point.seconds())

    def test_the_run_that_stands_for_a_method_is_the_cheapest_below_the_target(self):
        read = self.read(comparison())
        target = comparable.main_target(read)
        self.assertEqual(target, 1e-3)
        for point, reached in comparable.representatives(read, read.problems[0]):
            below = [p.seconds() for p in read.finished(read.problems[0], point.method)
                     if p.error("displacement.l2") <= comparable.AS_GOOD * target]
            self.assertEqual(reached, bool(below))
            if below:
                self.assertEqual(point.seconds(), min(below))

    def test_slopes_come_from_the_orders_and_guides_from_the_slopes(self):
        read = self.read(comparison(methods=6))
        problem = read.problems[0]
        self.assertEqual(tolerance.guide_orders("rtol", read, problem, "displacement.l2", [0, 1]), [1])
        self.assertEqual(tolerance.guide_orders("step", read, problem, "displacement.l2", [4, 5]), [2])
        self.assertIn("cvode_bdf, slope 0.80", self.html(self.small(methods=6)))


class WhatIsShown(OfAComparison):
    def test_failures_are_listed_with_reason_and_time(self):
        content = self.small()
        content["points"].append(failed("damped_beam", "cvode_bdf", 1e-9, "memory limit", 0.125))
        content["points"][-1]["message"] = "needed 5 GB where 4 GB are allowed"
        parsed = Page(self.html(content))
        table = next(t for t in parsed.tables if "Reason" in t[0])
        row = next(r for r in table if "memory limit" in r)
        self.assertEqual(row[0], "cvode_bdf")
        self.assertIn("0.125 of 1", row)
        self.assertIn("needed 5 GB where 4 GB are allowed", row)

    def test_a_comparison_that_goes_on_says_so(self):
        text = Page(self.html(self.small(complete=False, planned_points=40))).text
        self.assertIn("Not finished: 9 of 40 points.", text)
        self.assertNotIn("Not finished", Page(self.html(self.small())).text)

    def test_points_near_the_reference_are_hollow(self):
        content = self.small()
        content["points"][0]["near_reference"] = ["displacement.l2"]
        read = self.read(content)
        layout = draw_work_precision(read, read.problems[0], "displacement.l2", "wall", NARROW)
        faces = {line.get_gid(): line.get_markerfacecolor() for line in layout.figure.axes[0].lines}
        self.assertEqual(faces["pt-0-0"], theme.LIGHT["paper"])
        self.assertEqual(faces["pt-1-0"], theme.colour(0))

    def test_the_reference_tells_where_it_comes_from(self):
        for change, wanted in (({}, "Computed by arkode_dirk, rtol 1e-9 in 12 s. Its own error is its difference to a "
                                    "second solution by ida_bdf, rtol 1e-8."),
                               ({"kind": "exact", "method": "one mode", "errors": None}, "Exact solution: one mode."),
                               ({"kind": "none", "message": "It diverged.", "errors": {}}, "not known. It diverged.")):
            content = self.small()
            content["problems"][0]["reference"].update(change)
            with self.subTest(kind=change.get("kind")):
                self.assertIn(wanted, Page(self.html(content)).text)

    def test_anything_may_be_missing(self):
        bare = {"orthodyn_comparison": 1, "problems": [{"id": "p"}], "methods": [{"id": "m"}]}
        nothing = {"problem": "p", "method": "m", "status": "completed"}
        odd = {**nothing, "control": {"kind": "rtol", "value": 1e-300}, "wall": {"median": 1e300, "min": 0},
               "errors": {"displacement": {"l2": 1e-320}, "phase": math.nan},
               "drift_over_time": {"t": [0], "energy": [None]}}
        large = {**nothing, "control": {"kind": "cfl", "value": 3}, "wall": {"median": 1e-9},
                 "errors": {"displacement": {"l2": 1e250}}, "drift": {"energy": math.inf},
                 "statistics": {"force": {"seconds": 5}},
                 "drift_over_time": {"t": [0, 1], "energy": [0, 1e-30]}}
        for points in ([], [nothing], [{**nothing, "status": "failed"}], [odd], [large], [nothing, odd, large]):
            with self.subTest(points=len(points)):
                parsed = Page(self.html({**bare, "points": points}))
                self.assertEqual(parsed.unbalanced, [])
                self.assertNotIn("nan", parsed.text.split())
        self.assertIn("The comparison names no problem", Page(self.html({"orthodyn_comparison": 1})).text)

    def test_failures_alone_make_a_page(self):
        content = self.small(answers=[], orders=[])
        content["points"] = [failed("damped_beam", "cvode_bdf", 10.0 ** -k, "diverged") for k in range(1, 4)]
        parsed = Page(self.html(content))
        self.assertIn("No run has finished", parsed.text)
        self.assertIn("no finished run", parsed.text)
        self.assertIn("3 runs of 3 did not finish", parsed.text)


class TheFile(OfAComparison):
    def test_it_needs_nothing_from_elsewhere(self):
        text = self.html(self.small())
        for address in re.findall(r"""(?:src|href|url|import)\s*[=(]\s*["']?([^"')\s>]+)""", text):
            self.assertRegex(address, r"^(#|data:,$)", address)
        self.assertNotRegex(text, r"https?://|@import|<iframe|fetch\(|XMLHttp")

    def test_elements_are_closed_and_ids_are_unique(self):
        parsed = Page(self.html(self.small()))
        self.assertEqual((parsed.unbalanced, parsed.open), ([], []))
        self.assertEqual(len(parsed.ids), len(set(parsed.ids)))
        for _, found in parsed.attributes:
            for reference in re.findall(r"url\(#([^)]+)\)", " ".join(str(v) for v in found.values())):
                self.assertIn(reference, parsed.ids)
            if found.get("href", "").startswith("#"):
                self.assertIn(found["href"][1:], parsed.ids)

    def test_every_colour_is_a_variable_that_both_themes_define(self):
        text = self.html(self.small())
        svgs = re.findall(r"<svg viewBox.*?</svg>", text, re.S)
        self.assertNotRegex("".join(svgs), r"#[0-9a-fA-F]{6}\b")
        self.assertEqual(set(theme.LIGHT), set(theme.DARK))
        self.assertLessEqual(set(re.findall(r"var\(--(\w+)\)", text)), set(theme.LIGHT))
        self.assertEqual(len(set(theme.LIGHT.values())), len(theme.LIGHT))  # a colour stands for one variable

    def test_figures_come_in_two_widths_with_words_for_those_who_cannot_see_them(self):
        svgs = [a for name, a in Page(self.html(self.small())).attributes if name == "svg" and "viewbox" in a]
        widths = [float(a["viewbox"].split()[2]) for a in svgs]
        self.assertEqual(widths.count(WIDE), widths.count(NARROW))
        self.assertEqual(set(widths), {WIDE, NARROW})
        for attributes in svgs:
            self.assertEqual(attributes["role"], "img")
            self.assertGreater(len(attributes["aria-label"]), 20)

    def test_every_table_has_a_caption(self):
        names = [name for name, _ in Page(self.html(self.small())).attributes]
        self.assertEqual(names.count("table"), names.count("caption"))

    def test_texts_are_escaped_everywhere(self):
        content = self.small(title=EVIL, description=EVIL, file=EVIL)
        for key in ("label", "sentence"):
            content["problems"][0][key] = content["methods"][0][key] = EVIL
        content["points"][0].update(failed("damped_beam", "cvode_bdf", 1e-2, EVIL), message=EVIL)
        content["problems"][0]["set"] = {EVIL: EVIL}
        text = self.html(content)
        self.assertEqual(text.count("<script"), 2)
        self.assertEqual(text.count("</script>"), 2)
        self.assertNotIn("alert(\"x\")</", text)
        self.assertIn('alert("x")', Page(text).text)

    def test_marks_in_figures_lead_to_their_run(self):
        content = self.small()
        text = self.html(content)
        runs = json.loads(re.search(r'id="run-data">(.*?)</script>', text, re.S).group(1))["runs"]
        self.assertEqual(len(runs), len(content["points"]))
        marks = {int(a["data-p"]) for _, a in Page(text).attributes if "data-p" in a}
        self.assertEqual(marks, set(range(len(runs))))
        self.assertEqual(runs[1]["title"].split(",")[0], content["points"][1]["method"])

    @unittest.skipUnless(os.environ.get("ORTHODYN_LONG"), "takes long; .ci/nightly runs it")
    def test_a_large_comparison_stays_below_three_megabytes(self):
        content = comparison(problems=6, methods=12, points=8)
        self.assertLess(len(self.html(content).encode()), 3e6)


if __name__ == "__main__":
    unittest.main()
