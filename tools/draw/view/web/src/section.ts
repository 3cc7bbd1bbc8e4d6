// The section of a tetrahedral mesh by a plane, as triangles with interpolated values.

export interface Plane {
  normal: [number, number, number]; // points to the removed side
  offset: number; // normal . x = offset for x in the plane
}

export interface Cut {
  positions: Float32Array; // nine per triangle
  values: Float32Array; // three per triangle
  tet: Uint32Array; // for each triangle the index of its tetrahedron
  count: number; // number of triangles; the arrays may be longer
}

export class Section {
  private positions = new Float32Array(9 * 1024);
  private values = new Float32Array(3 * 1024);
  private tet = new Uint32Array(1024);
  private count = 0;
  private distance = new Float32Array(0);
  private normal: Plane["normal"] = [0, 0, 1];

  // `values` has one value per cell, with cellOf[t] the cell of tetrahedron t; or, if cellOf is null, one per node.
  // The next call overwrites the arrays of the returned Cut.
  cut(x: Float32Array, tets: Uint32Array, values: Float32Array, cellOf: Uint32Array | null, plane: Plane): Cut {
    this.count = 0;
    const [a, b, c] = plane.normal, n = x.length / 3;
    this.normal = plane.normal;
    if (this.distance.length !== n) this.distance = new Float32Array(n);
    const d = this.distance;
    for (let k = 0; k < n; ++k)
      d[k] = a * (x[3 * k] as number) + b * (x[3 * k + 1] as number) + c * (x[3 * k + 2] as number) - plane.offset;
    const below = [0, 0, 0, 0], above = [0, 0, 0, 0];
    for (let t = 0; 4 * t < tets.length; ++t) {
      let numBelow = 0, numAbove = 0;
      for (let i = 0; i < 4; ++i) {
        const node = tets[4 * t + i] as number;
        if ((d[node] as number) < 0) below[numBelow++] = node;
        else above[numAbove++] = node;
      }
      if (numBelow === 0 || numAbove === 0) continue;
      const value = cellOf ? (values[cellOf[t] as number] as number) : null;
      const edge = (i: number, j: number) => ({ from: below[i] as number, to: above[j] as number });
      if (numBelow === 1) this.add(x, values, value, t, edge(0, 0), edge(0, 1), edge(0, 2));
      else if (numAbove === 1) this.add(x, values, value, t, edge(0, 0), edge(1, 0), edge(2, 0));
      else {
        this.add(x, values, value, t, edge(0, 0), edge(0, 1), edge(1, 1));
        this.add(x, values, value, t, edge(0, 0), edge(1, 1), edge(1, 0));
      }
    }
    return { positions: this.positions, values: this.values, tet: this.tet, count: this.count };
  }

  private add(x: Float32Array, values: Float32Array, value: number | null, tet: number, ...edges: Edge[]): void {
    if (this.count === this.tet.length) this.grow();
    const at = 9 * this.count;
    edges.forEach(({ from, to }, corner) => {
      const d0 = this.distance[from] as number, d1 = this.distance[to] as number, w = d0 / (d0 - d1);
      for (let i = 0; i < 3; ++i)
        this.positions[9 * this.count + 3 * corner + i] =
          (1 - w) * (x[3 * from + i] as number) + w * (x[3 * to + i] as number);
      this.values[3 * this.count + corner] =
        value ?? (1 - w) * (values[from] as number) + w * (values[to] as number);
    });
    if (!this.facesAlong(at)) this.turnRound();
    this.tet[this.count++] = tet;
  }

  // Whether the triangle is counter-clockwise when seen from the removed side.
  private facesAlong(at: number): boolean {
    const p = this.positions, side = (k: number, i: number) => (p[at + 3 * k + i] as number) - (p[at + i] as number);
    const [a, b, c] = this.normal;
    return (
      a * (side(1, 1) * side(2, 2) - side(1, 2) * side(2, 1)) + b * (side(1, 2) * side(2, 0) - side(1, 0) * side(2, 2)) +
        c * (side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0)) >= 0
    );
  }

  // Swaps the last two corners of the triangle under construction.
  private turnRound(): void {
    for (const [array, size] of [[this.positions, 3], [this.values, 1]] as const) {
      const second = (3 * this.count + 1) * size, third = second + size;
      for (let i = 0; i < size; ++i) {
        const kept = array[second + i] as number;
        array[second + i] = array[third + i] as number;
        array[third + i] = kept;
      }
    }
  }

  private grow(): void {
    const larger = <T extends Float32Array | Uint32Array>(old: T, to: T): T => {
      to.set(old);
      return to;
    };
    const size = 2 * this.tet.length;
    this.positions = larger(this.positions, new Float32Array(9 * size));
    this.values = larger(this.values, new Float32Array(3 * size));
    this.tet = larger(this.tet, new Uint32Array(size));
  }
}

interface Edge {
  from: number; // a node below the plane
  to: number; // a node above the plane
}
