// The description of the results on the page. collect.py and page.py write it.

export interface Field {
  name: string;
  on: "nodes" | "cells";
  steady: boolean; // constant in time: only the first frame is stored
  components: number;
}

export interface Quantity {
  key: string;
  name: string; // as in the option --color of `draw`
  field: string;
  kind: number | "magnitude" | "von_mises"; // index of a component, or an invariant of all components
  label: string;
  unit: string;
  low: number; // default colour range
  high: number;
  least: number | null; // smallest finite value of all frames; null if there is none
  most: number | null; // largest one
  neutral: number; // value in the undeformed body
  diverging: boolean; // diverging colour map
  categories: boolean; // values are labels: one colour per integer
}

export interface Curve {
  table: string;
  column: number;
  name: string;
  unit: string;
}

export interface ResultDescription {
  name: string;
  group: string; // heading in the list of results; "": none
  facts: string[]; // lines of text about the result
  shape: boolean; // displacements are mode shapes of arbitrary size
  static: boolean; // times are load factors
  labels: string[] | null; // of study points or mode shapes, shown instead of times; null: show times
  centre: [number, number, number]; // origin of the stored positions (m)
  reach: [number[], number[]]; // smallest and largest coordinates over all frames, relative to `centre` (m)
  times: number[];
  cells: number; // number of elements of the whole mesh
  volume: boolean; // interior nodes and cells are included
  fields: Field[];
  quantities: Quantity[];
  strokes: number[]; // material axes that can be shown, 1 to 3
  curves: Curve[];
  setup: { held: number; loaded: number }; // numbers of nodes
  notes: {
    status?: string;
    warnings?: string[];
  };
}

export interface Start {
  panes: number[]; // indices of the results shown at the start: one, or two side by side
  time?: number;
  color?: string;
  range?: [number, number]; // colour range
  scale?: number; // displacement scale factor
  rest?: boolean; // show the undeformed body too
  swing?: boolean; // frames are mode shapes: "play" makes the shown one oscillate
  still?: boolean; // page for a picture, without controls
}

export interface Description {
  results: ResultDescription[];
  maps: { sequential: number[][]; diverging: number[][]; categories: number[][]; nan: number[] }; // RGB, 0 to 255
  start: Start;
}

export function readDescription(): Description {
  const element = document.getElementById("description");
  if (!element) throw new Error("the page has no description");
  return JSON.parse(element.textContent ?? "") as Description;
}
