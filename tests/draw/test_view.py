"""The 3D view: what its page holds equals what the frames hold, and its script shows it.

Run with  /usr/bin/python3 -m unittest tests/draw/test_view.py  (Debian's numpy, matplotlib, PIL, chromium).
"""
import base64
import gzip
import html
import json
import re
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent)]

import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

from folder_test import InAFolder, TOOLS  # noqa: E402
from report_page import CHROMIUM, dom_of  # noqa: E402
from synthetic_comparison import comparison as a_comparison  # noqa: E402
from synthetic_matrix import matrix, write_end_state, write_matrix  # noqa: E402
from synthetic_sweep import sweep  # noqa: E402
from test_sweep_report import write_frames  # noqa: E402
from tiny_result import POINTS, TETS, Vtu, fields_at, write_curves, write_result  # noqa: E402

from draw.view.blocks import Blocks  # noqa: E402
from draw.view.bundle import digest  # noqa: E402
from draw.view.collect import Extent  # noqa: E402
from draw.view.page import page  # noqa: E402
from draw.view.skin import Skin  # noqa: E402
from draw.vtu import Frame  # noqa: E402

GPU = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=20000")


def unpacked(text):
    """All blocks of a page by name: kind, numbers, and planes as they are stored."""
    found = {}
    for name, about, packed in re.findall(r'id="([^"]*)" data-about="([^"]*)">([^<]*)</script>', text):
        found[html.unescape(name)] = json.loads(html.unescape(about)), gzip.decompress(base64.b64decode(packed))
    return found


def values_of(block):
    """Rows, as web/src/blocks.ts has them."""
    about, raw = block
    planes = np.frombuffer(raw, {"u32": "<u4", "f32": "<f4", "linear": "<u2", "half": "<f2"}[about["kind"]])
    rows = planes.reshape(about["components"], -1).T.astype(float)
    if about["kind"] == "linear":
        return np.array(about["low"]) + rows * np.array(about["step"])
    return rows * about.get("factor", 1) + about.get("offset", 0)


class InBlocks(unittest.TestCase):
    def kept(self, kind, array):
        blocks = Blocks()
        blocks.add("x", kind, array)
        return values_of(unpacked(blocks.text())["x"])

    def test_displacements_are_kept_to_a_part_in_130000_of_their_range(self):
        array = np.random.default_rng(1).uniform(-3, 5, (400, 3)) * [1, 1e-9, 1e6]
        error = np.abs(self.kept("linear", array) - array).max(axis=0)
        self.assertTrue((error <= np.ptp(array, axis=0) / 65535 * 0.5001).all())

    def test_fields_are_kept_to_three_digits_over_seven_decades(self):
        array = np.concatenate([s * 10.0 ** np.linspace(2, 9, 500) for s in (1, -1)])[:, None]
        self.assertLess(np.abs(self.kept("half", array) / array - 1).max(), 5e-4)

    def test_nothing_is_kept_too(self):
        blocks = Blocks()
        blocks.add("x", "u32", np.zeros((0, 2), int))
        self.assertEqual(unpacked(blocks.text())["x"], ({"kind": "u32", "components": 2}, b""))

    def test_what_differs_little_from_one_is_kept_to_three_digits_of_that(self):
        array = 1 + np.array([[2e-5], [-1.97e-5], [0.0]])
        blocks = Blocks()
        blocks.add("x", "half", array, offset=1.0)
        np.testing.assert_allclose(values_of(unpacked(blocks.text())["x"]) - 1, array - 1, atol=1e-8)

    def test_what_is_not_a_number_stays_so(self):
        kept = self.kept("half", np.array([[np.nan], [1.0], [0.0]]))
        self.assertTrue(np.isnan(kept[0, 0]) and kept[1, 0] == 1 and kept[2, 0] == 0)

    def test_what_never_changes_has_no_step(self):
        self.assertTrue((self.kept("linear", np.full((5, 3), 7.25)) == 7.25).all())


