"""The page of a fit: parameters, data, candidates and attempts.

Run with  /usr/bin/python3 -m unittest tests/draw/test_fit.py
"""
import copy
import json
import math
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

from report_page import EVIL, OfAComparison, Page  # noqa: E402

from draw.fit.numbers import brief, rounded, signed, times  # noqa: E402
from draw.fit.page import page as page_of_fit  # noqa: E402
from draw.fit.reading import read_fit  # noqa: E402


def parameter(name, value, half, **changes):
    return {"name": name, "paths": [f"materials.spruce.{name}"], "unit": "GPa", "value": value, "deviation": half / 1.96,
            "low": value - half, "high": value + half, "start": 8.0, "relative": True, "knowledge": "determined",
            "precision": "±1.6 %", "at_bound": False, "prior": None, "shift": None, **changes}


UNKNOWN = {"deviation": None, "low": None, "high": None, "knowledge": "undetermined", "precision": "unknown"}


def datum(experiment, title, measured, residual, over=None, **changes):
    return {"experiment": experiment, "entry": 0, "title": title, "quantity": "", "unit": "Hz", "over": over,
            "measured": measured, "deviation": 0.5, "computed": None if residual is None else measured + 0.5 * residual,
            "computed_at_start": measured + 3, "residual": residual, **changes}


def attempt(end, **changes):
    return {"start": [8.0, 0.2], "failure": "", "end": end, "chi_square": 3.25, "converged": True,
            "message": "Parameter tolerance reached.", "evaluations": 5, "failed_evaluations": 0,
            "iterations": [{"number": k, "chi_square": chi, "accepted": k != 1, "values": [8.0, 0.2]}
                           for k, chi in enumerate((500.0, 600.0, 3.25))], **changes}


FAILED = {"start": [80.0, 0.2], "failure": "the scene plate has no equilibrium"}
CANDIDATES = [{"name": "bending", "deviations": [0.0434, 0.05], "determinant_gain": 1.5, "trace_gain": 1.2},
              {"name": "torsion", "deviations": [0.0217, 0.035], "determinant_gain": 9.25, "trace_gain": 4.0}]


def fit(**changes):
    """A fit of two parameters, of which the second is undetermined, to a motion and two frequencies."""
    series = [datum("release", f"tip.displacement.x at {0.1 * k:g} s", 0.01 * math.cos(k), 0.4 * (-1) ** k, 0.1 * k,
                    unit="m", deviation=1e-4) for k in range(12)]
    single = [datum("plate", "frequency of mode 1", 89.5117, 0.2), datum("plate", "frequency of mode 2", 140.381, -2.5)]
    return {"orthodyn_fit": 1, "name": "spruce", "title": "A spruce plate", "description": "What it shows.",
            "file": "fit.yaml", "version": "0.1.0",
            "parameters": [parameter("E1", 11.00003, 0.17), parameter("nu12", 0.37, 0.1, unit="", relative=False, **UNKNOWN)],
            "correlation": [[1.0, None], [None, 1.0]],
            "directions": [{"deviation": None, "weights": [0.0, 1.0]}, {"deviation": 0.008, "weights": [1.0, 0.0]}],
            "data": series + single,
            "noise": {"chi_square": 14.4, "freedom": 13, "probability": 0.35, "runs_probability": 0.99, "factor": 1.0},
            "attempts": [FAILED, attempt([11.00003, 0.37])], "best": 1, "candidates": CANDIDATES,
            "findings": ["These data determine E1 ±1.6 % (95 % intervals).", "They say nothing about nu12: measure more."],
            "warnings": ["nu12 is at its bound, so its interval has no meaning", "the effect of the meshes is unknown: why"],
            "materials": [{"name": "spruce", "yaml": "type: orthotropic\nyoung: [11 GPa, 1 GPa, 1 GPa]\n"}],
            "runs": 9, "cpu_seconds": 2.83, **changes}


