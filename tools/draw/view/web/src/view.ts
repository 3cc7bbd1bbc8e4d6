// Shows one or more results with all controls. description.ts describes the page's data.
import * as THREE from "three";
import { Body, type Look } from "./body";
import { Clip, type Clipped } from "./clip";
import { Curves } from "./curves";
import { button, element, labelled, select, tick } from "./dom";
import { Legend } from "./legend";
import { colourTexture, type ColourMap } from "./material";
import { Player } from "./player";
import { Result } from "./result";
import { Stage } from "./stage";
import { formatted, round, scaled, withUnit } from "./units";
import type { Description, Quantity } from "./description";
import type { Plane } from "./section";

const VIEWS: Record<string, [string, number, number]> = {
  "1": ["from the side", -60, 20], "2": ["along x", 180, 0], "3": ["along y", -90, 0], "4": ["from above", -90, 90],
};
const KEYS = "space: play; ← →: a frame back, on; Home, End: first, last; 1 – 4: views; e: edges; g: grain; c: clip plane; " +
  "drag: turn; right button or two fingers: move; wheel: nearer";
const SWING_SECONDS = 2; // period of an oscillating mode shape
const AHEAD = 3; // number of frames decoded in advance during playback
const SCALES = [0.1, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 1e4, 1e5];

// Settings that are kept when other results are chosen.
export interface Kept {
  time: number;
  quantity: Quantity;
  range: [number, number] | null; // colour range; null: the default one
  look: Look;
  clip: Clipped;
  direction: [number, number]; // azimuth and elevation, in degrees
  speed: number; // see Player
  table: string | null; // name of the plotted table; null: none
}

export class View {
  private readonly bodies: Body[];
  private readonly stage: Stage;
  private readonly player: Player;
  private readonly legend: Legend;
  private readonly curves: Curves;
  private readonly under = element("output", { class: "under", "aria-live": "polite" });
  private readonly slider = element("input", { type: "range", min: 0, step: 1, "aria-label": "time" });
  private readonly clock = element("output", { class: "clock" });
  private readonly play: HTMLButtonElement;
  private look: Look = { scale: 1, edges: "shape", strokes: 0, marks: true, rest: false };
  private quantity: Quantity;
  private range: [number, number] | null = null; // colour range; null: the default one
  private readonly clip: Clip;
  private readonly labels: HTMLElement[]; // one text above each result: see showLabels()
  private readonly listening = new AbortController();
  private table: string | null = null;
  private tableChosen = element("select");
  private turn = 0; // number of calls of refresh()
  private swing = 1; // momentary factor of an oscillating mode shape, -1 to 1
  private swinging = false;
  private pointer: { x: number; y: number } | null = null;

  constructor(
    private readonly about: Description,
    private readonly results: Result[],
    names: HTMLElement[], // headings, one per result
    root: HTMLElement,
    private readonly before: Kept | null,
  ) {
    const first = results[0] as Result, start = about.start;
    this.bodies = results.map((r) => new Body(r));
    this.quantity = this.named(before ? before.quantity.key : start.color) ?? defaultQuantity(first);
    this.look.scale = start.scale ?? 1;
    this.look.rest = start.rest ?? false;
    this.look.edges = first.mesh.faces.length / 3 < 3000 ? "mesh" : "shape";
    if (before) this.look = { ...before.look };
    if (start.range) this.range = start.range;
    if (before) this.range = null;
    if (before && before.quantity.key === this.quantity.key) this.range = before.range;
    const isHollow = !results.every((r) => r.about.volume);
    this.clip = new Clip(before?.clip ?? null, isHollow, () => this.stage.toward(), () => void this.refresh());
    const stageHolder = element("div", { class: "stage" }), times = [...new Set(results.flatMap((r) => r.about.times))].sort((a, b) => a - b);
    this.legend = new Legend((range) => {
      this.range = range;
      this.colour();
      this.stage.draw();
    });
    this.player = new Player(times, this.isTimed(), () => this.refresh(), () => this.showTime());
    if (before) this.player.setSpeed(before.speed);
    this.slider.max = String(times.length - 1);
    this.slider.addEventListener("input", () => void this.player.goTo(Number(this.slider.value)));
    this.play = button("▶", "Play (space)", () => this.togglePlay());
    const charts = element("div", { class: "charts" });
    this.curves = new Curves(charts, results, (time) => void this.player.goToTime(time));
    this.labels = results.map(() => element("small", { class: "label" }));
    const named = element("div", { class: "names" }, ...names.map((name, k) =>
      element("div", { class: "pane" }, name, this.labels[k] as HTMLElement, ...(k ? [] : [this.under]))));
    const bar = element("div", { class: "time" }, this.play, this.slider, this.clock, ...(this.isTimed() ? [this.speedChoice()] : []));
    const pictured = element("main", {}, element("div", { class: "holder" }, stageHolder, named),
      this.legend.node, bar);
    root.append(pictured, element("aside", {}, this.controls(), this.tableChoice(), charts, this.notes()));
    if (start.still) root.classList.add("still");
    this.stage = new Stage(stageHolder, this.bodies, start.still ?? false);
    stageHolder.addEventListener("pointermove", (e) => this.pointed({ x: e.clientX, y: e.clientY }));
    stageHolder.addEventListener("pointerleave", () => this.pointed(null));
    addEventListener("keydown", (e) => this.key(e), { signal: this.listening.signal });
  }

