"""The page of a convergence study: its diagrams and sentences.

Run with  /usr/bin/python3 -m unittest tests/draw/test_converge_report.py
"""
import json
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

from report_page import EVIL, OfAComparison, Page  # noqa: E402


def row(order, level, error, **changes):
    return {"order": order, "level": level, "title": "", "folder": "points/x", "status": "completed", "reason": "",
            "message": "", "unknowns": 100 * 8 ** level, "elements": 10,
            "metrics": {"f": {"value": 2 * (1 - error), "error": error, "order": 2.0 if level > 2 else None,
                              "mesh_error": 0.9 * error, "cpu_seconds": 1e-5 * 8 ** level}}, **changes}


def costs(linear, quadratic, at_most=()):
    return [{"order": o, "cpu_seconds": c, "at_most": o in at_most} for o, c in ((1, linear), (2, quadratic))]


def study(rows, **changes):
    return {"orthodyn_convergence": 1, "name": "beam", "file": "beam.yaml", "set": ["mesh.cells=[1,1,1]"],
            "written": "2026-01-31T12:00:00Z", "machine": {"processor": "x"}, "versions": {}, "ratio": 2, "target": 0.01,
            "orders": [1, 2], "metrics": [{"name": "f", "unit": "m", "limit": 2.0, "uncertainty": 1e-4, "from_order": 2,
                                           "cost_of_target": costs(40.0, 0.5), "answer": "f is 2 m"}],
            "rows": rows, **changes}


NONE = {"f": dict.fromkeys(("value", "error", "order", "mesh_error", "cpu_seconds"))}
ROWS = [row(o, level, 0.3 * 4.0 ** (-o * level)) for o in (1, 2) for level in (1, 2, 3)]


class OfAConvergence(OfAComparison):
    def page_of(self, content):
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "convergence.json").write_text(json.dumps(content))
        code, out, err = self.run_draw(self.folder)
        self.assertEqual((code, err), (0, []))
        self.assertEqual(out[0], str(self.folder / "report.html"))
        text = (self.folder / "report.html").read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual((page.unbalanced, page.open), ([], []))
        return text, page

    def test_the_answer_names_the_cheaper_elements(self):
        text, page = self.page_of(study(ROWS))
        self.assertIn("quadratic elements by 80 ×", text)
        self.assertEqual(page.tables[0][1][:2], ["f [m]", "2.00000 ± 0.0001"])

    def test_a_sentence_comes_first_and_each_metric_has_one_plot(self):
        text, _ = self.page_of(study(ROWS))
        self.assertIn('<p class="headline">f is 2 m</p>', text)
        self.assertEqual(text.count("<figure"), 1)

    def answer_of(self, cost_of_target):
        metric = dict(study([])["metrics"][0], cost_of_target=cost_of_target)
        return self.page_of(study(ROWS, metrics=[metric]))[1].tables[0][1]

    def test_elements_that_alone_reach_the_target_are_named(self):
        self.assertEqual(self.answer_of(costs(None, 0.5))[2:],
                         ["not reached", "0.5", "quadratic elements; linear ones do not reach 1 %"])
        self.assertEqual(self.answer_of(costs(None, None))[-1], "none reaches 1 %")

    def test_a_coarsest_mesh_that_is_good_enough_gives_a_bound(self):
        self.assertEqual(self.answer_of(costs(40.0, 0.0004, at_most=(2,)))[3:],
                         ["≤ 0.0004", "quadratic elements by at least 1e+05 ×"])

    def test_short_times_are_told(self):
        _, page = self.page_of(study(ROWS))
        self.assertIn("8e-05", page.tables[1][1])

    def test_every_mesh_is_in_the_table_and_in_the_figures(self):
        text, page = self.page_of(study(ROWS))
        self.assertEqual(len(page.tables[1]), 7)
        for k in range(6):
            self.assertIn(f'data-p="{k}"', text)
        self.assertTrue((self.folder / "pictures" / "f_over_cpu.png").is_file())

    def test_values_have_the_digits_that_their_errors_let_be_known(self):
        """Errors of 0.3, 0.02 and 0.003 of the limit."""
        rows = [row(1, level, error) for level, error in ((1, 0.3), (2, 0.02), (3, 0.003))]
        for found, value in zip(rows, (1.412345, 1.961234, 1.994123)):
            found["metrics"]["f"]["value"] = value
        text, page = self.page_of(study(rows))
        self.assertEqual([r[4] for r in page.tables[1][1:]], ["1.4", "1.96", "1.994"])
        tips = json.loads(re.search(r'id="run-data">(.*?)</script>', text).group(1))["runs"]
        self.assertEqual([tip["rows"][0] for tip in tips], [["f [m]", v] for v in ("1.4", "1.96", "1.994")])

    def test_without_a_limit_the_estimate_of_the_mesh_tells_the_digits(self):
        rows = [row(1, 1, 0.0, metrics={"f": {"value": 146.5551, "error": None, "order": None, "mesh_error": 0.25,
                                              "cpu_seconds": 1.0}})]
        metric = dict(study([])["metrics"][0], limit=None, uncertainty=None, cost_of_target=costs(None, None))
        _, page = self.page_of(study(rows, metrics=[metric]))
        self.assertEqual(page.tables[1][1][4], "150")

    def test_the_limit_has_the_digits_that_its_uncertainty_lets_be_known(self):
        metric = dict(study([])["metrics"][0], limit=2.0123456, uncertainty=0.03)
        self.assertEqual(self.page_of(study(ROWS, metrics=[metric]))[1].tables[0][1][1], "2.01 ± 0.03")

    def test_no_value_has_more_digits_than_the_limit(self):
        metric = dict(study([])["metrics"][0], uncertainty=0.2)
        rows = [row(1, 3, 1e-7)]
        self.assertEqual(self.page_of(study(rows, metrics=[metric]))[1].tables[1][1][4], "2.0")

    def test_meshes_that_failed_are_named_with_their_reason(self):
        failed = row(2, 3, 0.0, status="failed", reason="time limit", message="after 600 s", metrics=NONE)
        text, _ = self.page_of(study(ROWS[:5] + [failed]))
        self.assertIn("after 600 s", text)
        self.assertNotIn('data-p="5"', text)

    def test_without_any_result_it_says_so(self):
        rows = [row(1, 1, 0.1, status="missing", unknowns=None, metrics=NONE)]
        metric = dict(study([])["metrics"][0], limit=None, uncertainty=None,
                      cost_of_target=costs(None, None))
        text, _ = self.page_of(study(rows, metrics=[metric]))
        self.assertIn("not reached", text)

    def test_names_are_text(self):
        text, _ = self.page_of(study(ROWS, name=EVIL))
        self.assertNotIn("<script>alert", text)

    def test_a_damaged_file_is_one_line(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        for content, words in (("{", "not readable as JSON"), ('{"orthodyn_convergence": 2}', "is 2, expected 1"),
                               ('{"orthodyn_convergence": 1}', "missing or has the wrong type"),
                               ('{"orthodyn_convergence": 1, "figures": []}', "'figures' of an older version")):
            (self.folder / "convergence.json").write_text(content)
            code, _, err = self.run_draw(self.folder)
            self.assertNotEqual(code, 0)
            self.assertEqual(len(err), 1)
            self.assertIn(words, err[0])


del OfAComparison
