// Which results of the page are shown, and the view of them: see description.ts for what the page holds.
import { ColorManagement } from "three";
import { element } from "./dom";
import { Result } from "./result";
import { View, type Kept } from "./view";
import { readDescription, type Description } from "./description";

ColorManagement.enabled = false; // colours as they are given

const NONE = -1;

class Page {
  private panes: number[];
  private view: View | null = null;

  constructor(
    private readonly about: Description,
    private readonly root: HTMLElement,
  ) {
    this.panes = about.start.panes;
  }

  async show(): Promise<View> {
    const { about, panes } = this;
    const results = await Promise.all(panes.map((k) => Result.read(`r${k}`, about.results[k] as Result["about"])));
    const kept: Kept | null = this.view?.end() ?? null;
    this.root.replaceChildren();
    const view = new View(about, results, this.names(), this.root, kept);
    this.view = view;
    await view.begin();
    return view;
  }

  // A name where there is no choice, else what may be chosen, and in the last place also nothing.
  private names(): HTMLElement[] {
    const { results } = this.about;
    if (results.length === this.panes.length || this.about.start.still)
      return this.panes.map((k) => element("span", {}, results[k]?.name ?? ""));
    const first = this.choice(0, this.panes[0] ?? 0), second = this.choice(1, this.panes[1] ?? NONE);
    return this.panes.length > 1 ? [first, second] : [element("span", { class: "choices" }, first, second)];
  }

  private choice(pane: number, chosen: number): HTMLSelectElement {
    const made = element("select", { "aria-label": pane ? "beside it" : "shown" });
    if (pane) made.append(element("option", { value: NONE }, this.panes.length > 1 ? "nothing beside it" : "beside it …"));
    const groups = new Map<string, HTMLElement>([["", made]]);
    this.about.results.forEach(({ name, group }, k) => {
      if (!groups.has(group)) {
        const added = element("optgroup", { label: group });
        groups.set(group, added);
        made.append(added);
      }
      groups.get(group)?.append(element("option", { value: k }, name));
    });
    made.value = String(chosen);
    made.addEventListener("change", () => this.choose(pane, Number(made.value)));
    return made;
  }

  private choose(pane: number, result: number): void {
    if (result === NONE) this.panes = this.panes.slice(0, 1);
    else this.panes[pane] = result;
    window.orthodynView = this.show();
  }
}

async function begin(): Promise<View> {
  const root = document.getElementById("view");
  if (!root) throw new Error("the page has no place for the view");
  return new Page(readDescription(), root).show();
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
