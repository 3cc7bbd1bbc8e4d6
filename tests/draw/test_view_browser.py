"""The 3D view in a browser: its script shows the data of the page, and its controls work.

Run with  /usr/bin/python3 -m unittest tests/draw/test_view_browser.py  (Debian's numpy, matplotlib, PIL, chromium).
"""
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

from report_page import CHROMIUM, dom_of  # noqa: E402
from tiny_result import POINTS, Vtu, fields_at, write_result  # noqa: E402
from view_page import OfAResult, page  # noqa: E402

from draw.view.collect import Extent  # noqa: E402

GPU = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=20000")

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
        """Runs `script` with access to the view; returns its result. Fails on console output."""
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
              await wait(30); await view.refresh(); await wait(30); view.stage.drawNow(); prints[name] = print(); };
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

    def test_a_page_and_a_still_say_how_far_deflections_are_enlarged(self):
        said = """const said = () => query(".label").textContent, same = () => view.picture() === query("canvas").toDataURL();"""
        for start in ({"scale": 200.0}, {"scale": 200.0, "still": True}):
            out = self.probed(page([self.result], Extent(), start), said + "return [said(), same()];")
            self.assertEqual(out, ["deflections enlarged 200 times", False])
        out = self.probed(page([self.result], Extent(), {"scale": 1.0}), said + """
            const scale = [...document.querySelectorAll("select")].find(s => s.options[0].text.startsWith("×")), out = [[said(), same()]];
            for (const value of ["5", "0.1"]) {
              scale.value = value; scale.dispatchEvent(new Event("change")); await wait(50); out.push([said(), same()]); }
            return out;""")
        self.assertEqual(out, [["", True], ["deflections enlarged 5 times", False], ["deflections × 0.1", False]])

    def test_shapes_have_nodal_lines_only_between_parts_that_move(self):
        folder = self.folder / "m"
        write_result(folder, [1.0])
        (folder / "frames.pvd").rename(folder / "modes.pvd")
        (folder / "modes.csv").write_text("mode,frequency [Hz]\n1,2.5\n")
        for least, lined in ((-0.5, True), (-0.01, False)):
            shape = np.zeros_like(POINTS)
            shape[:, 0] = [1, 1, 1, least, 1]
            (folder / "frames/frame_00000.vtu").write_bytes(Vtu().content({"shape": shape}, {}))
            out = self.probed(page([folder], Extent(), {"still": True}), """
                view.stage.drawNow(); const before = print();
                view.bodies[0].paint.uniforms.nodal.value = false;
                view.stage.drawNow(); return [before !== print(), query(".label").textContent];""")
            self.assertEqual(out, [lined, "1: 2.5 Hz"])

    def test_plays_in_the_time_that_it_says(self):
        out = self.probed(self.page(), """
            const speed = query('[aria-label="speed"]'), began = performance.now();
            window.requestAnimationFrame = (f) => setTimeout(f, 16);  // the clock of pictures may stand still where none is shown
            speed.value = "1"; speed.dispatchEvent(new Event("change"));
            key(" ");
            for (let k = 0; k < 200 && view.player.time === 0; ++k) await wait(50);
            const shown = view.player.time, elapsed = (performance.now() - began) / 1000;
            key(" "); const rest = view.player.time; await wait(300);
            return {moved: shown > 0, early: shown > elapsed, rests: view.player.time === rest,
                    cursor: query('.cursor') !== null};""")
        self.assertEqual(out, {"moved": True, "early": False, "rests": True, "cursor": True})

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
        self.fails_with("still.jpg: .*PNG", "view", self.result, "--png", self.folder / "still.jpg")
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
        """Shows two of three results; display options are kept."""
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


if __name__ == "__main__":
    unittest.main()
