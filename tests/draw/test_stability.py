"""tools/draw/stability: the page shows the content of stability.json, with and without end states.

Run with  /usr/bin/python3 -m unittest tests/draw/test_stability.py
"""
import json
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path[:0] = [str(TOOLS), str(Path(__file__).resolve().parent)]

from draw.stability.grades import GRADES, css  # noqa: E402
from draw.stability.page import page  # noqa: E402
from draw.stability.ranking import hard_cases, lost, ranked  # noqa: E402
from draw.stability.reading import read_matrix, short  # noqa: E402
from report_page import CHROMIUM, EVIL, OfAComparison, Page, dom_of  # noqa: E402
from synthetic_matrix import CASES, INTEGRATORS, VARIANTS, matrix, trial, worst, write_matrix  # noqa: E402


class OfAMatrix(OfAComparison):
    def read(self, content):
        return read_matrix(write_matrix(self.folder, content))

    def parsed(self, content):
        return Page(page(self.read(content), self.folder))


class Reasons(unittest.TestCase):
    def test_the_place_in_a_file_is_left_out(self):
        self.assertEqual(short("/tmp/stab/trials/d3d8/scene.yaml:18:13: integrator: explicit: names no part"),
                         "integrator: explicit: names no part")
        self.assertEqual(short("/tmp/with a space/scene.yaml:18: integrator: no"), "integrator: no")
        self.assertEqual(short("could not begin: /tmp/x/scene.yml:3:1: time: end: is 0"),
                         "could not begin: time: end: is 0")

    def test_other_reasons_stay(self):
        for reason in ("time limit", "stopped at t = 0.1 s: Newton: 12:30: no convergence", "", "see scene.yaml"):
            self.assertEqual(short(reason), reason)


class TheNumbers(OfAMatrix):
    def test_integrators_stand_by_passes_then_fails(self):
        read = self.read(matrix())
        self.assertEqual([name for name, _ in ranked(read, "exact")], ["alpha", "beta", "gamma"])
        # Each has one pass; alpha and beta also a fail.
        self.assertEqual([(name, t["pass"], t["fail"]) for name, t in ranked(read, "warped")],
                         [("gamma", 1, 0), ("alpha", 1, 1), ("beta", 0, 1)])

    def test_an_integrator_that_refuses_everything_stands_last(self):
        grades = {"alpha": ("refused", "refused"), "beta": ("fail", "fail"), "gamma": ("fail", "degraded")}
        content = matrix(trials=[trial(case, "exact", name, grade) for name, both in grades.items()
                                 for case, grade in zip(CASES, both)])
        names = [name for name, _ in ranked(self.read(content), "exact")]
        self.assertEqual(names, ["gamma", "beta", "alpha"])

    def test_a_suspected_expectation_is_said_in_the_answer(self):
        sentence = "mirrored, exact: all 3 integrators that finished agree on x"
        self.assertIn(f"Expectation in doubt. {sentence}.", self.parsed(matrix(suspected=[sentence])).text)
        self.assertNotIn("in doubt", self.parsed(matrix()).text)

    def test_what_a_variant_loses(self):
        read = self.read(matrix())
        self.assertEqual([(t.case, t.integrator) for t in lost(read, "warped", "exact")],
                         [("mirrored", "beta"), ("spinning", "alpha")])
        self.assertEqual([(t.case, t.integrator) for t in lost(read, "exact", "warped")], [("spinning", "gamma")])

    def test_cases_that_nobody_passes_are_the_hardest(self):
        content = matrix()
        content["trials"] = [trial(t["case"], t["variant"], t["integrator"], "fail") if t["case"] == "spinning" else t
                             for t in content["trials"]]
        self.assertEqual([case.label for case, _ in hard_cases(self.read(content), "exact")], ["spinning"])
        self.assertIn("none of 3: spinning", self.parsed(content).text)