class OfAFit(OfAComparison):
    def write(self, text):
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "fit.json").write_text(text)

    def page_of(self, **changes):
        self.write(json.dumps(fit(**changes)))
        text = page_of_fit(read_fit(self.folder), self.folder)
        page = Page(text)
        self.assertEqual((page.unbalanced, page.open), ([], []))
        return text, page

    def table(self, page, first):
        """The rows of the table whose head begins with `first`."""
        return next(t for t in page.tables if t[0][0] == first)

    def test_values_have_the_digits_that_their_intervals_justify(self):
        _, page = self.page_of()
        row = self.table(page, "Parameter")[1]
        self.assertEqual([row[1].replace("\u202f", " "), row[2], row[4]], ["11.00 GPa", "10.83 to 11.17 ±1.6 %", "8"])

    def test_what_is_not_known_is_called_unknown(self):
        _, page = self.page_of()
        self.assertEqual(self.table(page, "Parameter")[2][2:4], ["unknown", "undetermined"])

    def test_an_interval_that_is_too_wide_is_called_unknown(self):
        wide = parameter("E1", 11.0, 1.0, low=0.5, high=60.0, deviation=9.0)
        self.assertEqual(self.interval_of(wide), "unknown")
        self.assertNotEqual(self.interval_of({**wide, "high": 49.0}), "unknown")

    def interval_of(self, first):
        _, page = self.page_of(parameters=[first, fit()["parameters"][1]])
        return self.table(page, "Parameter")[1][2]

    def test_a_shift_beyond_the_interval_is_bold(self):
        text, page = self.page_of(parameters=[parameter("E1", 11.0, 0.17, shift=-0.4973),
                                              parameter("E2", 0.9, 0.1, shift=0.0123)])
        self.assertEqual([row[-1] for row in self.table(page, "Parameter")], ["Shift", "−0.5", "+0.012"])
        self.assertIn("<strong>−0.5</strong>", text)
        self.assertNotIn("<strong>+0.012</strong>", text)

    def test_profile_intervals_are_beside_the_linearised_ones(self):
        profile = {"low": {"value": 10.7, "open": False, "failure": ""}, "high": {"value": 11.31, "open": True, "failure": ""}}
        _, page = self.page_of(parameters=[parameter("E1", 11.00003, 0.17, profile=profile), fit()["parameters"][1]])
        head, row, other = self.table(page, "Parameter")
        self.assertEqual((head[3], row[3], other[3]), ("Profile interval", "10.70 to 11.31 (bound)", "–"))

    def test_modes_matched_by_shape_have_their_number_and_mac(self):
        _, page = self.page_of(data=[datum("plate", "frequency 1", 89.5, 0.2, mode=1, mac=0.996),
                                     datum("plate", "frequency 2", 91.5, 0.1, mode=3, mac=0.5)])
        self.assertEqual([row[-2:] for row in self.table(page, "Datum")],
                         [["Computed mode", "MAC"], ["1", "1.00"], ["3", "0.50"]])

    def test_modes_of_their_own_number_need_no_column(self):
        _, page = self.page_of(data=[datum("plate", "frequency of mode 2", 89.5, 0.2, mode=2, mac=None)])
        self.assertEqual(self.table(page, "Datum")[0][-1], "Residual / deviation")

    def test_a_prior_is_shown(self):
        _, page = self.page_of(parameters=[parameter("E1", 11.0, 0.17, prior={"value": 10.0, "deviation": 1.5}),
                                           fit()["parameters"][1]])
        self.assertEqual(self.table(page, "Parameter")[1][-1], "10 ± 1.5")

    def test_warnings_are_sentences_in_the_banner(self):
        text, _ = self.page_of()
        self.assertIn("<li>nu12 is at its bound, so its interval has no meaning.</li>", text)
        self.assertIn("<li>The effect of the meshes is unknown: why.</li>", text)

    def test_a_minus_and_a_percent_sign_stay_with_their_numbers(self):
        text, _ = self.page_of(warnings=["refining moves E1 by -0.5 GPa, 3 % of it: /a/b-3 fails"])
        self.assertIn("Refining moves E1 by −0.5 GPa, 3\u202f% of it: /a/b-3 fails.", text)

    def test_without_warnings_there_is_no_banner(self):
        text, _ = self.page_of(warnings=[])
        self.assertNotIn('class="banner"', text)

    def test_the_first_finding_is_the_headline(self):
        text, _ = self.page_of()
        self.assertIn('<p class="headline">These data determine E1 ±1.6\u202f% (95\u202f% intervals).</p>', text)

    def test_the_header_counts(self):
        _, page = self.page_of()
        self.assertIn("14 measured values · 2 parameters · 9 runs · 2.8 s of CPU time", page.text)

    def test_a_motion_is_a_curve_and_single_values_are_a_table(self):
        text, page = self.page_of()
        rows = self.table(page, "Datum")
        self.assertEqual(rows[1], ["frequency of mode 1", "89.51", "0.50", "89.61", "Hz", "0.20"])
        self.assertIn("<strong>−2.50</strong>", text)
        self.assertEqual(len(rows), 3)
        self.assertIn("release: tip.displacement.x [mm]", page.text)
        for index in range(14):
            self.assertIn(f'data-p="{index}"', text)

    def test_residuals_of_single_values_are_drawn(self):
        """A clip path would hide marks, because it moves with them."""
        text, _ = self.page_of(data=[datum("plate", "frequency of mode 1", 89.5, 0.2)])
        self.assertNotRegex(text, r"<use[^>]*clip-path|<g[^>]*clip-path[^>]*><use")

    def test_data_that_cannot_be_computed_are_left_out(self):
        _, page = self.page_of(data=[datum("plate", "frequency of mode 1", 89.5, None), *fit()["data"][:3]])
        self.assertEqual(self.table(page, "Datum")[1][3:], ["–", "Hz", "–"])

    def test_long_tables_are_thinned_to_few_marks(self):
        data = [datum("sweep", f"amplitude of tip at {k} Hz", 1 + k % 7, 0.1, k) for k in range(1, 1001)]
        text, page = self.page_of(data=data)
        self.assertIn("One in 5 of 1000 values is drawn as a dot", page.text)
        self.assertIn("Frequency [Hz]", page.text)
        self.assertLess(text.count("data-p="), 1000)

    def test_candidates_are_sorted_by_their_gain(self):
        text, page = self.page_of()
        rows = [[cell.replace("\u202f", " ") for cell in row] for row in self.table(page, "Candidate")]
        self.assertEqual(rows, [["Candidate", "E1", "nu12", "D-gain", "A-gain"],
                                ["torsion", "4.00 ×", "± 0.035", "9.25 ×", "4.00 ×"],
                                ["bending", "2.00 ×", "± 0.05", "1.50 ×", "1.20 ×"]])
        self.assertIn('<tr class="best"><th scope="row"><strong>torsion', text)

    def test_without_candidates_the_section_is_left_out(self):
        _, page = self.page_of(candidates=[])
        self.assertNotIn("What to measure next", page.text)

    def test_a_failed_attempt_says_why(self):
        _, page = self.page_of()
        rows = self.table(page, "Attempt")
        self.assertEqual([row[4] for row in rows[1:]], ["the scene plate has no equilibrium", "converged"])
        self.assertEqual(rows[2][0], "2 (best)")
        self.assertEqual(rows[1][5], "80 → –")

    def test_a_search_that_did_not_converge_says_why(self):
        _, page = self.page_of(attempts=[attempt([11.0, 0.37], converged=False, message="Too many iterations.")], best=0)
        self.assertEqual(self.table(page, "Attempt")[1][4], "Too many iterations.")

    def test_no_attempt_need_have_iterations(self):
        _, page = self.page_of(attempts=[FAILED], best=0)
        self.assertEqual(len(self.table(page, "Attempt")), 2)

    def test_a_single_parameter_has_no_correlation(self):
        _, page = self.page_of(parameters=[parameter("E1", 11.0, 0.17)], correlation=[[1.0]], candidates=[],
                               directions=[{"deviation": 0.01, "weights": [1.0]}], attempts=[])
        self.assertIn("single parameter", page.text)

    def page_of_field(self, **changes):
        """A fit of 3 x 1 x 2 factors alone."""
        field = {"name": "stiffness", "path": "regions.body.stiffness_factors", "grid": [3, 1, 2], "smoothness": 0.2,
                 "min": [0, 0, 0], "max": [0.3, 0.02, 0.1], "start": 1, "factors": [1, 0.5, 1.2, 1, 0.6, 1],
                 "low": [0.9] * 6, "high": [1.1] * 6, **changes}
        none = attempt([], iterations=[], start=[])
        return self.page_of(parameters=[], correlation=[], directions=[], candidates=[], attempts=[none], best=0, fields=[field])

    def test_a_field_is_a_map_under_the_result(self):
        text, page = self.page_of_field()
        self.assertIn("stiffness: factors from 0.5 to 1.2 on a grid of 3 x 1 x 2 cells.", text)
        self.assertIn("z [mm]", text)  # upward in the map: the grid has one cell along y
        self.assertIn("6 parameters", text)
        self.assertLess(text.index("a grid of 3 x 1 x 2 cells"), text.index("Data and fit</h2>"))
        self.assertNotIn("What the data determine</h2>", text)
        self.assertIn("converged", text)
        self.assertNotIn("attempt failed", text)

    def test_a_field_that_the_data_do_not_determine_has_no_map_of_intervals(self):
        text, _ = self.page_of_field()
        self.assertIn("half of the 95 % interval", text)
        text, _ = self.page_of_field(low=[None] * 6, high=[None] * 6)
        self.assertNotIn("half of the 95 % interval", text)

    def test_materials_are_ready_to_paste(self):
        text, page = self.page_of()
        self.assertIn("<pre><code>type: orthotropic\nyoung: [11 GPa, 1 GPa, 1 GPa]</code></pre>", text)
        self.assertIn("materials: {spruce: {include: spruce.yaml}}", page.text)

    def test_the_command_is_given(self):
        _, page = self.page_of()
        self.assertIn(f"orthodyn fit fit.yaml --out {self.folder}", page.text)

    def test_the_command_writes_the_page_and_figures_for_papers(self):
        self.write(json.dumps(fit()))
        code, out, err = self.run_draw(self.folder)
        self.assertEqual((code, err), (0, []))
        self.assertEqual(out[0], str(self.folder / "report.html"))
        self.assertIn("A spruce plate", (self.folder / "report.html").read_text(encoding="utf-8"))
        names = {p.name for p in (self.folder / "pictures").iterdir()}
        self.assertLessEqual({"fit_release_tip.displacement.x.svg", "residuals_plate.png", "correlation.png",
                              "combinations.svg", "chi_square.png"}, names)

    def test_names_are_text(self):
        evil = copy.deepcopy(fit()["data"])
        evil[-1]["title"] = EVIL
        text, _ = self.page_of(title=EVIL, data=evil, warnings=[EVIL])
        self.assertNotIn("<script>alert", text)

    def test_a_damaged_file_is_one_line(self):
        for content, words in (("{", "not readable as JSON"), ('{"orthodyn_fit": 2}', "is 2, expected 1"),
                               ('{"orthodyn_fit": 1}', "parameters: found null"),
                               (json.dumps(fit(correlation=[[1.0]])), "a list of 2 lists of 2 numbers"),
                               (json.dumps(fit(candidates=[{"name": "x", "deviations": [1]}])), "a list of 2 numbers"),
                               (json.dumps(fit(warnings=[1])), "a list of texts"),
                               (json.dumps(fit(data=["x"])), r"data\[0\]")):
            self.write(content)
            code, _, err = self.run_draw(self.folder)
            self.assertEqual((code, len(err)), (2, 1))
            self.assertRegex(err[0], words)


class OfNumbers(OfAComparison):
    def test_a_small_negative_value_has_no_sign(self):
        self.assertEqual(rounded(-4.6e-8, 0.015), "0.000")

    def test_values_are_rounded_to_two_digits_of_the_half_width(self):
        self.assertEqual([rounded(*pair) for pair in ((11.00003, 0.17), (0.002, 4.1e-5), (3.9e-4, 3.9e-6), (-950.0, 190.0),
                                                      (9.999, 0.0999), (1234567.0, 2e4), (0.0, 1e-5), (2.5, math.nan))],
                         ["11.00", "0.002000", "3.900e−4", "−950", "10.00", "1.235e6", "0", "2.5"])

    def test_numbers_are_short(self):
        self.assertEqual([brief(8.00000000001), brief(81543.9), brief(6.2e-17), brief(math.nan)], ["8", "81540", "6.2e−17", "–"])
        self.assertEqual([signed(0.0123), signed(-0.4973), signed(math.nan)], ["+0.012", "−0.5", "–"])
        self.assertEqual([times(1.0), times(41.53), times(123.4)], ["1.00\u202f×", "41.5\u202f×", "123\u202f×"])


del OfAComparison
