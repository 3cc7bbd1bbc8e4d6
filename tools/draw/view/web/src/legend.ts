// The colour bar, whose range the user can edit.
import { button, element } from "./dom";
import { round, scaled } from "./units";
import { ticks } from "./curves";
import type { ColourMap } from "./material";
import type { Quantity } from "./description";

export class Legend {
  readonly node = element("div", { class: "legend" });

  // `change` receives the new colour range; null: the default one.
  constructor(private readonly change: (range: [number, number] | null) => void) {}

  // [low, high] is the colour range shown. `all` is the range of all values; null if none is finite.
  show(quantity: Quantity, map: ColourMap, [low, high]: [number, number], all: [number, number] | null): void {
    const size = scaled(quantity.unit, Math.max(Math.abs(low), Math.abs(high)));
    const unit = size.unit && size.unit !== "1" ? `, ${size.unit}` : "";
    const title = element("div", { class: "legend-title" }, quantity.label + unit);
    if (quantity.categories) {
      this.node.replaceChildren(title);
      return;
    }
    const bar = element("div", { class: "bar", style: `background:linear-gradient(to right,${css(map)})` });
    const marks = element("div", { class: "marks" });
    for (const v of ticks(low / size.factor, high / size.factor, 4)) {
      const place = (100 * (v * size.factor - low)) / (high - low);
      marks.append(element("span", { style: `left:${place.toFixed(2)}%` }, round(v)));
    }
    const ends = [low, high].map((end, k) => {
      const input = element("input", { type: "number", step: "any", "aria-label": k ? "largest colour" : "smallest colour" });
      input.value = String(Number((end / size.factor).toPrecision(quantity.neutral ? 7 : 4)));
      input.addEventListener("change", () => {
        const value = Number(input.value) * size.factor, range: [number, number] = k ? [low, value] : [value, high];
        if (Number.isFinite(value) && range[0] < range[1]) this.change(range);
        else input.value = String(Number((end / size.factor).toPrecision(4)));
      });
      return input;
    });
    const whole = button("↺", "Default range, without outliers", () => this.change(null));
    const range = element("div", { class: "range" }, ends[0] as Node, "to", ends[1] as Node, whole);
    this.node.replaceChildren(title, bar, marks, range);
    if (!all || (all[0] >= low - 1e-3 * (high - low) && all[1] <= high + 1e-3 * (high - low))) return;
    const [least, most] = all.map((end) => round(Number((end / size.factor).toPrecision(4))));
    this.node.append(button(`values from ${least} to ${most}`, "Colours for all values", () => this.change([Math.min(low, all[0]), Math.max(high, all[1])])));
  }
}

function css(map: ColourMap): string {
  return map.colours.filter((_, k) => k % 15 === 0).map(([r, g, b]) => `rgb(${r},${g},${b})`).join(",");
}
