// Entry point: lets the user choose results of the page and shows them in a View. description.ts describes the page's data.
import { ColorManagement } from "three";
import { element } from "./dom";
import { Result } from "./result";
import { View, type Kept } from "./view";
import { readDescription, type Description } from "./description";

ColorManagement.enabled = false; // use RGB values unchanged

const NONE = -1;

class Page {
  private panes: number[];
  private view: View | null = null;
  private turn = 0; // number of calls of show()
  private readonly results = new Map<number, Promise<Result>>(); // results shown, by index

  constructor(
    private readonly about: Description,
    private readonly root: HTMLElement,
  ) {
    this.panes = about.start.panes;
  }

  // Shows the chosen results. If the choice changes while they load, only the latest choice is shown.
  async show(): Promise<View> {
    const turn = ++this.turn, { panes } = this, results = await Promise.all(panes.map((k) => this.result(k)));
    if (turn !== this.turn) return window.orthodynView;
    for (const k of this.results.keys()) if (!panes.includes(k)) this.results.delete(k); // frees the memory of their frames
    const kept: Kept | null = this.view?.end() ?? null;
    this.root.replaceChildren();
    const view = new View(this.about, results, this.names(panes), this.root, kept);
    this.view = view;
    await view.begin();
    return view;
  }

  private result(k: number): Promise<Result> {
    const known = this.results.get(k) ?? Result.read(`r${k}`, this.about.results[k] as Result["about"]);
    this.results.set(k, known);
    return known;
  }

  // One heading per pane: a name if there is nothing to choose, else a list. The second list also offers "nothing".
  private names(panes: number[]): HTMLElement[] {
    const { results } = this.about;
    if (results.length === panes.length || this.about.start.still)
      return panes.map((k) => element("span", {}, results[k]?.name ?? ""));
    const first = this.choice(0, panes[0] ?? 0), second = this.choice(1, panes[1] ?? NONE);
    return panes.length > 1 ? [first, second] : [element("span", { class: "choices" }, first, second)];
  }

  private choice(pane: number, chosen: number): HTMLSelectElement {
    const made = element("select", { "aria-label": pane ? "beside it" : "shown" });
    if (pane) made.append(element("option", { value: NONE }, this.panes.length > 1 ? "nothing beside it" : "beside it …"));
    const groups = new Map<string, HTMLElement>([["", made]]), groupCount = new Set(this.about.results.map((r) => r.group)).size;
    this.about.results.forEach(({ name, group }, k) => {
      if (!groups.has(group)) {
        const added = element("optgroup", { label: group });
        groups.set(group, added);
        made.append(added);
      }
      const places = { value: k, title: group };
      groups.get(group)?.append(element("option", places, groupCount > 1 && group ? `${name} · ${group}` : name));
    });
    made.value = String(chosen);
    made.addEventListener("change", () => this.choose(pane, Number(made.value)));
    return made;
  }

  private choose(pane: number, result: number): void {
    const [first, second] = this.panes;
    this.panes = pane === 0 ? [result, ...(second === undefined ? [] : [second])] : [first as number, ...(result === NONE ? [] : [result])];
    shown(this.show().then((view) => {
      document.querySelectorAll<HTMLSelectElement>(".names select")[pane]?.focus(); // the list was created anew: restore the focus
      return view;
    }));
  }
}

// Makes the view available to scripts and tests as window.orthodynView. Shows a message on the page if the view fails.
function shown(view: Promise<View>): void {
  window.orthodynView = view;
  view.catch((error: unknown) => {
    const text = `The view could not be shown: ${error instanceof Error ? error.message : String(error)}`;
    document.getElementById("view")?.replaceChildren(element("p", { class: "failed" }, text));
  });
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
shown(begin());
