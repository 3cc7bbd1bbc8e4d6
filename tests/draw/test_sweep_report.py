"""The page of a sweep: its figures and sentences.

Run with  /usr/bin/python3 -m unittest tests/draw/test_sweep_report.py
"""
import json
import os
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

from report_page import EVIL, OfAComparison, Page  # noqa: E402
from synthetic_sweep import sweep, write_frames, write_sweep  # noqa: E402

from matplotlib.image import imread  # noqa: E402

from draw.report.layout import WIDE  # noqa: E402
from draw.sweep.curves import draw_curves  # noqa: E402
from draw.sweep.dot_plot import draw_dot_plot  # noqa: E402
from draw.sweep.plan import has_map, plans  # noqa: E402
from draw.sweep.reading import read_sweep  # noqa: E402

ANGLES = [0.0, 30.0, 60.0, 90.0]


class OfASweep(OfAComparison):
    def page_of(self, content):
        code, out, err = self.run_draw(write_sweep(self.folder, content))
        self.assertEqual((code, err), (0, []))
        self.assertEqual(out[0], str(self.folder / "report.html"))
        text = (self.folder / "report.html").read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual((page.unbalanced, page.open), ([], []))
        return text, page

    def planned(self, content):
        found = read_sweep(write_sweep(self.folder, content))
        return found, plans(found)


class ThePlan(OfASweep):
    def roles(self, content):
        _, found = self.planned(content)
        return [(p.x.name, p.lines.name if p.lines else None, p.fixed) for p in found]

    def test_numbers_are_along_the_axis_and_names_make_lines(self):
        self.assertEqual(self.roles(sweep({"mesh": ["coarse", "fine"], "angle": ANGLES})), [("angle", "mesh", {})])

    def test_further_variables_make_figures_of_their_own(self):
        levels = {"angle": ANGLES, "nu": [0.1, 0.2], "mesh": ["coarse", "fine"]}
        self.assertEqual(self.roles(sweep(levels)), [("angle", "mesh", {"nu": 0.1}), ("angle", "mesh", {"nu": 0.2})])

    @unittest.skipUnless(os.environ.get("ORTHODYN_LONG"), "takes long; .ci/nightly runs it")
    def test_the_page_says_what_it_leaves_out(self):
        levels = {"angle": ANGLES, "mesh": ["coarse", "fine"], "nu": [0.1, 0.2, 0.3], "k": [1.0, 2.0, 3.0, 4.0]}
        content = sweep(levels)
        self.assertEqual(len(self.roles(content)), 8)
        text, _ = self.page_of(content)
        self.assertIn("Of deflection the first 8 of 12 combinations of nu and k are drawn", text)
        text, _ = self.page_of(sweep({"angle": ANGLES, "mesh": ["coarse", "fine"]}))
        self.assertNotIn("combinations of", text)

    def test_two_numbers_are_a_map_too(self):
        content, found = self.planned(sweep({"a": ANGLES, "b": [1.0, 2.0, 3.0, 4.0]}))
        self.assertTrue(has_map(found[0], content))
        content, found = self.planned(sweep({"a": ANGLES, "b": [1.0, 2.0]}))
        self.assertFalse(has_map(found[0], content))

    def test_a_latin_hypercube_is_scattered_over_each_variable(self):
        roles = self.roles(sweep({"a": ANGLES, "b": [1.0, 2.0]}, combine="latin_hypercube"))
        self.assertEqual(roles, [("a", None, {}), ("b", None, {})])

    def test_what_is_wished_for_wins(self):
        wish = [{"metric": "f", "x": "b", "lines": "a"}]
        self.assertEqual(self.roles(sweep({"a": ANGLES, "b": [1.0, 2.0]}, plots=wish)), [("b", "a", {})])