def box_frame():
    """A cube of five tets."""
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    tets = np.array([[0, 3, 5, 6], [1, 0, 3, 5], [2, 0, 3, 6], [4, 0, 5, 6], [7, 3, 5, 6]])
    return Frame(points, tets)


class ASkin(unittest.TestCase):
    def test_of_a_cube_has_a_normal_for_each_face_at_each_corner(self):
        skin = Skin(box_frame())
        self.assertEqual((len(skin.faces), skin.normal.max() + 1), (12, 24))
        self.assertEqual((len(skin.edges), len(skin.creases)), (18, 12))

    def test_of_quadratic_cells_shows_no_edge_between_the_parts_of_a_face(self):
        middles = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        points = np.concatenate([corners, [0.5 * (corners[a] + corners[b]) for a, b in middles]])
        from draw.vtu import EIGHTHS
        skin = Skin(Frame(points, np.array(EIGHTHS), cells=np.arange(10)[None]))
        self.assertEqual((len(skin.faces), len(skin.edges)), (16, 12))
        self.assertEqual(set(skin.cell), {0})


class OfAResult(InAFolder):
    def setUp(self):
        super().setUp()
        self.times = [0.0, 0.25, 0.5, 1.0]
        self.result = write_result(self.folder / "r", self.times)
        write_curves(self.result)

    def page(self, **extent):
        return page([self.result], Extent(**extent))


class APage(OfAResult):
    def test_holds_the_values_of_each_frame(self):
        blocks = unpacked(self.page())
        for k, t in enumerate(self.times):
            node, cell = fields_at(t)
            for name, array, tolerance in (("displacement", node["displacement"], 1e-5), ("stress", cell["stress"], 5e-4),
                                           ("det_f", cell["det_f"], 5e-4)):
                kept = values_of(blocks[f"r0/{name}/{k}"])
                np.testing.assert_allclose(kept, array, rtol=tolerance, atol=tolerance * 1e-2)

    def test_holds_a_field_once_that_never_changes(self):
        blocks = unpacked(self.page())
        self.assertIn("r0/region/0", blocks)
        self.assertNotIn("r0/region/1", blocks)

    def test_holds_all_frames_of_a_field_that_comes_back(self):
        for k, values in enumerate((1, 1, 9, 1)):
            node, cell = fields_at(self.times[k])
            (self.result / f"frames/frame_{k:05d}.vtu").write_bytes(Vtu().content(node, {"det_f": np.full((2, 1), float(values))}))
        text = self.page()
        self.assertEqual(values_of(unpacked(text)["r0/det_f/2"]).max(), 9)
        described = json.loads(re.search(r'id="description">(.*?)</script>', text).group(1))
        self.assertEqual(described["results"][0]["reach"][1], (2 * POINTS - 0.5).max(axis=0).tolist())

    def test_holds_what_is_inside_only_where_it_is_asked_for(self):
        self.assertNotIn("r0/tets", unpacked(self.page()))
        self.assertEqual(len(values_of(unpacked(self.page(volume=True))["r0/tets"])), 2)

    def test_holds_the_fields_and_frames_that_are_asked_for(self):
        blocks = unpacked(self.page(fields=("det_f",), every=2))
        self.assertEqual({name.split("/")[1] for name in blocks if re.search(r"/\d+$", name)}, {"displacement", "det_f"})
        self.assertIn("r0/det_f/2", blocks)  # the last frame, though it is none of the second ones
        self.assertNotIn("r0/det_f/3", blocks)

    def test_shows_where_the_body_is_held_and_loaded(self):
        held, load = np.zeros((5, 3)), np.zeros((5, 3))
        held[1], load[4, 2] = 1, -3
        (self.result / "setup.vtu").write_bytes(Vtu().content({"held": held, "load": load}, {}))
        blocks = unpacked(self.page())
        self.assertEqual(values_of(blocks["r0/held"]).tolist(), [[1]])
        self.assertEqual(values_of(blocks["r0/load_values"]).tolist(), [[0, 0, -3]])

    def test_holds_the_same_mesh_once(self):
        text = page(3 * [self.result], Extent())
        self.assertEqual(set(re.findall(r'id="(r[12]/rest)" data-same="([^"]*)"', text)), {("r1/rest", "r0/rest"), ("r2/rest", "r0/rest")})

    def test_of_an_unknown_field_is_refused(self):
        self.fails_with("no field 'strss'; did you mean 'stress'", "view", self.result, "--fields", "strss")

    def test_is_written_beside_the_frames(self):
        code, out, err = self.run_draw("view", self.result)
        self.assertEqual((code, out, err), (0, [str(self.result / "view.html")], []))

    def test_does_not_run_what_a_name_holds(self):
        evil = write_result(self.folder / "<script>alert(1)<", self.times)
        self.assertNotIn("<script>alert", page([evil], Extent()))