  // Stops this view. Call before another view replaces it; returns the settings for that view.
  end(): Kept {
    const { quantity, range, look, table } = this, speed = this.player.speed, clip = this.clip.clipped;
    const kept = { time: this.player.time, quantity, range, look, clip, direction: this.stage.eye(), speed, table };
    if (this.player.playing) this.player.toggle();
    this.swinging = false;
    ++this.turn; // discards frames that are still being decoded
    this.listening.abort();
    this.stage.end();
    return kept;
  }

  // Shows the first frame. Mode shapes start to oscillate unless the user prefers reduced motion.
  async begin(): Promise<void> {
    this.colour();
    await this.player.goToTime(this.before?.time ?? this.about.start.time ?? this.player.first);
    this.stage.fit(this.look.scale);
    if (this.before) this.stage.look(...this.before.direction);
    const tables = this.curves.tables();
    this.table = tables.find((t) => t === this.before?.table) ?? tables[0] ?? null;
    this.tableChosen.value = this.table ?? "";
    if (this.table) await this.curves.show(this.table);
    this.showTime();
    this.stage.drawNow();
    const { swing, still } = this.about.start;
    if (swing && !still && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.togglePlay();
  }

  // Starts or stops playback or, for mode shapes, the oscillation.
  private togglePlay(): void {
    if (!this.about.start.swing) return this.player.toggle();
    this.swinging = !this.swinging;
    const began = performance.now();
    const advance = async (): Promise<void> => {
      this.swing = this.swinging ? Math.cos((2 * Math.PI * (performance.now() - began)) / 1000 / SWING_SECONDS) : 1;
      await this.refresh();
      if (this.swinging) requestAnimationFrame(() => void advance());
    };
    void advance();
    this.showTime();
  }

  // For scripts and tests: the text about the value at a place on the page, in CSS pixels; "" if no body is there.
  at(x: number, y: number): string {
    this.pointed({ x, y });
    return this.under.textContent ?? "";
  }
  // For scripts and tests: the place on the page of a point in a pane.
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

  // The quantity with this name or key, else the first one of the field with this name; null if there is none.
  private named(name: string | undefined): Quantity | null {
    const all = this.results.flatMap((r) => r.about.quantities);
    return all.find((q) => q.name === name || q.key === name) ?? all.find((q) => q.field === name) ?? null;
  }

  private async refresh(): Promise<void> {
    const { quantity } = this, plane = this.plane(), turn = ++this.turn;
    const look = { ...this.look, scale: this.swing * this.look.scale };
    for (const body of this.bodies) {
      const frame = body.result.frameAt(this.player.time), own = body.result.quantity(quantity.key);
      const [moved, values] = await Promise.all([body.result.displacement(frame), own && body.result.values(own, frame)]);
      if (turn !== this.turn) return; // a newer call has started
      if (this.player.playing && own)
        for (let ahead = 1; ahead <= AHEAD; ++ahead) body.result.prepare(own, frame + ahead);
      body.update(moved, values, own, look, plane);
    }
    this.stage.setPlane(plane);
    this.pointed(this.pointer);
    if (this.player.playing || this.swinging) this.stage.drawNow(); // in the same animation frame
    else this.stage.draw();
  }

  // Applies the colour map and range of the quantity to all bodies and the legend.
  private colour(): void {
    const map = this.map(), texture = colourTexture(map), [low, high] = this.range ?? this.wholeRange();
    const [r = 230, g = 0, b = 126] = this.about.maps.nan, nan = new THREE.Color(r / 255, g / 255, b / 255);
    this.legend.show(this.quantity, map, [low, high], this.allValues());
    this.showLabels();
    for (const body of this.bodies) body.setColours(texture, map.colours.length, this.quantity, low, high, nan);
  }

  // Default colour range: the union over all results that have the quantity, so that their colours can be compared.
  private wholeRange(): [number, number] {
    const same = this.results.map((r) => r.quantity(this.quantity.key)).filter((q): q is Quantity => q !== null);
    return [Math.min(...same.map((q) => q.low)), Math.max(...same.map((q) => q.high))];
  }

  // Range of all values of the results shown; null if none is finite.
  private allValues(): [number, number] | null {
    const same = this.results.map((r) => r.quantity(this.quantity.key)).filter((q): q is Quantity => q !== null);
    const least = same.flatMap((q) => q.least ?? []), most = same.flatMap((q) => q.most ?? []);
    return least.length ? [Math.min(...least), Math.max(...most)] : null;
  }

  // For example "deflections enlarged 200 times". "" if the scale is 1, and for mode shapes, whose size is arbitrary.
  private enlarged(result: Result): string {
    const { scale } = this.look;
    if (scale === 1 || result.about.shape) return "";
    return scale > 1 ? `deflections enlarged ${round(scale)} times` : `deflections × ${round(scale)}`;
  }

  // Shows above each result: the label of the frame, if any; the displacement scale; whether the quantity is missing.
  private showLabels(): void {
    this.results.forEach((r, k) => {
      const lacks = r.quantity(this.quantity.key) ? "" : `has no ${this.quantity.label}`;
      const own = r.about.labels?.[r.frameAt(this.player.time)] ?? "";
      (this.labels[k] as HTMLElement).textContent = [own, this.enlarged(r), lacks].filter((text) => text).join("; ");
    });
  }

  private map(): ColourMap {
    const { maps } = this.about, { categories, diverging } = this.quantity;
    return { colours: categories ? maps.categories : diverging ? maps.diverging : maps.sequential, categories };
  }

  private plane(): Plane | null {
    return this.clip.plane(this.bodies.reduce((all, body) => all.union(body.boxNow()), new THREE.Box3()));
  }

  private showTime(): void {
    const { player } = this, size = scaled("s", Math.max(Math.abs(player.first), Math.abs(player.last)));
    const labels = this.results.map((r) => r.about.labels?.[r.frameAt(player.time)] ?? "");
    this.showLabels();
    const isStatic = this.results.some((r) => r.about.static);
    const said = isStatic ? `load factor ${formatted(player.time, 4)}` : `t = ${formatted(player.time / size.factor, 4)} ${size.unit}`;
    const text = labels[0] || said, count = `${player.frame + 1} of ${player.times.length}`;
    this.clock.textContent = labels.some((l) => l) ? count : `${said}  (${count})`;
    this.slider.value = String(player.frame);
    this.slider.setAttribute("aria-valuetext", text);
    this.play.textContent = player.playing || this.swinging ? "❚❚" : "▶";
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
    const digits = this.quantity.neutral ? 6 : 3; // values such as volume ratios differ little from 1
    const number = this.quantity.categories ? String(Math.round(hit.value)) : withUnit(hit.value, unit, digits);
    this.under.textContent = `${label}: ${number} · node ${hit.node} · element ${hit.cell}`;
  }

  private controls(): HTMLElement {
    const quantities = new Map(this.results.flatMap((r) => r.about.quantities).map((q) => [q.key, q.label]));
    const colours = select([...quantities], (key) => void this.setColour(key));
    colours.value = this.quantity.key;
    const scales = [...new Set([...SCALES, this.look.scale])].sort((a, b) => a - b);
    const scale = select(scales.map((s) => [String(s), `× ${s}`]), (value) => {
      this.look.scale = Number(value);
      this.showLabels();
      void this.refresh().then(() => this.stage.fit(this.look.scale));
    });
    scale.value = String(this.look.scale);
    const edges = select([["none", "none"], ["shape", "of the shape"], ["mesh", "of the mesh"]], (value) => {
      this.look.edges = value as Look["edges"];
      void this.refresh();
    });
    edges.id = "edges";
    edges.value = this.look.edges;
    const set = (key: "marks" | "rest") => (on: boolean) => {
      this.look[key] = on;
      void this.refresh();
    };
    const ticks: HTMLElement[] = [tick("rest shape", this.look.rest, set("rest"))];
    if (this.results.some((r) => r.about.setup.held || r.about.setup.loaded))
      ticks.push(tick("clamps and loads", this.look.marks, set("marks")));
    const views = element("div", { class: "row buttons" }, ...Object.entries(VIEWS).map(([key, [name, a, e]]) =>
      button(name, `View ${name} (${key})`, () => this.stage.look(a, e))));
    const picture = button("save picture", "The picture as PNG", () => this.savePicture());
    return element("section", { class: "controls" }, labelled("colour", colours), labelled("deformation", scale), labelled("edges", edges),
      ...this.grainChoice(), this.clip.node, element("div", { class: "row ticks" }, ...ticks), views,
      element("div", { class: "row buttons" }, picture, button("dark / light", "Colours of the page", toggleTheme)),
      element("details", {}, element("summary", {}, "keys"), element("p", {}, KEYS)));
  }

  private grainChoice(): HTMLElement[] {
    const axes = [...new Set(this.results.flatMap((r) => r.about.strokes))].sort();
    if (!axes.length) return [];
    const made = select([["0", "none"], ...axes.map((a): [string, string] => [String(a), `material axis ${a}`])], (axis) => {
      this.look.strokes = Number(axis);
      void this.refresh();
    });
    made.id = "grain";
    made.value = String(this.look.strokes);
    return [labelled("grain", made)];
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
    this.tableChosen = select(tables.map((t) => [t, t]), (table) => {
      this.table = table;
      void this.curves.show(table).then(() => this.showTime());
    });
    return element("section", { class: "controls" }, labelled("curves", this.tableChosen));
  }

  private notes(): HTMLElement {
    const lines = this.results.flatMap(({ about }) => {
      const warnings = (about.notes.warnings ?? []).map((w) => `warning: ${w}`);
      const status = about.notes.status && about.notes.status !== "completed" ? [`the run ${about.notes.status}`] : [];
      const counts = `${counted(about.cells, "element")}, ${counted(about.times.length, "frame")}`;
      return [[`${about.name}: ${counts}`, ...about.facts].join("; "), ...status, ...warnings];
    });
    return element("section", { class: "notes" }, ...lines.map((line) => element("p", {}, line)));
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || /^(SELECT|TEXTAREA)$/.test(target.tagName)) return;
    if (target.tagName === "INPUT" && target !== this.slider) return;
    const { player } = this, view = VIEWS[event.key];
    const actions: Record<string, () => void> = {
      " ": () => this.togglePlay(), ArrowLeft: () => void player.goTo(player.frame - 1),
      ArrowRight: () => void player.goTo(player.frame + 1), Home: () => void player.goTo(0),
      End: () => void player.goTo(player.times.length - 1), e: () => this.next("#edges"), c: () => this.next("#clip"),
      g: () => this.next("#grain"),
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

  // The canvas as a PNG data URL, with a note at the bottom if deflections are scaled.
  picture(): string {
    this.stage.drawNow();
    const { canvas } = this.stage, said = this.results.map((r) => this.enlarged(r)).find((text) => text) ?? "";
    const made = element("canvas", { width: canvas.width, height: canvas.height }), pen = made.getContext("2d");
    if (!said || !pen) return canvas.toDataURL("image/png");
    const height = 14 * (canvas.width / Math.max(canvas.clientWidth, 1));
    pen.drawImage(canvas, 0, 0);
    pen.font = `${height}px sans-serif`;
    pen.fillStyle = getComputedStyle(document.body).color;
    pen.fillText(said, height, canvas.height - height);
    return made.toDataURL("image/png");
  }

  private savePicture(): void {
    const link = element("a", { download: `${this.results[0]?.about.name ?? "view"}.png`, href: this.picture() });
    link.click();
  }
}

function defaultQuantity(result: Result): Quantity {
  const all = result.about.quantities, wanted = ["nodal_stress.von_mises", "von_mises.0", "stress.von_mises", "displacement.magnitude"];
  const found = wanted.map((key) => all.find((q) => q.key === key)).find((q) => q !== undefined) ?? all[0];
  if (!found) throw new Error("the result has no field");
  return found;
}

function counted(number: number, noun: string): string {
  return `${number} ${noun}${number === 1 ? "" : "s"}`;
}

function toggleTheme(): void {
  const root = document.documentElement, dark = matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset["theme"] = (root.dataset["theme"] ?? (dark ? "dark" : "light")) === "dark" ? "light" : "dark";
}