class ThePage(OfASweep):
    def test_it_has_every_point_with_its_difference_from_the_closed_form(self):
        text, page = self.page_of(sweep({"mesh": ["coarse", "fine"], "angle": ANGLES}))
        rows = next(t for t in page.tables if len(t) == 1 + 8)
        self.assertEqual(rows[2][:3], ["coarse", "30", "31"])
        self.assertEqual(len(set(re.findall(r'data-p="(\d+)"', text))), 8)
        self.assertIn("Difference from the closed form", text)
        self.assertNotRegex(text, r'(src|href)="https?:')

    def test_it_tells_what_points_warned_of(self):
        content = sweep({"angle": ANGLES})
        self.assertNotIn("Warnings", self.page_of(content)[1].text)
        content["points"][1]["warnings"] = ["scene.yaml:3: the density is too small"]
        self.assertIn("Warnings of 1 of", self.page_of(content)[1].text)
        self.assertIn("scene.yaml:3: the density is too small", self.page_of(content)[1].text)

    def test_it_begins_with_what_changes_by_how_much_and_where(self):
        _, page = self.page_of(sweep({"angle": ANGLES}))
        self.assertIn("Deflection rises from 1 mm (angle 0) to 91 mm (angle 90), a factor of 91; at most 0.99 % from "
                      "the closed form (angle ", page.text)
        content = sweep({"mesh": ["coarse", "fine"], "angle": ANGLES}, closed_form="")
        content["points"][3]["metrics"]["f"] = 0.2
        self.assertIn("Deflection ranges from 1 mm (mesh coarse, angle 0) to 200 mm (mesh coarse, angle 90)",
                      self.page_of(content)[1].text)

    def with_errors(self, values, errors, title="f1"):
        """A sweep of a frequency over the angle with these relative mesh errors."""
        content = sweep({"angle": ANGLES[:len(values)]}, closed_form="")
        content["metrics"][0].update(title=title, unit="Hz", factor=1, has_own_error=True)
        for point, value, error in zip(content["points"], values, errors):
            point["metrics"]["f"], point["metric_errors"] = value, {"f": error}
        return content

    def test_it_tells_how_far_the_mesh_puts_a_frequency_off_wherever_that_stands(self):
        text, page = self.page_of(self.with_errors([146.56, 183.01], [0.2515, 0.1803]))
        self.assertIn("F1 rises from 150 Hz (angle 0) to 180 Hz (angle 30), by about 25 %; the mesh makes it 18 to 25 % too "
                      "high.", page.text)
        self.assertIn("The mesh is coarse for f1 at 2 of 2 points: up to 25 % too high (f1, angle 0)", page.text)
        self.assertIn("150angle 0; by the mesh 25\u202f% too high", "".join(page.tables[0][1]))
        self.assertIn("The mesh makes f1 18 to 25 % too high. Thin strokes", page.text)  # below the figure
        points = next(t for t in page.tables if "f1, by the mesh [%]" in t[0])
        self.assertEqual([row[:3] for row in points[1:]], [["0", "150", "+25"], ["30", "180", "+18"]])
        tips = json.loads(re.search(r'id="run-data">(.*?)</script>', text).group(1))["runs"]
        self.assertIn(["f1 [Hz]", "150"], tips[0]["rows"])
        self.assertIn(["f1, by the mesh", "25\u202f% too high"], tips[0]["rows"])
        self.assertNotIn("146.5", text)

    def test_a_small_error_of_the_mesh_is_told_and_leaves_its_digits(self):
        _, page = self.page_of(self.with_errors([146.5612, 183.0134], [0.0012, -0.0034]))
        self.assertIn("F1 rises from 146.6 Hz (angle 0) to 183.0 Hz (angle 30), by 25 %; the mesh makes it 0.34 % too low to "
                      "0.12 % too high.", page.text)
        self.assertNotIn("is coarse", page.text)

    def test_values_that_the_mesh_does_not_let_be_told_apart_are_not_called_the_same(self):
        _, page = self.page_of(self.with_errors([146.0, 149.0], [0.25, 0.25]))
        self.assertIn("F1 is 150 Hz at all points within the mesh error; it rises from angle 0 to angle 30, by "
                      "about 2.1 %; the mesh makes it 25 % too high.", page.text)
        self.assertNotIn("The same at all points: f1 [Hz]", page.text)

    def test_a_figure_that_one_point_does_not_have_is_not_called_the_same(self):
        content = self.with_errors([146.0, 146.0, 146.0 * (1 + 1e-12)], [0.25, 0.25, 0.25])
        _, page = self.page_of(content)
        self.assertIn("The same at all points: f1 [Hz] 150", page.text)
        content["points"][1]["metrics"]["f"] = None
        _, page = self.page_of(content)
        self.assertNotIn("The same at all points: f1 [Hz]", page.text)

    def test_strokes_lead_to_values_without_the_error_of_the_mesh(self):
        for levels in ({"angle": ANGLES}, {"wood": ["oak", "ash"]}):
            content = sweep(levels, closed_form="")
            for point in content["points"]:
                point["metric_errors"] = {"f": 0.25}
            read, found = self.planned(content)
            draw = draw_curves if "angle" in levels else draw_dot_plot
            axes = draw(found[0], read, WIDE).figure.axes[0]
            along = [line.get_ydata() if "angle" in levels else line.get_xdata() for line in axes.get_lines()]
            for point in read.points:  # 1.25 of a value is what the mesh gives
                value = read.metrics[0].value(point)
                self.assertTrue(any(len(d) == 2 and abs(d[0] - value) + abs(d[1] - value / 1.25) < 1e-9 * value
                                    for d in along), value)

    def test_the_share_of_the_elastic_energy_is_told_for_each_point(self):
        content = sweep({"angle": ANGLES})
        for k, point in enumerate(content["points"]):
            point["mesh_error"] = 0.1 * k
        _, page = self.page_of(content)
        points = next(t for t in page.tables if "elastic energy that is the mesh's error [%]" in t[0])
        self.assertIn("20", points[3])
        self.assertIn("its error is up to 30 % of the elastic energy", page.text)

    def exposures(self, values, **changes):
        """A sweep over the angle with these failure indices."""
        content = sweep({"angle": ANGLES}, closed_form="", **changes)
        content["metrics"][0].update(name="f", title="max_stress", unit="", factor=1, fails_at_one=True)
        for point, value in zip(content["points"], values):
            point["metrics"]["f"] = value
        return content

    def test_an_exposure_says_where_the_material_fails(self):
        text, page = self.page_of(self.exposures([0.5, 0.8, 1.2, 3]))
        self.assertIn("max_stress rises from 0.5 (angle 0) to 3 (angle 90), a factor of 6; 1 fails, which it crosses at "
                      "angle 45 (interpolated).", page.text)
        self.assertIn(">fails</text>", text)
        self.assertIn("1 fails, which it crosses at angle 15 and 75", self.page_of(self.exposures([2, 0, 0, 2]))[1].text)
        self.assertIn("1 fails, and no point reaches it", self.page_of(self.exposures([0.5, 0.8, 0.7, 0.3]))[1].text)
        self.assertIn("1 fails, as all points do", self.page_of(self.exposures([1.5, 1.8, 1.7, 1.3]))[1].text)
        self.assertNotIn("1 fails", self.page_of(sweep({"angle": ANGLES}))[1].text)

    def test_names_keep_their_case_at_the_start_of_a_sentence(self):
        content = sweep({"angle": ANGLES}, closed_form="")
        content["metrics"][0]["title"] = "f"
        self.assertIn("f rises from 1 mm", self.page_of(content)[1].text)

    def test_columns_that_say_nothing_are_named_once_below_the_table(self):
        content = sweep({"angle": ANGLES, "mesh": ["fine"]}, closed_form="")
        content["metrics"].append({**content["metrics"][0], "name": "g", "title": "frequency"})
        for point in content["points"]:
            point["metrics"]["g"] = None
        _, page = self.page_of(content)
        self.assertIn(["angle", "deflection [mm]"], [t[0] for t in page.tables])
        self.assertIn("The same at all points: mesh fine; wall time [s] 0.100. No point has frequency [mm].", page.text)

    def test_round_off_beside_large_values_is_zero(self):
        content = sweep({"angle": ANGLES}, closed_form="")
        content["points"][0]["metrics"]["f"] = 2.8e-17
        text, page = self.page_of(content)
        self.assertNotIn("2.8e-14", text)
        self.assertIn(["0", "0"], [row[:2] for t in page.tables for row in t])

    def test_axes_have_ticks_at_the_ends_of_the_range(self):
        read, (plan,) = self.planned(sweep({"angle": [0.0, 33.0, 66.0, 97.0]}))
        axis = draw_curves(plan, read, WIDE).figure.axes[0].xaxis
        self.assertEqual([label.get_text() for label in axis.get_ticklabels()][::len(axis.get_majorticklocs()) - 1],
                         ["0", "97"])

    def test_integrators_that_agree_against_the_closed_form_put_it_in_doubt(self):
        content = sweep({"method": ["newmark", "cvode_bdf"], "angle": ANGLES})
        content["variables"][0]["path"] = "integrator.type"
        words = "check the formula"
        self.assertNotIn(words, self.page_of(content)[1].text)  # 1 % off: that may be the mesh
        for point in content["points"]:
            point["closed_forms"]["f"] *= 2
        self.assertIn(words, self.page_of(content)[1].text)
        content["points"][0]["metrics"]["f"] *= 1.5
        self.assertNotIn(words, self.page_of(content)[1].text)

    def test_pictures_have_no_white_ground_in_the_dark(self):
        content = sweep({"angle": [0.0, 90.0]})
        self.folder.mkdir()
        self.page_of(write_frames(self.folder, content))
        corners = [tuple(round(255 * c) for c in imread(self.folder / "pictures" / name)[0, 0, :3])
                   for name in ("points.png", "points_dark.png")]
        self.assertEqual(corners, [(255, 255, 255), (0x14, 0x17, 0x1d)])

    def test_it_has_curves_maps_and_dots(self):
        for levels, words in (({"a": ANGLES, "b": [1.0, 2.0, 3.0, 4.0]}, "as colours over"),
                              ({"wood": ["oak", "ash"], "grain": ["along", "across"]}, "deflection [mm] of oak, ash")):
            text, _ = self.page_of(sweep(levels, closed_form=""))
            self.assertIn(words, text)

    def test_failed_and_missing_points_are_said(self):
        content = sweep({"a": ANGLES}, missing=1)
        content["points"][1].update(status="failed", reason="time limit", message="too slow", metrics={"f": None},
                                    cost=None)
        content["points"][2].update(status="missing", metrics={"f": None}, cost=None)
        _, page = self.page_of(content)
        self.assertIn("1 of 4 points are missing", page.text)
        self.assertIn("too slow", page.text)

    def test_a_page_without_any_result_is_a_page(self):
        content = sweep({"a": ANGLES}, missing=4)
        for point in content["points"]:
            point.update(status="missing", metrics={"f": None}, cost=None)
        self.assertIn("no point has it", self.page_of(content)[1].text)

    def test_texts_of_the_user_are_no_html(self):
        content = sweep({EVIL: [1.0, 2.0]}, title=EVIL, description=EVIL)
        self.assertNotIn("<script>alert", self.page_of(content)[0])

    def test_frames_stand_side_by_side_with_their_values(self):
        content = sweep({"mesh": ["coarse", "fine"], "angle": ANGLES})
        self.folder.mkdir()
        text, page = self.page_of(write_frames(self.folder, content))
        self.assertIn("data:image/png;base64,", text)
        self.assertIn("one camera and one range of colours", page.text)
        self.assertGreater((self.folder / "pictures/points.png").stat().st_size, 10_000)
        self.assertIn('<a href="view.html">', text)
        shown = (self.folder / "view.html").read_text(encoding="utf-8")
        self.assertIn(json.dumps("mesh fine, angle 0"), shown.replace("\\u2212", "-"))

    def test_a_bad_file_is_one_line(self):
        for content, words in (("{", "not readable as JSON"), ("[]", "the key orthodyn_sweep is missing"), ('{"orthodyn_sweep": 9}', "orthodyn_sweep is 9, expected 1"),
                               (json.dumps({**sweep({"a": ANGLES}), "points": None}), "wrong type"),
                               (json.dumps({"orthodyn_sweep": 1, "figures": []}), "'figures' of an older version")):
            self.folder.mkdir(exist_ok=True)
            (self.folder / "sweep.json").write_text(content)
            code, out, err = self.run_draw(self.folder)
            self.assertEqual((code, out, len(err)), (2, [], 1), err)
            self.assertIn(words, err[0])