# Reads what is under the pointer at nodes, and a print of the picture, at frames, colours and themes.
PROBE = """
<script>
const said = [];
for (const kind of ["error", "warn", "log"]) console[kind] = (...words) => said.push(words.join(" "));
addEventListener("error", e => said.push(e.message));
orthodynView.then(async view => {
  const print = () => { let h = 0; for (const c of document.querySelector("canvas").toDataURL()) h = (h * 31 + c.charCodeAt(0)) | 0; return h; };
  const under = (x, y, z) => { const p = view.place(x, y, z); return view.at(p.x, p.y); };
  const result = {prints: [], values: []};
  for (const frame of [0, 2, 3]) {
    await view.goTo(frame);
    result.prints.push(print());
  }
  for (const colour of ["displacement.magnitude", "det_f", "stress.xx"]) {
    await view.setColour(colour);
    result.prints.push(print());
    result.values.push(under(...POINT));
  }
  result.clock = document.querySelector(".clock").textContent;
  document.querySelector("#clip").value = "x";
  document.querySelector("#clip").dispatchEvent(new Event("change"));
  await view.goTo(3);
  result.prints.push(print());
  const {cut} = view.bodies[0], facing = [];
  for (let t = 0; cut && t < cut.count; ++t) {
    const p = cut.positions, side = (k, i) => p[9 * t + 3 * k + i] - p[9 * t + i];
    facing.push(side(1, 1) * side(2, 2) - side(1, 2) * side(2, 1) >= 0);  // what is above in x is cut off
  }
  result.cap = [facing.length, facing.every(Boolean)];
  document.querySelector("#clip").value = "eye";
  document.querySelector("#clip").dispatchEvent(new Event("change"));
  await view.goTo(3);
  result.prints.push(print());
  const eye = view.stage.toward(), faced = view.bodies[0].cut, p = faced?.positions, places = [];
  for (let k = 0; faced && k < 3 * faced.count; ++k) places.push(eye[0] * p[3 * k] + eye[1] * p[3 * k + 1] + eye[2] * p[3 * k + 2]);
  result.depths = [Math.min(...places), Math.max(...places)];
  result.fits = document.documentElement.scrollWidth <= innerWidth;
  result.charts = document.querySelectorAll(".chart").length;
  document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify({...result, said})}));
}).catch(e => document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify({said: [String(e)]})})));
</script></body>"""


