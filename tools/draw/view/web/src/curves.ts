// Plots the columns of a table over time as SVG, with a cursor at the time shown.
import { floats } from "./blocks";
import { element, svg } from "./dom";
import { round, scaled } from "./units";
import type { Curve } from "./description";
import type { Result } from "./result";

const WIDTH = 420, HEIGHT = 150, LEFT = 52, RIGHT = 16, TOP = 8, BOTTOM = 22;
export const COLOURS = ["#3f73c8", "#d1622b", "#2e8b57", "#9b59b6", "#b8860b", "#c0392b", "#2a93a7", "#7a828e"];

interface Line {
  label: string;
  colour: string;
  dashed: boolean;
  times: Float32Array;
  values: Float32Array;
}

export class Curves {
  private readonly cursors: { line: SVGElement; at: (t: number) => number }[] = [];

  constructor(
    private readonly holder: HTMLElement,
    private readonly results: Result[],
    private readonly seek: (time: number) => void,
  ) {}

  // The names of the tables that at least one result has.
  tables(): string[] {
    return [...new Set(this.results.flatMap((r) => r.about.curves.map((c) => c.table)))];
  }

  // Plots a table, with one chart per unit.
  async show(table: string): Promise<void> {
    const lines = new Map<string, Line[]>();
    for (const [k, result] of this.results.entries())
      for (const [unit, found] of await linesOf(result, table, k)) lines.set(unit, [...(lines.get(unit) ?? []), ...found]);
    this.cursors.length = 0;
    this.holder.replaceChildren(...[...lines].map(([unit, found]) => this.chart(unit, found)));
  }

  setTime(time: number): void {
    for (const { line, at } of this.cursors) {
      const x = at(time).toFixed(2);
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
    }
  }

  private chart(unit: string, lines: Line[]): HTMLElement {
    const times = lines.map((l) => l.times), first = Math.min(...times.map((t) => t[0] ?? 0));
    const last = Math.max(...times.map((t) => t[t.length - 1] ?? 1)), timeUnit = this.results[0]?.about.static ? "" : "s";
    const [low, high] = range(lines), size = scaled(unit, Math.max(Math.abs(low), Math.abs(high)));
    const x = (t: number) => LEFT + ((t - first) / (last - first || 1)) * (WIDTH - LEFT - RIGHT);
    const y = (v: number) => TOP + ((high - v) / (high - low || 1)) * (HEIGHT - TOP - BOTTOM);
    const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": lines.map((l) => l.label).join(", ") });
    for (const v of ticks(low / size.factor, high / size.factor, 4)) {
      const at = y(v * size.factor);
      picture.append(svg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: at, y2: at, class: "grid" }));
      picture.append(svg("text", { x: LEFT - 5, y: at + 3.5, class: "tick end" }, round(v)));
    }
    const time = scaled(timeUnit, Math.max(Math.abs(first), Math.abs(last)));
    for (const t of ticks(first / time.factor, last / time.factor, 5))
      picture.append(svg("text", { x: x(t * time.factor), y: HEIGHT - 7, class: "tick middle" }, round(t)));
    for (const line of lines)
      picture.append(svg("path", { d: path(line, x, y), stroke: line.colour, class: line.dashed ? "curve dashed" : "curve" }));
    const cursor = svg("line", { y1: TOP, y2: HEIGHT - BOTTOM, class: "cursor" });
    picture.append(cursor);
    this.cursors.push({ line: cursor, at: x });
    picture.addEventListener("click", (event) => {
      const bounds = picture.getBoundingClientRect(), place = ((event.clientX - bounds.left) / bounds.width) * WIDTH;
      this.seek(first + ((place - LEFT) / (WIDTH - LEFT - RIGHT)) * (last - first));
    });
    const names = lines.map((l) =>
      element("span", { class: l.dashed ? "name dashed" : "name", style: `--line:${l.colour}` }, l.label));
    const axis = `${size.unit || "–"} over ${timeUnit ? `time, ${time.unit}` : "load factor"}`;
    return element("figure", { class: "chart" }, element("figcaption", {}, ...names, element("span", { class: "unit" }, axis)), picture);
  }
}

async function linesOf(result: Result, table: string, index: number): Promise<Map<string, Line[]>> {
  const curves = result.about.curves.filter((c) => c.table === table), found = new Map<string, Line[]>();
  if (!curves.length) return found;
  const columns = Math.max(...curves.map((c) => c.column)) + 1, rows = await floats(`${result.key}/${table}.csv`);
  const column = (k: number) => Float32Array.from({ length: rows.length / columns }, (_, i) => rows[i * columns + k] as number);
  const times = column(0);
  curves.forEach((curve: Curve) => {
    const same = found.get(curve.unit) ?? [], label = index ? `${curve.name}, ${result.about.name}` : curve.name;
    same.push({ label, colour: COLOURS[same.length % COLOURS.length] as string, dashed: index > 0, times, values: column(curve.column) });
    found.set(curve.unit, same);
  });
  return found;
}

function range(lines: Line[]): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const { values } of lines)
    for (const v of values)
      if (Number.isFinite(v)) [low, high] = [Math.min(low, v), Math.max(high, v)];
  if (!(low <= high)) return [0, 1];
  const room = 0.04 * (high - low) || 0.1 * Math.abs(high) || 1;
  return [low - room, high + room];
}

function path(line: Line, x: (t: number) => number, y: (v: number) => number): string {
  let text = "", drawing = false;
  line.values.forEach((v, k) => {
    const known = Number.isFinite(v);
    if (known) text += `${drawing ? "L" : "M"}${x(line.times[k] as number).toFixed(1)} ${y(v).toFixed(1)}`;
    drawing = known;
  });
  return text;
}

// About `count` evenly spaced round numbers from `low` to `high`.
export function ticks(low: number, high: number, count: number): number[] {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough || 1));
  const step = power * ([1, 2, 2.5, 5].find((m) => m >= 0.7 * (rough / power)) ?? 10), out: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push(k * step || 0);
  return out;
}
