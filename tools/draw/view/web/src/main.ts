// The view of one or two results: see description.ts for what the page holds.
import * as THREE from "three";
import { Body, type Look } from "./body";
import { Curves } from "./curves";
import { button, element, labelled, select, tick } from "./dom";
import { Legend } from "./legend";
import { colourTexture, type ColourMap } from "./material";
import { Player } from "./player";
import { Result } from "./result";
import { Stage } from "./stage";
import { figure, scaled, withUnit } from "./units";
import { readDescription, type Description, type Quantity } from "./description";
import type { Plane } from "./section";

const VIEWS: Record<string, [string, number, number]> = {
  "1": ["from the side", -60, 20], "2": ["along x", 180, 0], "3": ["along y", -90, 0], "4": ["from above", -90, 90],
};
const KEYS = "space: play; ← →: a frame back, on; Home, End: first, last; 1 – 4: views; e: edges; g: grain; c: clip plane; " +
  "drag: turn; right button or two fingers: move; wheel: nearer";
const AHEAD = 3; // frames that are unpacked before they are shown, while time goes on
const SCALES = [0.1, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 1e4, 1e5];

class View {
  private readonly bodies: Body[];
  private readonly stage: Stage;
  private readonly player: Player;
  private readonly legend: Legend;
  private readonly curves: Curves;
  private readonly under = element("output", { class: "under", "aria-live": "polite" });
  private readonly slider = element("input", { type: "range", min: 0, step: 1, "aria-label": "time" });
  private readonly clock = element("output", { class: "clock" });
  private readonly play: HTMLButtonElement;
  private look: Look = { scale: 1, edges: "shape", strokes: false, marks: true, rest: false };
  private quantity: Quantity;
  private range: [number, number] | null = null;
  private clip = { axis: -1, part: 0.5, flipped: false };
  private turn = 0; // of refresh()
  private pointer: { x: number; y: number } | null = null;

  constructor(
    private readonly about: Description,
    private readonly results: Result[],
    root: HTMLElement,
  ) {
    const first = results[0] as Result, start = about.start;
    this.bodies = results.map((r) => new Body(r));
    this.quantity = this.named(start.color) ?? defaultQuantity(first);
    this.look.scale = start.scale ?? 1;
    this.look.edges = first.mesh.faces.length / 3 < 3000 ? "mesh" : "shape";
    const stageHolder = element("div", { class: "stage" }), times = [...new Set(results.flatMap((r) => r.about.times))].sort((a, b) => a - b);
    this.legend = new Legend((range) => {
      this.range = range;
      this.colour();
      this.stage.draw();
    });
    this.player = new Player(times, this.isTimed(), () => this.refresh(), () => this.showTime());
    this.slider.max = String(times.length - 1);
    this.slider.addEventListener("input", () => void this.player.goTo(Number(this.slider.value)));
    this.play = button("▶", "Play (space)", () => this.player.toggle());
    const charts = element("div", { class: "charts" });
    this.curves = new Curves(charts, results, (time) => void this.player.goToTime(time));
    const names = element("div", { class: "names" }, ...results.map((r) => element("span", {}, r.about.name)));
    const bar = element("div", { class: "time" }, this.play, this.slider, this.clock, ...(this.isTimed() ? [this.speedChoice()] : []));
    const pictured = element("main", {}, element("div", { class: "holder" }, stageHolder, names, this.under),
      this.legend.node, bar);
    root.append(pictured, element("aside", {}, this.controls(), this.tableChoice(), charts, this.notes()));
    if (start.still) root.classList.add("still");
    this.stage = new Stage(stageHolder, this.bodies, start.still ?? false);
    stageHolder.addEventListener("pointermove", (e) => this.pointed({ x: e.clientX, y: e.clientY }));
    stageHolder.addEventListener("pointerleave", () => this.pointed(null));
    addEventListener("keydown", (e) => this.key(e));
  }