@unittest.skipUnless(CHROMIUM, "chromium is not installed, so the view's script is not tried")
class InABrowser(OfAResult):
    def looked_at(self, width, **extent):
        # A point on a face, at the last frame, about the middle of the mesh.
        _, cell = fields_at(1.0)
        corners = 2 * POINTS[[0, 1, 2]]
        point = corners.mean(axis=0) - 0.5 * (POINTS.min(axis=0) + POINTS.max(axis=0))
        path = self.folder / "probe.html"
        path.write_text(self.page(**extent).replace("</body>", PROBE.replace("POINT", json.dumps(point.tolist()))),
                        encoding="utf-8")
        dom, console = dom_of(path, width, *GPU)
        found = re.search(r'<pre id="probe">(.*?)</pre>', dom)
        self.assertTrue(found, dom[-500:])
        return json.loads(html.unescape(found.group(1))), console, cell

    def test_pixels_change_with_time_and_field_and_values_are_those_of_the_frames(self):
        result, console, cell = self.looked_at(1400, volume=True)
        self.assertEqual((result["said"], console), ([], []))
        self.assertEqual(len(set(result["prints"])), 8)
        self.assertAlmostEqual(*result["depths"], places=5)  # the plane that faces the eye is everywhere as far from it
        self.assertGreater(result["cap"][0], 0)
        self.assertTrue(result["cap"][1], "the section must show its painted side")
        self.assertEqual(result["clock"], "t = 1.000 s  (4 of 4)")
        self.assertGreaterEqual(result["charts"], 1)
        moved, volume, stress = result["values"]
        self.assertIn("element 0", volume)
        self.assertIn(f"{cell['det_f'][0, 0]:.2f}", volume)
        self.assertIn("6.00 MPa", stress)
        self.assertRegex(moved, "displacement, magnitude: [0-9.]+ (m|mm) ")

    def test_a_phone_shows_all_of_it_within_its_width(self):
        result, console, _ = self.looked_at(390)
        self.assertEqual((result["said"], console, result["fits"]), ([], [], True))


    def probed(self, text, script, width=1400):
        """What `script`, which has the view, returns; nothing is said on the console."""
        probe = """<script>orthodynView.then(async view => {
            const wait = (n) => new Promise(f => setTimeout(f, n)), query = (s) => document.querySelector(s);
            const print = () => { let h = 0; for (const c of query("canvas").toDataURL()) h = (h * 31 + c.charCodeAt(0)) | 0; return h; };
            const key = (k) => { dispatchEvent(new KeyboardEvent("keydown", {key: k})); };
            const out = await (async () => { SCRIPT })();
            document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify(out)}));
        }).catch(e => document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify(String(e.stack))})));
        </script></body>""".replace("SCRIPT", script)
        path = self.folder / "probe.html"
        path.write_text(text.replace("</body>", probe), encoding="utf-8")
        dom, console = dom_of(path, width, *GPU)
        self.assertEqual(console, [])
        return json.loads(html.unescape(re.search(r'<pre id="probe">(.*?)</pre>', dom).group(1)))

    def test_keys_and_controls_change_the_picture(self):
        held = np.zeros((5, 3))
        held[1] = 1
        (self.result / "setup.vtu").write_bytes(Vtu().content({"held": held}, {}))
        out = self.probed(self.page(), """
            const clock = () => query(".clock").textContent, prints = {}, settle = async (name) => {
              await wait(60); view.stage.drawNow(); prints[name] = print(); };
            const clocks = [];
            key("End"); await wait(50); clocks.push(clock()); key("ArrowLeft"); await wait(50); clocks.push(clock());
            key("Home"); await wait(50); clocks.push(clock());
            await view.goTo(3); await settle("plain");
            key("4"); await settle("above"); key("1"); await settle("again");
            key("e"); await settle("edges"); key("g"); await settle("grain");
            const scale = [...document.querySelectorAll("select")].find(s => s.options[0].text.startsWith("×"));
            scale.value = "5"; scale.dispatchEvent(new Event("change")); await settle("scale");
            for (const box of document.querySelectorAll(".ticks input")) { box.click(); await settle(box.parentNode.textContent); }
            const high = query('[aria-label="largest colour"]'); high.value = "6.2"; high.dispatchEvent(new Event("change"));
            await settle("range"); key("c"); await settle("clip");
            const before = getComputedStyle(document.body).backgroundColor;
            [...document.querySelectorAll("button")].find(b => b.textContent === "dark / light").click();
            return {clocks, prints, theme: before !== getComputedStyle(document.body).backgroundColor,
                    grain: [...query("#grain").options].map(o => o.text)};""")
        self.assertEqual(out["clocks"], [f"t = {t} s  ({k} of 4)" for t, k in (("1.000", 4), ("0.5000", 3), ("0", 1))])
        prints = out["prints"]
        self.assertEqual(prints.pop("again"), prints["plain"])
        self.assertEqual(len(set(prints.values())), len(prints), prints)
        self.assertEqual((out["theme"], out["grain"]), (True, ["none", "material axis 1"]))

    def test_plays_in_the_time_that_it_says(self):
        out = self.probed(self.page(), """
            const speed = query('[aria-label="speed"]');
            speed.value = "1"; speed.dispatchEvent(new Event("change"));
            key(" "); await wait(600); const half = view.player.time; key(" "); await wait(600);
            return [half, view.player.time, query('.cursor') !== null];""")
        self.assertIn(out, ([0.25, 0.25, True], [0.5, 0.5, True]))  # of the frames at 0, 0.25, 0.5, 1; then it rests

    def test_two_results_have_one_camera(self):
        other = write_result(self.folder / "other", self.times)
        out = self.probed(page([self.result, other], Extent()), """
            const apart = () => { const a = view.place(1, 0, 0, 0), b = view.place(1, 0, 0, 1); return [b.x - a.x, b.y - a.y]; };
            const before = apart(); view.stage.look(30, 45); return [before, apart(), view.stage.eye()];""")
        np.testing.assert_allclose(out[0], out[1], atol=1e-6)
        np.testing.assert_allclose(out[2], [30, 45], atol=1e-6)

    def test_quadratic_cells_are_shown_by_their_values(self):
        middles = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
        corners = POINTS[:4]
        points = np.concatenate([corners, [0.5 * (corners[a] + corners[b]) for a, b in middles]])
        content = Vtu(points, np.arange(10)[None]).content({"displacement": points}, {"det_f": np.array([[8.0]])}, types=24)
        for path in self.result.glob("frames/*.vtu"):
            path.write_bytes(content)
        out = self.probed(self.page(), """
            await view.setColour("det_f");
            const at = (...p) => { const place = view.place(...p); return view.at(place.x, place.y); };
            return [at(0.1, -0.5, 0.1), at(0.9, -0.5, 0.1)];""")  # two parts of one face, y = 0 at rest, about the middle
        for text in out:
            self.assertRegex(text, "volume ratio det F: 8.00000 · node [0-9] · element 0")

    def test_a_still_is_a_picture(self):
        out = self.folder / "still.png"
        code, said, err = self.run_draw("view", self.result, "--png", out, "--size", "500x400", "--color", "det_f")
        self.assertEqual((code, said, err), (0, [str(out)], []))
        with Image.open(out) as picture:
            self.assertEqual(picture.size, (500, 400))
            self.assertGreater(len(picture.convert("RGB").getcolors(1 << 20)), 50)
        self.fails_with("a still is a PNG", "view", self.result, "--png", self.folder / "still.jpg")
        self.fails_with("3 results; a still shows one, or two", "view", *3 * [self.result], "--png", out)

    def test_what_a_result_has_not_is_grey_and_said(self):
        other = write_result(self.folder / "other", self.times)
        for k, t in enumerate(self.times):
            node, _ = fields_at(t)
            (other / f"frames/frame_{k:05d}.vtu").write_bytes(Vtu().content(node, {}))
        text = page([self.result, other], Extent(), {"color": "stress.xx"})
        probe = """<script>orthodynView.then(async view => {
            const under = () => { const p = view.place(POINT, 1); return view.at(p.x, p.y); };
            const out = [];
            await view.goTo(3); out.push(under());
            await view.setColour("displacement.magnitude"); out.push(under());
            void view.goTo(3); void view.goTo(0); await view.goTo(3); out.push(under());
            document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify(out)}));
        });</script></body>"""
        point = 2 * POINTS[[0, 1, 2]].mean(axis=0) - 0.5
        path = self.folder / "probe.html"
        path.write_text(text.replace("</body>", probe.replace("POINT", ",".join(map(str, point)))), encoding="utf-8")
        dom, console = dom_of(path, 1400, *GPU)
        self.assertEqual(console, [])
        lacking, has, again = json.loads(html.unescape(re.search(r'<pre id="probe">(.*?)</pre>', dom).group(1)))
        self.assertEqual(lacking, "other has no stress xx")
        self.assertIn("displacement, magnitude", has)
        self.assertEqual(again, has)


    def test_chooses_what_is_shown(self):
        """Of three results two; what was chosen for the picture stays."""
        late = write_result(self.folder / "late", [0.0, 0.5, 1.0])
        other = write_result(self.folder / "other", self.times)
        text = page([self.result, other, late], Extent(), {"color": "det_f"})
        probe = """<script>orthodynView.then(async view => {
            const out = {}, chosen = () => [...document.querySelectorAll(".names select")].map(s => s.selectedOptions[0].text);
            const notes = () => document.querySelector(".notes").textContent;
            out.first = chosen();
            await view.goTo(2);
            const pick = async (pane, value) => {
              const made = document.querySelectorAll(".names select")[pane];
              made.value = value; made.dispatchEvent(new Event("change"));
              return await orthodynView;
            };
            await pick(1, "2"); out.second = chosen(); out.notes = notes();
            out.clock = document.querySelector(".clock").textContent;
            out.legend = document.querySelector(".legend-title").textContent;
            const choose = (value) => {
              const made = document.querySelectorAll(".names select")[1];
              made.value = value; made.dispatchEvent(new Event("change"));
              return orthodynView;
            };
            await Promise.all([choose("1"), choose("0"), choose("2")]); out.last = [chosen(), document.querySelectorAll("canvas").length];
            await pick(1, "-1"); out.alone = chosen(); out.panes = document.querySelectorAll(".pane").length;
            out.canvases = document.querySelectorAll("canvas").length;
            document.body.append(Object.assign(document.createElement("pre"), {id: "probe", textContent: JSON.stringify(out)}));
        });</script></body>"""
        path = self.folder / "probe.html"
        path.write_text(text.replace("</body>", probe), encoding="utf-8")
        dom, console = dom_of(path, 1400, *GPU)
        self.assertEqual(console, [])
        out = json.loads(html.unescape(re.search(r'<pre id="probe">(.*?)</pre>', dom).group(1)))
        self.assertEqual((out["first"], out["second"]), (["r", "other"], ["r", "late"]))
        self.assertIn("late: 2 elements, 3 frames", out["notes"])
        self.assertNotIn("other", out["notes"])
        self.assertEqual(out["last"], [["r", "late"], 1])  # of three choices at a time
        self.assertEqual((out["clock"], out["legend"]), ("t = 0.5000 s  (3 of 4)", "volume ratio det F"))
        self.assertEqual((out["alone"], out["panes"], out["canvases"]), (["r", "beside it …"], 1, 1))


