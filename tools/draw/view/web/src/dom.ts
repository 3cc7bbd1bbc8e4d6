// Creates HTML and SVG elements with attributes and children.
type Child = Node | string;

export function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Record<string, string | number> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

export function svg(name: string, attributes: Record<string, string | number> = {}, ...children: Child[]): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

let labels = 0;

// A row with a label, a control, and further elements after the control.
export function labelled(text: string, control: HTMLElement, ...after: Child[]): HTMLElement {
  control.id ||= `control-${++labels}`;
  return element("div", { class: "row" }, element("label", { for: control.id }, text), control, ...after);
}

export function select(options: [value: string, text: string][], change: (value: string) => void): HTMLSelectElement {
  const made = element("select", {}, ...options.map(([value, text]) => element("option", { value }, text)));
  made.addEventListener("change", () => change(made.value));
  return made;
}

export function button(text: string, title: string, press: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", title, "aria-label": title }, text);
  made.addEventListener("click", press);
  return made;
}

// A check box followed by its label.
export function tick(text: string, checked: boolean, change: (on: boolean) => void, id = ""): HTMLElement {
  const box = element("input", { type: "checkbox", ...(id && { id }) });
  box.checked = checked;
  box.addEventListener("change", () => change(box.checked));
  return element("label", { class: "tick-box" }, box, text);
}