  async begin(): Promise<void> {
    this.colour();
    await this.player.goToTime(this.about.start.time ?? this.player.first);
    this.stage.fit(this.look.scale);
    const table = this.curves.tables()[0];
    if (table) await this.curves.show(table);
    this.showTime();
    this.stage.drawNow();
  }

  // For scripts and tests: what a value is at a place on the page, and where a node is.
  at(x: number, y: number): string {
    this.pointed({ x, y });
    return this.under.textContent ?? "";
  }
  place(x: number, y: number, z: number, pane = 0): { x: number; y: number } {
    return this.stage.place(new THREE.Vector3(x, y, z), pane);
  }
  async goTo(frame: number): Promise<void> {
    await this.player.goTo(frame);
    this.stage.drawNow();
  }
  async setColour(name: string): Promise<void> {
    this.quantity = this.named(name) ?? this.quantity;
    this.range = null;
    this.colour();
    await this.refresh();
    this.stage.drawNow();
  }

  private isTimed(): boolean {
    return this.results.every((r) => !r.about.static && !r.about.labels);
  }

  private named(name: string | undefined): Quantity | null {
    const all = this.results.flatMap((r) => r.about.quantities);
    return all.find((q) => q.name === name || q.key === name) ?? all.find((q) => q.field === name) ?? null;
  }

  private async refresh(): Promise<void> {
    const { quantity } = this, plane = this.plane(), turn = ++this.turn;
    for (const body of this.bodies) {
      const frame = body.result.frameAt(this.player.time), own = body.result.quantity(quantity.key);
      const [moved, values] = await Promise.all([body.result.displacement(frame), own && body.result.values(own, frame)]);
      if (turn !== this.turn) return; // another frame was asked for meanwhile
      if (this.player.playing && own)
        for (let ahead = 1; ahead <= AHEAD; ++ahead) body.result.prepare(own, frame + ahead);
      body.update(moved, values, own, this.look, plane);
    }
    this.stage.setPlane(plane);
    this.pointed(this.pointer);
    if (this.player.playing) this.stage.drawNow(); // within the frame of the clock that asked for it
    else this.stage.draw();
  }

  // The colours of the quantity and its range, on all bodies and in the legend.
  private colour(): void {
    const map = this.map(), texture = colourTexture(map), [low, high] = this.range ?? this.wholeRange();
    const [r = 230, g = 0, b = 126] = this.about.maps.nan, nan = new THREE.Color(r / 255, g / 255, b / 255);
    this.legend.show(this.quantity, map, low, high);
    for (const body of this.bodies) body.setColours(texture, map.colours.length, this.quantity, low, high, nan);
  }

  // Of all results that have the quantity: they are to be compared.
  private wholeRange(): [number, number] {
    const same = this.results.map((r) => r.quantity(this.quantity.key)).filter((q): q is Quantity => q !== null);
    return [Math.min(...same.map((q) => q.low)), Math.max(...same.map((q) => q.high))];
  }

  private map(): ColourMap {
    const { maps } = this.about, { categories, diverging } = this.quantity;
    return { colours: categories ? maps.categories : diverging ? maps.diverging : maps.sequential, categories };
  }

  private plane(): Plane | null {
    if (this.clip.axis < 0) return null;
    const box = this.bodies.reduce((all, body) => all.union(body.boxNow()), new THREE.Box3()), { axis, part, flipped } = this.clip;
    const place = box.min.getComponent(axis) + part * (box.max.getComponent(axis) - box.min.getComponent(axis));
    const normal: [number, number, number] = [0, 0, 0];
    normal[axis] = flipped ? -1 : 1;
    return { normal, offset: flipped ? -place : place };
  }

