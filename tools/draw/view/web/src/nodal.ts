// Finds the faces on which nodal lines of a mode shape are drawn.

const FAINT = 0.02; // relative to the largest value; as in draw/modes.py

// Marks the corners of faces without a nodal line by 1, others by 0. `values` has one value per node. A face has a nodal line
// if, at one of its corners, the faces that share this corner have values of both signs. Connected regions of one sign whose
// values all stay below FAINT times the largest value are ignored: they come from round-off, or from the mesh near supports.
export function plainCorners(faces: Uint32Array, values: Float32Array): Float32Array {
  const isFaint = faintNodes(faces, values), signs = new Uint8Array(values.length); // around a node: 1 positive, 2 negative
  for (let corner = 0; corner < faces.length; corner += 3) {
    const nodes = faces.subarray(corner, corner + 3);
    const found = nodes.reduce((all, node) => all | (isFaint(node) ? 0 : sign(values[node] as number)), 0);
    for (const node of nodes) signs[node] = (signs[node] as number) | found;
  }
  const out = new Float32Array(faces.length);
  for (let corner = 0; corner < faces.length; corner += 3)
    if (!faces.subarray(corner, corner + 3).some((node) => signs[node] === 3)) out.fill(1, corner, corner + 3);
  return out;
}

function sign(value: number): number {
  return value > 0 ? 1 : value < 0 ? 2 : 0;
}

function faintNodes(faces: Uint32Array, values: Float32Array): (node: number) => boolean {
  const parent = Uint32Array.from(values.keys()), largest = values.map(Math.abs);
  const root = (node: number): number => {
    while (parent[node] !== node) node = parent[node] = parent[parent[node] as number] as number;
    return node;
  };
  faces.forEach((from, corner) => {
    const to = faces[corner % 3 === 2 ? corner - 2 : corner + 1] as number;
    if (!((values[from] as number) * (values[to] as number) > 0)) return;
    const a = root(from), b = root(to);
    parent[b] = a;
    largest[a] = Math.max(largest[a] as number, largest[b] as number);
  });
  const limit = FAINT * largest.reduce((a, b) => Math.max(a, b), 0);
  return (node) => (largest[root(node)] as number) < limit;
}