class ThePage(OfAMatrix):
    def test_every_trial_is_a_field_of_its_grade(self):
        content = matrix()
        parsed = self.parsed(content)
        fields = {attributes["aria-label"]: attributes for name, attributes in parsed.attributes
                  if name == "a" and "mark" in attributes.get("class", "")}
        self.assertEqual(len(fields), len(content["trials"]) - sum(  # the same words in both variants are one
            a["grade"] == b["grade"] for a, b in zip(*([t for t in content["trials"] if t["variant"] == v]
                                                       for v in VARIANTS))))
        for label, attributes in fields.items():
            grade = re.search(r": (\w+)", label).group(1)
            self.assertIn(f"g-{grade}", attributes["class"])
            self.assertTrue(attributes["href"].startswith("#case-" if grade == "pass" else "#trial-"))

    def test_links_lead_somewhere_and_ids_are_unique(self):
        parsed = self.parsed(matrix())
        self.assertEqual(parsed.unbalanced, [])
        self.assertEqual(len(parsed.ids), len(set(parsed.ids)))
        links = {a["href"][1:] for _, a in parsed.attributes if a.get("href", "").startswith("#")}
        self.assertLessEqual(links, set(parsed.ids))

    def test_the_answer_compares_the_variants(self):
        text = self.parsed(matrix()).text
        self.assertIn("With exact, alpha passes most: 2 of 2 cases, failing none.", text)
        self.assertIn("Of 3 trials that pass with exact, 2 do not with warped: 2 fail. 1 of those that do not pass "
                      "with exact does so with warped.", text)
        self.assertIn("2 cases · 3 integrators · 2 variants · 12 trials · at most 20 s each", text)

    def test_no_pass_is_a_row_with_figure_and_reason(self):
        content = matrix()
        content["trials"][1] = trial("mirrored", "exact", "beta", "fail", worst=worst(computed=None),
                                     reason="time limit")
        table = next(t for t in self.parsed(content).tables if "Worst expectation" in t[0])
        self.assertEqual(len(table) - 1, sum(t["grade"] != "pass" for t in content["trials"]))
        self.assertEqual(table[1], ["mirrored", "exact", "beta", "fail", "drift of energy.balance", "not finite", "0",
                                    "1e-2", "1", "0.250", "time limit"])
        refused = next(row for row in table if row[3] == "refused")
        self.assertEqual(refused[10], "integrator: explicit: names no part of the force")

    def test_symbols_and_words_stand_beside_colours(self):
        html = page(self.read(matrix()), self.folder)
        for grade in GRADES:
            self.assertIn(f'id="s-{grade}"', html)
            self.assertIn(f".g-{grade}{{", css())

    def test_what_is_unfinished_says_so(self):
        content = matrix(complete=False)
        content["trials"] = content["trials"][:5]
        parsed = self.parsed(content)
        self.assertIn("Not finished: 5 of 12 trials.", parsed.text)
        self.assertEqual(sum(a.get("aria-label") == "not tried yet" for _, a in parsed.attributes), 7)
        self.assertNotIn("Not finished", self.parsed(matrix()).text)

    def test_nothing_at_all_is_a_page_too(self):
        self.assertIn("No trial has ended yet.", self.parsed(matrix(complete=False, trials=[])).text)

    def test_texts_are_escaped(self):
        content = matrix(title=EVIL, description=EVIL, file=EVIL)
        content["cases"][0].update(sentence=EVIL, model=EVIL)
        content["trials"][1] = trial("mirrored", "exact", "beta", "fail", reason=EVIL, worst=worst(title=EVIL))
        html = page(self.read(content), self.folder)
        self.assertNotIn("<script>alert", html)
        self.assertNotIn("</title> &", html)
        self.assertEqual(Page(html).unbalanced, [])

    def test_one_variant_has_no_losses(self):
        content = matrix(variants=["exact"])
        content["trials"] = [t for t in content["trials"] if t["variant"] == "exact"]
        text = self.parsed(content).text
        self.assertIn("alpha passes most: 2 of 2 cases", text)
        self.assertNotIn("loses", text)

    def test_nothing_is_fetched(self):
        html = page(self.read(matrix()), self.folder)
        self.assertEqual(re.findall(r'(?:src|href)="(?!#|data:)[^"]*"', html), [])


class TheCommand(OfAMatrix):
    def test_it_writes_page_and_pictures(self):
        write_matrix(self.folder, matrix())
        code, out, err = self.run_draw(self.folder)
        self.assertEqual((code, err), (0, []))
        self.assertEqual([Path(p).name for p in out], ["report.html", *(
            f"{name}.{kind}" for name in ("matrix", "matrix_exact", "matrix_warped") for kind in ("svg", "png"))])
        self.assertTrue(all(Path(path).stat().st_size > 1000 for path in out))

    def test_a_wrong_entry_is_named(self):
        for pattern, changes in ((r'kind is "sweep", expected "stability"', {"kind": "sweep"}),
                                 (r"trials: found 3, expected a list.*`orthodyn stability`", {"trials": 3}),
                                 (r"trials\[0\]\.grade: no grade 'passed'; did you mean 'pass'",
                                  {"trials": [trial(CASES[0], VARIANTS[0], INTEGRATORS[0], "passed")]})):
            write_matrix(self.folder, matrix(**changes))
            code, out, err = self.run_draw(self.folder)
            self.assertEqual((code, out, len(err)), (2, [], 1), err)
            self.assertRegex(err[0], pattern)


PROBE = """<script>
// A window that is not in front yet gets no focus events.
const focus = HTMLElement.prototype.focus;
HTMLElement.prototype.focus = function () {
  focus.call(this);
  if (!document.hasFocus()) this.dispatchEvent(new FocusEvent("focusin", {bubbles: true}));
};
const matrix = document.querySelector("table.matrix"), fields = matrix.querySelectorAll("td [data-p]");
const tip = () => document.getElementById("tip").hidden ? "" : document.getElementById("tip").innerText.split("\\n")[0];
const said = [];
const press = key => document.activeElement.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true}));
matrix.querySelector("[data-p]").focus();
said.push(tip());
for (const key of ["ArrowRight", "ArrowDown", "ArrowLeft", "ArrowUp"]) { press(key); said.push(tip()); }
fields[1].dispatchEvent(new PointerEvent("pointermove", {bubbles: true}));
said.push(tip(), matrix.querySelectorAll('[tabindex="0"]').length, document.documentElement.scrollWidth <= innerWidth);
document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify(said)}));
</script></body>"""


class InABrowser(OfAMatrix):
    @unittest.skipUnless(CHROMIUM, "chromium is not installed, so the page's script is not tried")
    def test_values_are_shown_under_pointer_and_focus_and_arrows_move(self):
        path = self.folder / "probe.html"
        html = page(self.read(matrix()), self.folder)
        path.write_text(html.replace("</body>", PROBE), encoding="utf-8")
        dom, console = dom_of(path, 500)
        self.assertEqual(console, [])
        self.assertEqual(json.loads(re.search(r'<pre id="probe">(.*?)</pre>', dom).group(1)), [
            "mirrored", "mirrored, exact, alpha", "spinning, exact, alpha", "spinning", "mirrored",
            "mirrored, exact, gamma", 1, True])


if __name__ == "__main__":
    unittest.main()