  private showTime(): void {
    const { player } = this, first = this.results[0] as Result, size = scaled("s", Math.max(Math.abs(player.first), Math.abs(player.last)));
    const label = first.about.labels?.[first.frameAt(player.time)];
    const text = label ?? (first.about.static
      ? `load factor ${figure(player.time, 4)}`
      : `t = ${figure(player.time / size.factor, 4)} ${size.unit}`);
    this.clock.textContent = `${text}  (${player.frame + 1} of ${player.times.length})`;
    this.slider.value = String(player.frame);
    this.slider.setAttribute("aria-valuetext", text);
    this.play.textContent = player.playing ? "❚❚" : "▶";
    this.curves.setTime(player.time);
  }

  private pointed(place: { x: number; y: number } | null): void {
    this.pointer = place;
    const hit = place && this.stage.pick(place.x, place.y);
    this.under.textContent = "";
    if (!hit) return;
    const { unit, label } = this.quantity, of = this.results[hit.pane];
    if (!of?.quantity(this.quantity.key)) {
      this.under.textContent = `${of?.about.name} has no ${label}`;
      return;
    }
    const number = this.quantity.categories ? String(Math.round(hit.value)) : withUnit(hit.value, unit);
    this.under.textContent = `${label}: ${number} · node ${hit.node} · element ${hit.cell}`;
  }

  private controls(): HTMLElement {
    const first = this.results[0] as Result;
    const colours = select(first.about.quantities.map((q) => [q.key, q.label]), (key) => void this.setColour(key));
    colours.value = this.quantity.key;
    const scales = [...new Set([...SCALES, this.look.scale])].sort((a, b) => a - b);
    const scale = select(scales.map((s) => [String(s), `× ${s}`]), (value) => {
      this.look.scale = Number(value);
      void this.refresh().then(() => this.stage.fit(this.look.scale));
    });
    scale.value = String(this.look.scale);
    const edges = select([["none", "none"], ["shape", "of the shape"], ["mesh", "of the mesh"]], (value) => {
      this.look.edges = value as Look["edges"];
      void this.refresh();
    });
    edges.id = "edges";
    edges.value = this.look.edges;
    const set = (key: "strokes" | "marks" | "rest") => (on: boolean) => {
      this.look[key] = on;
      void this.refresh();
    };
    const ticks: HTMLElement[] = [tick("rest shape", false, set("rest"))];
    if (first.strokes) ticks.push(tick("grain: material axis 1", false, set("strokes"), "grain"));
    if (first.about.setup.held || first.about.setup.loaded) ticks.push(tick("clamps and loads", true, set("marks")));
    const views = element("div", { class: "row buttons" }, ...Object.entries(VIEWS).map(([key, [name, a, e]]) =>
      button(name, `View ${name} (${key})`, () => this.stage.look(a, e))));
    const picture = button("save picture", "The picture as PNG", () => this.savePicture());
    return element("section", { class: "controls" }, labelled("colour", colours), labelled("deformation", scale), labelled("edges", edges),
      this.clipChoice(), element("div", { class: "row ticks" }, ...ticks), views,
      element("div", { class: "row buttons" }, picture, button("dark / light", "Colours of the page", toggleTheme)),
      element("details", {}, element("summary", {}, "keys"), element("p", {}, KEYS)));
  }

  private clipChoice(): HTMLElement {
    const place = element("input", { type: "range", min: 0, max: 1, step: 0.005, "aria-label": "place of the clip plane" });
    const side = button("⇄", "The other side", () => {
      this.clip.flipped = !this.clip.flipped;
      void this.refresh();
    });
    place.value = String(this.clip.part);
    place.disabled = side.disabled = true;
    place.addEventListener("input", () => {
      this.clip.part = Number(place.value);
      void this.refresh();
    });
    const axis = select([["-1", "none"], ["0", "across x"], ["1", "across y"], ["2", "across z"]], (value) => {
      this.clip.axis = Number(value);
      place.disabled = side.disabled = this.clip.axis < 0;
      void this.refresh();
    });
    axis.id = "clip";
    const inside = this.results.every((r) => r.about.volume);
    const note = inside ? [] : [element("p", { class: "hint" }, "hollow: what is inside is shown with --volume")];
    return element("div", {}, labelled("clip plane", axis, place, side), ...note);
  }

