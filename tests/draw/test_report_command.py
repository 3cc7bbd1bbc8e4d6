"""`draw report` as a command, and its page in a real browser.

Run with  /usr/bin/python3 -m unittest tests/draw/test_report_command.py
"""
import json
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from synthetic_comparison import comparison, write_comparison  # noqa: E402
from report_page import CHROMIUM, OfAComparison, dom_of  # noqa: E402


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
        self.fails_with("not readable as JSON .*line 1.*truncated", json.dumps(self.small())[:-100])
        self.fails_with("the key orthodyn_comparison is missing", {"steps": 3})
        self.fails_with("the key orthodyn_comparison is missing", "[1]")
        self.fails_with("orthodyn_comparison is 2, expected 1", self.small(orthodyn_comparison=2))

    def test_a_wrong_entry_is_named(self):
        content = self.small()
        content["points"][2]["method"] = "cvode_bdff"
        self.fails_with(r"points\[2\]\.method: no method 'cvode_bdff'; did you mean 'cvode_bdf'", content)
        content = self.small()
        content["points"][1]["wall"]["median"] = "fast"
        self.fails_with(r'points\[1\]\.wall\.median: found "fast", expected a number', content)
        self.fails_with("'fronts' of an older version .*'pareto_fronts'", self.small(fronts=[]))
        self.fails_with(r"points: found 3, expected a list", {**self.small(), "points": 3})
        self.fails_with(r"problems\[0\]: found \"p\", expected an object", {**self.small(), "problems": ["p"]})
        content = self.small()
        content["points"][1]["drift_over_time"]["t"].pop()
        self.fails_with(r"points\[1\]\.drift_over_time\.energy", content)


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
    @unittest.skipUnless(CHROMIUM, "chromium is not installed, so the page's script is not tried")
    def test_the_script_runs_without_a_word_on_the_console(self):
        content = comparison(methods=2, points=2)
        path = self.folder / "probe.html"
        path.write_text(self.html(content).replace("</body>", PROBE), encoding="utf-8")
        dom, console = dom_of(path)
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
