// What the page says about its results, as collect.py writes it.

export interface Field {
  name: string;
  on: "nodes" | "cells";
  steady: boolean; // only its first frame is there
  components: number;
}

export interface Quantity {
  key: string;
  name: string; // as --color of `draw` takes it
  field: string;
  kind: number | "magnitude" | "von_mises"; // a component, or what is made of all
  label: string;
  unit: string;
  low: number; // of the colours at first
  high: number;
  least: number | null; // of all values; null where none is finite
  most: number | null;
  neutral: number; // of the undeformed body
  diverging: boolean;
  categories: boolean;
}

export interface Curve {
  table: string;
  column: number;
  name: string;
  unit: string;
}

export interface ResultDescription {
  name: string;
  group: string; // under which it is offered; "" for none
  facts: string[]; // lines about it
  shape: boolean; // displacements are shapes of modes, whose size means nothing
  static: boolean; // times are load factors
  labels: string[] | null; // of frames that are points of a study or shapes, in place of times
  centre: [number, number, number]; // m, that positions are relative to
  reach: [number[], number[]]; // smallest and largest coordinates over all frames
  times: number[];
  cells: number; // of the whole mesh
  volume: boolean; // nodes and cells inside are there, too
  fields: Field[];
  quantities: Quantity[];
  strokes: number[]; // the material axes that there are strokes of
  curves: Curve[];
  setup: { held: number; loaded: number };
  notes: {
    status?: string;
    warnings?: string[];
  };
}

export interface Start {
  panes: number[]; // the results that are shown first: one, or two beside each other
  time?: number;
  color?: string;
  range?: [number, number]; // of the colours
  scale?: number;
  rest?: boolean; // the rest shape too
  swing?: boolean; // frames are shapes of modes, each of which swings
  still?: boolean; // a picture: no controls
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