  private speedChoice(): HTMLElement {
    const made = select(Player.speeds().map((s) => [String(s), s === 1 ? "true time" : `${s} × true time`]),
      (value) => this.player.setSpeed(Number(value)));
    made.setAttribute("aria-label", "speed");
    made.value = String(this.player.speed);
    return made;
  }

  private tableChoice(): HTMLElement {
    const tables = this.curves.tables();
    if (tables.length < 2) return element("div");
    return element("section", { class: "controls" }, labelled("curves", select(tables.map((t) => [t, t]), (table) =>
      void this.curves.show(table).then(() => this.showTime()))));
  }

  private notes(): HTMLElement {
    const lines = this.results.flatMap(({ about }) => {
      const warnings = (about.notes.warnings ?? []).map((w) => `warning: ${w}`);
      const status = about.notes.status && about.notes.status !== "completed" ? [`the run ${about.notes.status}`] : [];
      return [`${about.name}: ${about.cells} elements, ${about.times.length} frames`, ...status, ...warnings];
    });
    return element("section", { class: "notes" }, ...lines.map((line) => element("p", {}, line)));
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || /^(SELECT|TEXTAREA)$/.test(target.tagName)) return;
    if (target.tagName === "INPUT" && target !== this.slider) return;
    const { player } = this, view = VIEWS[event.key];
    const actions: Record<string, () => void> = {
      " ": () => player.toggle(), ArrowLeft: () => void player.goTo(player.frame - 1),
      ArrowRight: () => void player.goTo(player.frame + 1), Home: () => void player.goTo(0),
      End: () => void player.goTo(player.times.length - 1), e: () => this.next("#edges"), c: () => this.next("#clip"),
      g: () => document.querySelector<HTMLInputElement>("#grain")?.click(),
    };
    const action = view ? () => this.stage.look(view[1], view[2]) : actions[event.key];
    if (!action || (target.tagName === "BUTTON" && event.key === " ")) return;
    event.preventDefault();
    action();
  }

  private next(id: string): void {
    const chosen = document.querySelector<HTMLSelectElement>(id);
    if (!chosen) return;
    chosen.selectedIndex = (chosen.selectedIndex + 1) % chosen.options.length;
    chosen.dispatchEvent(new Event("change"));
  }

  private savePicture(): void {
    this.stage.drawNow();
    const link = element("a", { download: `${this.results[0]?.about.name ?? "view"}.png`, href: this.stage.canvas.toDataURL("image/png") });
    link.click();
  }
}

function defaultQuantity(result: Result): Quantity {
  const all = result.about.quantities, wanted = ["nodal_stress.von_mises", "von_mises.0", "stress.von_mises", "displacement.magnitude"];
  const found = wanted.map((key) => all.find((q) => q.key === key)).find((q) => q !== undefined) ?? all[0];
  if (!found) throw new Error("the result has no field");
  return found;
}

function toggleTheme(): void {
  const root = document.documentElement, dark = matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset["theme"] = (root.dataset["theme"] ?? (dark ? "dark" : "light")) === "dark" ? "light" : "dark";
}

THREE.ColorManagement.enabled = false; // colours as they are given

async function begin(): Promise<View> {
  const about = readDescription(), root = document.getElementById("view");
  if (!root) throw new Error("the page has no place for the view");
  const results = await Promise.all(about.results.map((r, k) => Result.read(`r${k}`, r)));
  const view = new View(about, results, root);
  await view.begin();
  return view;
}

declare global {
  interface Window {
    orthodynView: Promise<View>;
  }
}
window.orthodynView = begin();
window.orthodynView.catch((error: unknown) => {
  const text = `The view could not be shown: ${error instanceof Error ? error.message : String(error)}`;
  document.getElementById("view")?.append(element("p", { class: "failed" }, text));
});
