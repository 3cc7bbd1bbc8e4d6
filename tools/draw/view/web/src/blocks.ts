// Decodes the arrays that blocks.py embeds in the page as text.

interface About {
  kind: "u32" | "f32" | "linear" | "half";
  components: number;
  low?: number[];
  step?: number[];
  factor?: number;
  offset?: number;
}

const halves = new Float32Array(65536);
for (let bits = 0; bits < 65536; ++bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 31) halves[bits] = fraction ? NaN : sign * Infinity;
  else if (exponent === 0) halves[bits] = sign * fraction * 2 ** -24;
  else halves[bits] = sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

export const hasBlock = (name: string): boolean => document.getElementById(name) !== null;

// Decodes a block of real numbers. The components of a row are adjacent. Throws if the block holds integers.
export async function floats(name: string): Promise<Float32Array> {
  const { about, bytes } = await unpacked(name);
  switch (about.kind) {
    case "f32":
      return rows(new Float32Array(bytes), about.components, (x) => x);
    case "half": {
      const factor = about.factor ?? 1, offset = about.offset ?? 0;
      return rows(new Uint16Array(bytes), about.components, (x) => offset + (halves[x] as number) * factor);
    }
    case "linear": {
      const low = about.low ?? [], step = about.step ?? [];
      return rows(new Uint16Array(bytes), about.components, (x, i) => (low[i] ?? 0) + x * (step[i] ?? 0));
    }
    default:
      throw new Error(`${name} holds whole numbers`);
  }
}

// Decodes a block of unsigned integers, laid out as in floats().
export async function integers(name: string): Promise<Uint32Array> {
  const { about, bytes } = await unpacked(name);
  const planes = new Uint32Array(bytes), n = planes.length / about.components, out = new Uint32Array(planes.length);
  for (let i = 0; i < about.components; ++i)
    for (let k = 0; k < n; ++k) out[k * about.components + i] = planes[i * n + k] as number;
  return out;
}

// Reorders planes (all values of a component, then those of the next) into rows, and decodes each value.
function rows(planes: Float32Array | Uint16Array, components: number, value: (x: number, component: number) => number) {
  const n = planes.length / components, out = new Float32Array(planes.length);
  for (let i = 0; i < components; ++i)
    for (let k = 0; k < n; ++k) out[k * components + i] = value(planes[i * n + k] as number, i);
  return out;
}

async function unpacked(name: string): Promise<{ about: About; bytes: ArrayBuffer }> {
  const named = document.getElementById(name), same = named?.dataset["same"];
  const element = same === undefined ? named : document.getElementById(same); // equal arrays are stored once
  if (!element) throw new Error(`the page has no block ${name}`);
  const text = atob(element.textContent ?? ""), packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return { about: JSON.parse(element.dataset["about"] ?? "{}") as About, bytes: await new Response(stream).arrayBuffer() };
}
