// One result: its mesh, and the fields of its frames, which are decoded on demand.
import { floats, hasBlock, integers } from "./blocks";
import type { Quantity, ResultDescription } from "./description";

const CACHED_BYTES = 400e6;

export interface Mesh {
  rest: Float32Array; // positions of nodes at rest, relative to the result's centre (m)
  number: Uint32Array; // for each node its number in the file
  faces: Uint32Array; // three nodes each, counter-clockwise from outside
  normals: Uint32Array; // for each corner of a face the index of its normal
  cell: Uint32Array; // for each face the index of its cell
  cellNumber: Uint32Array; // for each cell its number in the file
  edges: Uint32Array; // edges of the surface mesh, two nodes each
  creases: Uint32Array; // sharp edges of the shape, two nodes each
  tets: Uint32Array | null; // four nodes each; null if the interior is not included
  tetCell: Uint32Array | null; // for each tetrahedron the index of its cell; null like `tets`
}

export interface Marks {
  held: Uint32Array; // nodes
  loaded: Uint32Array; // nodes
  loads: Float32Array; // forces on the loaded nodes (N), three components each
}

export interface Strokes {
  face: Uint32Array; // for each stroke the index of its face
  ends: Float32Array; // barycentric coordinates of both ends in that face, six per stroke
}

export class Result {
  private readonly cache = new Map<string, Promise<Float32Array>>();
  private cached = 0;

  private constructor(
    readonly key: string,
    readonly about: ResultDescription,
    readonly mesh: Mesh,
    readonly strokes: Map<number, Strokes>, // by material axis, 1 to 3
    readonly marks: Marks,
  ) {}

  static async read(key: string, about: ResultDescription): Promise<Result> {
    const whole = (name: string) => integers(`${key}/${name}`);
    const [rest, number, faces, normals, cell, cellNumber, edges, creases] = await Promise.all([
      floats(`${key}/rest`), whole("number"), whole("faces"), whole("normals"), whole("cell"), whole("cell_number"),
      whole("edges"), whole("creases"),
    ]);
    const tets = about.volume ? await whole("tets") : null, tetCell = about.volume ? await whole("tet_cell") : null;
    const strokes = new Map<number, Strokes>();
    for (const axis of about.strokes)
      strokes.set(axis, { face: await whole(`stroke_face_${axis}`), ends: await floats(`${key}/stroke_ends_${axis}`) });
    const marks = await readMarks(key);
    return new Result(key, about, { rest, number, faces, normals, cell, cellNumber, edges, creases, tets, tetCell }, strokes, marks);
  }

  // The index of the frame nearest to a time.
  frameAt(time: number): number {
    const times = this.about.times;
    let best = 0;
    times.forEach((t, k) => {
      if (Math.abs(t - time) < Math.abs((times[best] as number) - time)) best = k;
    });
    return best;
  }

  // Displacements (m), three per node; null if the result has none.
  async displacement(frame: number): Promise<Float32Array | null> {
    return this.about.fields.some((f) => f.name === "displacement") ? this.field("displacement", frame) : null;
  }

  // The quantity's values, one per node or cell. Throws if the result lacks the field.
  async values(quantity: Quantity, frame: number): Promise<Float32Array> {
    const field = this.about.fields.find((f) => f.name === quantity.field);
    if (!field) throw new Error(`no field ${quantity.field}`);
    return scalars(await this.field(field.name, field.steady ? 0 : frame), field.components, quantity.kind);
  }

  // Decodes a later frame in advance.
  prepare(quantity: Quantity, frame: number): void {
    if (frame >= this.about.times.length) return;
    void this.displacement(frame);
    void this.values(quantity, frame);
  }

  // null if the result lacks the quantity.
  quantity(key: string): Quantity | null {
    return this.about.quantities.find((q) => q.key === key) ?? null;
  }

  isOnNodes(quantity: Quantity): boolean {
    return this.about.fields.some((f) => f.name === quantity.field && f.on === "nodes");
  }

  private field(name: string, frame: number): Promise<Float32Array> {
    const id = `${this.key}/${name}/${frame}`, known = this.cache.get(id);
    if (known) return known;
    const values = floats(id);
    this.cache.set(id, values);
    void values.then((v) => this.makeRoom(v.byteLength));
    return values;
  }

  private makeRoom(bytes: number): void {
    this.cached += bytes;
    if (this.cached <= CACHED_BYTES) return;
    this.cache.clear();
    this.cached = 0;
  }
}

async function readMarks(key: string): Promise<Marks> {
  const nodes = async (kind: string) => (hasBlock(`${key}/${kind}`) ? integers(`${key}/${kind}`) : new Uint32Array(0));
  const loads = hasBlock(`${key}/load_values`) ? await floats(`${key}/load_values`) : new Float32Array(0);
  return { held: await nodes("held"), loaded: await nodes("loaded"), loads };
}

export function scalars(values: Float32Array, components: number, kind: Quantity["kind"]): Float32Array {
  if (components === 1) return values;
  const n = values.length / components, out = new Float32Array(n);
  for (let k = 0; k < n; ++k) out[k] = scalar(values, k * components, components, kind);
  return out;
}

function scalar(v: Float32Array, at: number, components: number, kind: Quantity["kind"]): number {
  if (typeof kind === "number") return v[at + kind] as number;
  const x = (i: number) => v[at + i] as number;
  if (kind === "von_mises") {
    const normal = (x(0) - x(1)) ** 2 + (x(1) - x(2)) ** 2 + (x(2) - x(0)) ** 2;
    return Math.sqrt(0.5 * normal + 3 * (x(3) ** 2 + x(4) ** 2 + x(5) ** 2));
  }
  let sum = 0;
  for (let i = 0; i < components; ++i) sum += (components === 6 && i > 2 ? 2 : 1) * x(i) ** 2;
  return Math.sqrt(sum);
}
