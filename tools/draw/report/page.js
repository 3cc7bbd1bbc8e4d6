// Tooltips, choice of error measure and clock, theme. The page works without this script.
(() => {
  "use strict";
  const root = document.documentElement;
  const data = JSON.parse(document.getElementById("run-data").textContent);
  const chosen = {measure: data.measure, clock: data.clock};
  const reach = 22; // px: marks within this distance of the pointer are picked
  root.classList.add("scripted");

  const element = (name, text) => Object.assign(document.createElement(name), {textContent: text ?? ""});
  const tip = Object.assign(element("div"), {id: "tip", hidden: true});
  tip.setAttribute("role", "status");
  document.body.append(tip);

  const errorRow = run => {
    const value = run.e[chosen.measure];
    const near = (run.near || []).includes(chosen.measure);
    return value === undefined ? [] : [["Error", value + (near ? " (near the reference's own)" : "")]];
  };

  function fillTip(run) {
    const list = element("dl");
    for (const [label, text] of [...errorRow(run), ...run.rows]) list.append(element("dt", label), element("dd", text));
    tip.replaceChildren(element("b", run.title), list);
  }

  function placeTip(mark) {
    const box = mark.getBoundingClientRect();
    tip.hidden = false;
    const width = tip.offsetWidth, height = tip.offsetHeight, middle = box.left + box.width / 2;
    const left = Math.min(Math.max(8, middle + 14), root.clientWidth - width - 8);
    const above = box.top - height - 10, top = above > 4 ? above : box.bottom + 10;
    tip.style.left = `${left + scrollX}px`;
    tip.style.top = `${top + scrollY}px`;
  }

  let picked = null; // svg and mark of the tooltip shown
  function highlight(svg, method) {
    for (const part of svg.querySelectorAll("[data-m]")) part.classList.toggle("off", method !== null && part.dataset.m !== method);
  }
  function clear() {
    if (picked) highlight(picked.svg, null);
    picked = null;
    tip.hidden = true;
  }
  function pick(svg, mark) {
    if (picked && picked.svg === svg && picked.mark === mark) return;
    clear();
    picked = {svg, mark};
    highlight(svg, mark.dataset.m);
    if (mark.dataset.p === undefined) return;
    fillTip(data.runs[Number(mark.dataset.p)]);
    placeTip(mark);
  }

  function nearest(svg, x, y) {
    let found = null, least = reach;
    for (const mark of svg.querySelectorAll("[data-p]")) {
      const b = mark.getBoundingClientRect();
      const outside = Math.hypot(Math.max(b.left - x, 0, x - b.right), Math.max(b.top - y, 0, y - b.bottom));
      const distance = outside + 0.01 * Math.hypot((b.left + b.right) / 2 - x, (b.top + b.bottom) / 2 - y);
      if (distance < least) [found, least] = [mark, distance];
    }
    return found;
  }

  // A field of the stability matrix has a tooltip like a mark of a figure.
  const field = event => event.target.closest ? event.target.closest("table.matrix [data-p]") : null;

  function point(event) {
    const cell = field(event);
    if (cell) return pick(cell.closest("table"), cell);
    const svg = event.target.closest ? event.target.closest("figure svg") : null;
    const mark = svg && (nearest(svg, event.clientX, event.clientY) || event.target.closest("[data-m]"));
    if (mark) pick(svg, mark); else clear();
  }
  document.addEventListener("pointermove", point);
  document.addEventListener("pointerdown", point);
  document.addEventListener("focusout", clear);
  document.addEventListener("focusin", event => {
    const cell = field(event);
    if (cell) pick(cell.closest("table"), cell);
  });

  document.addEventListener("keydown", event => {
    if (event.key === "Escape") clear();
    const svg = document.activeElement.closest("figure svg");
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (!svg || !step) return;
    const marks = [...svg.querySelectorAll("[data-p]")];
    if (!marks.length) return;
    const at = picked && picked.svg === svg ? marks.indexOf(picked.mark) : step > 0 ? -1 : 0;
    const next = picked ? marks.findIndex((m, k) => step > 0 && k > at && m.dataset.p !== picked.mark.dataset.p) : 0;
    const before = marks.slice(0, Math.max(at, 0)).reverse().find(m => m.dataset.p !== picked?.mark.dataset.p);
    event.preventDefault();
    pick(svg, step > 0 ? marks[Math.max(next, 0)] : before || marks[marks.length - 1]);
  });

  // A matrix is one tab stop; arrow keys move between its fields.
  for (const matrix of document.querySelectorAll("table.matrix")) {
    const fields = [...matrix.querySelectorAll("[data-p]")];
    fields.forEach((cell, k) => { cell.tabIndex = k ? -1 : 0; });
    matrix.addEventListener("keydown", event => {
      const ways = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1]};
      const [across, down] = ways[event.key] || [];
      const at = event.target.closest("td,th");
      if (across === undefined || !at) return;
      event.preventDefault();
      const next = matrix.rows[at.parentNode.rowIndex + down]?.cells[at.cellIndex + across]?.querySelector("[data-p]");
      if (!next) return;
      for (const cell of fields) cell.tabIndex = cell === next ? 0 : -1;
      next.focus();
    });
  }

  const originals = new Map(); // figure -> its initial content
  function show(figure) {
    const stage = figure.querySelector(".stage");
    if (!originals.has(figure)) originals.set(figure, stage.innerHTML);
    const clock = figure.dataset.clock;
    const first = figure.dataset.measure === chosen.measure && (!clock || clock === chosen.clock);
    const template = [...figure.querySelectorAll("template")].find(t =>
      t.dataset.measure === chosen.measure && (!t.dataset.clock || t.dataset.clock === chosen.clock));
    if (first) stage.innerHTML = originals.get(figure);
    else if (template) stage.replaceChildren(template.content.cloneNode(true));
    else stage.replaceChildren(Object.assign(element("p", "This choice was left out to keep the page small; the table of runs has its numbers."), {className: "empty"}));
  }

  function choose(kind, value) {
    chosen[kind] = value;
    clear();
    for (const input of document.querySelectorAll(`[data-pick=${kind}]`)) {
      if (input.type === "radio") input.checked = input.value === value; else input.value = value;
    }
    document.querySelectorAll("figure[data-measure]").forEach(show);
    for (const cell of document.querySelectorAll("[data-e]")) {
      const run = data.runs[Number(cell.dataset.e)];
      cell.textContent = run.e[chosen.measure] ?? "–";
      cell.toggleAttribute("data-near", (run.near || []).includes(chosen.measure));
    }
    for (const name of document.querySelectorAll("[data-measure-name]")) name.textContent = data.labels[chosen.measure];
  }
  for (const input of document.querySelectorAll("[data-pick]")) {
    input.addEventListener("change", () => choose(input.dataset.pick, input.value));
  }

  // Marks tables that are wider than their box, which then fade at the hidden side.
  function watch(box) {
    const hint = Object.assign(element("p", "More columns to the right: scroll the table sideways \u2192"), {className: "hint"});
    hint.setAttribute("aria-hidden", "true");
    box.before(hint);
    const look = () => {
      const beyond = box.scrollWidth - box.clientWidth;
      hint.classList.toggle("shown", beyond > 2);
      box.classList.toggle("more", beyond - box.scrollLeft > 2);
    };
    box.addEventListener("scroll", look, {passive: true});
    new ResizeObserver(look).observe(box);
    look();
  }
  document.querySelectorAll(".scroll").forEach(watch);

  const button = document.getElementById("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => root.dataset.theme ? root.dataset.theme === "dark" : system.matches;
  const name = () => { button.textContent = isDark() ? "Light" : "Dark"; button.setAttribute("aria-label", `Use the ${isDark() ? "light" : "dark"} theme`); };
  button.addEventListener("click", () => { root.dataset.theme = isDark() ? "light" : "dark"; name(); });
  system.addEventListener("change", name);
  name();
})();
