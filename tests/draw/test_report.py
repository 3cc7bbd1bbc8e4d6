"""tools/draw/report: the page says what compare.json says, opens alone, and bad files are one line.

Run with  /usr/bin/python3 -m unittest tests/draw/test_report.py
"""
import contextlib
import io
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from draw.cli import main  # noqa: E402
from draw.report import comparable, cost, measures, scale, theme, tolerance, words  # noqa: E402
from draw.report.markup import Html, data_script, tag  # noqa: E402
from draw.report.page import page  # noqa: E402
from draw.report.reading import read_comparison  # noqa: E402
from draw.report.sheet import NARROW, WIDE  # noqa: E402
from draw.report.work_precision import draw_work_precision  # noqa: E402
from synthetic_comparison import comparison, failed, write_comparison  # noqa: E402

VOID = {"meta", "link", "input"}
EVIL = '<script>alert("x")</script> & $\\frac{1}$ \'</title>'


class Page(HTMLParser):
    """What a page holds, read back; keeps open elements to see that all are closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.attributes, self.words, self.unbalanced = [], [], [], [], []
        self.tables, self.cell = [], None
        self.feed(text)

    def handle_starttag(self, name, attributes):
        found = dict(attributes)
        self.attributes.append((name, found))
        if "id" in found:
            self.ids.append(found["id"])
        if name == "table":
            self.tables.append([])
        if name == "tr" and self.tables:
            self.tables[-1].append([])
        if name in ("td", "th"):
            self.tables[-1][-1].append("")
            self.cell = name
        if name not in VOID:
            self.open.append(name)

    def handle_startendtag(self, name, attributes):
        self.attributes.append((name, dict(attributes)))
        if "id" in dict(attributes):
            self.ids.append(dict(attributes)["id"])

    def handle_endtag(self, name):
        if not self.open or self.open.pop() != name:
            self.unbalanced.append(name)
        if name == self.cell:
            self.cell = None

    def handle_data(self, text):
        if self.open and self.open[-1] not in ("script", "style"):
            self.words.append(text)
        if self.cell:
            self.tables[-1][-1][-1] += text

    @property
    def text(self):
        return " ".join("".join(self.words).replace(words.THIN, " ").split())


class OfAComparison(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name) / "r"

    def read(self, content):
        return read_comparison(write_comparison(self.folder, content))

    def html(self, content):
        return page(self.read(content), self.folder)

    def small(self, problems=1, methods=3, points=3, **changes):
        """Only one error measure and one clock: few figures, drawn quickly."""
        content = comparison(problems, methods, points)
        for point in content["points"]:
            if point["errors"]:
                point["errors"] = {"displacement": {"l2": point["errors"]["displacement"]["l2"]}}
            point["cpu"] = None
        return {**content, **changes}

    def run_draw(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["report", *map(str, arguments)])
        return code, out.getvalue().splitlines(), err.getvalue().splitlines()


class TheNumbers(OfAComparison):
    def test_every_run_is_a_row_with_its_numbers(self):
        content = self.small()
        table = next(t for t in Page(self.html(content)).tables if "Newton" in t[0])
        self.assertEqual(len(table) - 1, len(content["points"]))
        rows = {(row[0], row[1]): row for row in table[1:]}
        for point in self.read(content).points:
            row = rows[point.method, words.control(point.control)]
            if point.completed:
                self.assertAlmostEqual(float(row[3]), point.error("displacement.l2"),
                                       delta=0.051 * point.error("displacement.l2"))
                self.assertAlmostEqual(float(row[4]), point.seconds(), delta=5.1e-4)
                self.assertEqual(row[7].replace(words.THIN, ""), f"{point.counts['steps']:.0f}")
            else:
                self.assertEqual(row[2:4], [point.reason, words.UNKNOWN])

    def test_the_answer_names_the_fastest_and_who_did_not_reach_it(self):
        answers = [{"problem": "damped_beam", "error": "displacement.l2", "target": 1e-3, "methods": [
            {"method": "cvode_bdf", "seconds": 0.24}, {"method": "ida_bdf", "seconds": 0.12},
            {"method": "arkode_dirk", "seconds": None, "best_error": 3e-3}]}]
        text = Page(self.html(self.small(answers=answers))).text
        self.assertIn("For an error of 1e-3 (0.1 %), ida_bdf is fastest: 0.12 s; next is cvode_bdf with 0.24 s.", text)
        self.assertIn("To reach an error of 1e-3 (0.1 %) on damped_beam: ida_bdf 0.12 s, cvode_bdf 0.24 s (2.0×); "
                      "arkode_dirk did not reach it (best 3e-3).", text)

    def test_methods_that_are_equally_fast_are_named_together(self):
        answers = [{"problem": "damped_beam", "error": "displacement.l2", "target": 1e-3, "methods": [
            {"method": "cvode_bdf", "seconds": 0.24}, {"method": "ida_bdf", "seconds": 0.25},
            {"method": "arkode_dirk", "seconds": 0.5}]}]
        self.assertIn("cvode_bdf and ida_bdf are fastest, 0.24 s to 0.25 s; next is arkode_dirk with 0.50 s.",
                      Page(self.html(self.small(answers=answers))).text)

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
        self.assertIn("cvode_bdf on damped_beam; nobody reached it on free_flight.", Page(self.html(content)).text)

    def test_markers_stand_at_their_runs_values(self):
        read = self.read(self.small())
        sheet = draw_work_precision(read, read.problems[0], "displacement.l2", "wall", WIDE)
        drawn = {line.get_gid(): line.get_xydata()[0] for line in sheet.figure.axes[0].lines}
        for point in read.points:
            gid = f"pt-{point.index}-{read.method_index(point.method)}"
            if point.completed:
                self.assertEqual(tuple(drawn[gid]), (point.seconds(), point.error("displacement.l2")))
            else:
                self.assertNotIn(gid, drawn)
                lane = {line.get_gid(): line.get_xydata()[0] for line in sheet.figure.axes[1].lines}
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
                     if p.error("displacement.l2") <= target]
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
        sheet = draw_work_precision(read, read.problems[0], "displacement.l2", "wall", NARROW)
        faces = {line.get_gid(): line.get_markerfacecolor() for line in sheet.figure.axes[0].lines}
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

    def test_a_large_comparison_stays_below_three_megabytes(self):
        content = comparison(problems=6, methods=12, points=8)
        self.assertLess(len(self.html(content).encode()), 3e6)


class TheCommand(OfAComparison):
    def test_it_writes_the_page_and_the_paper_figures(self):
        write_comparison(self.folder, self.small())
        code, out, err = self.run_draw(self.folder)
        self.assertEqual((code, err), (0, []))
        self.assertEqual(out[0], str(self.folder / "report.html"))
        names = {Path(path).name for path in out[1:]}
        self.assertEqual(names, {f"{figure}_damped_beam.{kind}" for kind in ("svg", "png") for figure in (
            "work_precision", "error_against_control", "drift_against_control", "cost_breakdown",
            "energy_drift")})
        self.assertTrue(all(Path(path).stat().st_size > 1000 for path in out))

    def test_the_page_may_go_elsewhere(self):
        write_comparison(self.folder, self.small())
        other = self.folder.parent / "a" / "page.html"
        self.assertEqual(self.run_draw(self.folder, "-o", other)[1][0], str(other))
        self.assertTrue(other.is_file())

    def fails_with(self, pattern, content=None):
        if content is not None:
            self.folder.mkdir(exist_ok=True)
            (self.folder / "compare.json").write_text(content if isinstance(content, str) else json.dumps(content))
        code, out, err = self.run_draw(self.folder)
        self.assertEqual((code, out, len(err)), (2, [], 1), err)
        self.assertRegex(err[0], pattern)

    def test_a_bad_file_is_one_line_with_the_place_and_the_remedy(self):
        self.fails_with("no such result folder")
        self.folder.mkdir()
        self.fails_with("compare.json: missing; `orthodyn compare")
        self.fails_with("not readable as JSON .*line 1.*cut off", json.dumps(self.small())[:-100])
        self.fails_with("no comparison, the key orthodyn_comparison", {"steps": 3})
        self.fails_with("no comparison", "[1]")
        self.fails_with("written in format 2, readable is format 1", self.small(orthodyn_comparison=2))

    def test_a_wrong_entry_is_named(self):
        content = self.small()
        content["points"][2]["method"] = "cvode_bdff"
        self.fails_with(r"points\[2\]\.method: no method 'cvode_bdff'; did you mean 'cvode_bdf'", content)
        content = self.small()
        content["points"][1]["wall"]["median"] = "fast"
        self.fails_with(r'points\[1\]\.wall\.median: found "fast" where a number belongs', content)
        self.fails_with(r"points: found 3 where a list", {**self.small(), "points": 3})
        self.fails_with(r"problems\[0\]: found \"p\" where an object", {**self.small(), "problems": ["p"]})
        content = self.small()
        content["points"][1]["drift_over_time"]["t"].pop()
        self.fails_with(r"points\[1\]\.drift_over_time\.energy", content)


class SmallPieces(unittest.TestCase):
    def test_numbers_read_well(self):
        self.assertEqual([words.exponent(x) for x in (1e-3, 3.2e-3, 0, math.nan, 9.99e-4)],
                         ["1e-3", "3.2e-3", "0", "–", "1e-3"])
        plain = [words.seconds(x).replace(words.THIN, " ") for x in (0.24, 1.4, 12.3, 0.0031, 61, 4000, 2e-5, 9e3)]
        self.assertEqual(plain, ["0.24 s", "1.4 s", "12 s", "3.1 ms", "61 s", "67 min", "20 µs", "2.5 h"])
        self.assertEqual([words.percent(x).replace(words.THIN, " ") for x in (1e-3, 1e-5, 1e-9)],
                         ["0.1 %", "0.001 %", ""])
        self.assertEqual(words.power_of_ten(1e-12), "10⁻¹²")
        self.assertEqual(words.joined("abc"), "a, b and c")

    def test_ticks_are_few_and_at_least_two(self):
        for low, high in ((1e-8, 1), (0.03, 0.5), (2e-3, 9e-3), (1e-200, 1e200), (0.9, 1.3e3)):
            found = scale.ticks(low, high, 5)
            self.assertTrue(2 <= len(found) <= 8 and low <= found[0] and found[-1] <= high * 1.001, found)

    def test_measures_have_words_and_an_order(self):
        self.assertEqual(measures.label("probes.tip.max"), "probe tip, largest in time")
        keys = ["phase", "velocity.l2", "probes.a.final", "displacement.max", "displacement.l2"]
        self.assertEqual(sorted(keys, key=measures._rank),
                         ["displacement.l2", "displacement.max", "velocity.l2", "probes.a.final", "phase"])

    def test_text_is_escaped_once_and_html_stays(self):
        self.assertEqual(tag("p", "a<b", tag("b", "&"), title='"', hidden=True, id=None),
                         '<p title="&quot;" hidden>a&lt;b<b>&amp;</b></p>')
        self.assertNotIn("</script>", data_script("i", "</script>")[:-9])
        self.assertIsInstance(tag("p"), Html)

    def test_methods_differ_in_colour_or_dashes_and_all_in_marker(self):
        looks = {(theme.colour(k), str(theme.dashes(k))) for k in range(12)}
        self.assertEqual(len(looks), 12)
        self.assertEqual(len({theme.marker(k) for k in range(12)}), 12)

    def test_colours_stand_out_from_the_page_in_both_themes(self):
        def luminance(colour):
            parts = [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
            parts = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
            return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]
        for colours in (theme.LIGHT, theme.DARK):
            for name, least in [(f"c{k}", 3.0) for k in range(1, 9)] + [("ink", 7.0), ("muted", 4.5)]:
                light, dark = sorted((luminance(colours[name]), luminance(colours["paper"])), reverse=True)
                self.assertGreater((light + 0.05) / (dark + 0.05), least, name)


PROBE = """<script>
const run = () => {
  const wide = document.querySelector("#precision .wide svg"), mark = wide.querySelector("[data-p]");
  mark.scrollIntoView({block: "center", behavior: "instant"});
  const box = mark.getBoundingClientRect();
  mark.dispatchEvent(new PointerEvent("pointermove", {bubbles: true, clientX: box.left + 3, clientY: box.top + 3}));
  const tip = document.getElementById("tip").innerText.split("\\n")[0];
  const select = document.querySelector("select[data-pick=measure]");
  select.value = "velocity.max";
  select.dispatchEvent(new Event("change"));
  const label = document.querySelector("#precision .wide svg").getAttribute("aria-label");
  document.getElementById("theme").click();
  const error = document.querySelector("#runs [data-e]").textContent;
  const result = [tip, label, error, document.documentElement.dataset.theme,
                  document.documentElement.scrollWidth <= innerWidth];
  const holder = document.createElement("pre");
  document.body.append(Object.assign(holder, {id: "probe", textContent: JSON.stringify(result)}));
};
run();
</script></body>"""


class InABrowser(OfAComparison):
    CHROMIUM = shutil.which("chromium")

    def dom(self, path, width=1280):
        """The page after its scripts, and what the console said."""
        with tempfile.TemporaryDirectory() as profile:
            done = subprocess.run(
                [self.CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                 "--disable-background-networking", "--disable-component-update", "--disable-sync",
                 f"--user-data-dir={profile}", f"--window-size={width},900", "--enable-logging=stderr", "--dump-dom",
                 path.as_uri()], capture_output=True, text=True, timeout=90)
        return done.stdout, re.findall(r":CONSOLE.*", done.stderr)

    @unittest.skipUnless(CHROMIUM, "chromium is not installed, so the page's script is not tried")
    def test_the_script_runs_without_a_word_on_the_console(self):
        content = comparison(methods=2, points=2)
        path = self.folder / "probe.html"
        path.write_text(self.html(content).replace("</body>", PROBE), encoding="utf-8")
        dom, console = self.dom(path)
        self.assertEqual(console, [])
        result = re.search(r'<pre id="probe">(.*?)</pre>', dom)
        self.assertTrue(result, dom[-300:])
        tip, label, error, chosen, fits = json.loads(result.group(1))
        self.assertEqual(tip, "cvode_bdf, rtol 1e-2")
        self.assertIn("velocity, largest in time", label)
        self.assertEqual(float(error), float(f"{content['points'][0]['errors']['velocity']['max']:.1e}"))
        self.assertEqual((chosen, fits), ("dark", True))


if __name__ == "__main__":
    unittest.main()