class ThePageOfTheReadme(unittest.TestCase):
    def test_has_the_bundle_of_the_sources(self):
        text = (TOOLS.parent / "docs/results/cantilever_view.html").read_text(encoding="utf-8")
        self.assertIn(f"/* sources {digest()}", text)


class OfAStudy(InAFolder):
    def described(self, folder, start=None):
        text = page([folder], Extent(), start)
        return json.loads(re.search(r'id="description">(.*?)</script>', text).group(1)), unpacked(text)

    def test_of_a_comparison_holds_how_far_a_run_is_from_its_reference(self):
        comparison = a_comparison(problems=2, methods=2, points=1)
        comparison["problems"][0]["reference"]["folder"] = "references/a"
        (self.folder / "compare.json").write_text(json.dumps(comparison), encoding="utf-8")
        self.fails_with("no point kept frames; name `frames: {}`", "view", self.folder)
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
        """With a reference at three times; returns the folders of its points."""
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
        self.fails_with("no trial has left an end state", "view", self.folder)
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
        self.assertEqual((about["start"]["color"], about["start"]["scale"]), ("shape", 0.12))


class TheBundle(unittest.TestCase):
    def test_is_that_of_the_sources(self):
        """`npm run bundle` writes the digest of the sources it was made of."""
        bundle = (TOOLS / "draw/view/viewer.js").read_text(encoding="utf-8")
        self.assertIn(digest(), bundle[:200], "tools/draw/view/web/src was changed: npm run bundle")
        self.assertIn("MIT", bundle[:3000])


if __name__ == "__main__":
    unittest.main()
