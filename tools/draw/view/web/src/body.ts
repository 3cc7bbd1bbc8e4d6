// Draws one frame of a result: surface, edges, material axes, supports and loads, and the section by a clip plane.
import * as THREE from "three";
import { lines, paint, type Paint } from "./material";
import type { Quantity } from "./description";
import type { Mesh, Result, Strokes } from "./result";
import { plainCorners } from "./nodal";
import { Section, type Cut, type Plane } from "./section";

export interface Look {
  scale: number; // displacement scale factor
  edges: "none" | "shape" | "mesh";
  strokes: number; // material axis to show, 1 to 3; 0: none
  marks: boolean; // show held nodes and loads
  rest: boolean; // show the outline of the undeformed body
}

export interface Hit {
  value: number;
  distance: number; // from the camera (m)
  node: number; // number, in the file, of the nearest corner of the triangle or tetrahedron
  cell: number; // number of the cell in the file
  point: THREE.Vector3;
}

const SWING = "swing"; // field of signed mode shapes, which are drawn with nodal lines
const HELD = 0xd1622b, LOAD = 0x8e44ad;
const LIFT = 3e-3; // distance of strokes above the surface, relative to the body's extent
const MOST_ARROWS = 40; // more would hide the body
const ARROW = 0.09; // length of the arrow of the largest load, relative to the body's extent

export class Body {
  readonly group = new THREE.Group();
  readonly extent: number; // largest edge of the bounding box at rest (m)
  readonly paint: Paint = paint();
  private readonly capPaint: Paint = paint();
  private readonly positions: Float32Array; // displaced nodes, x y z each
  private readonly corner: { position: Float32Array; normal: Float32Array; value: Float32Array; plain: Float32Array };
  private readonly normals: Float32Array;
  private readonly surface = new THREE.BufferGeometry();
  readonly cap = new THREE.Mesh(new THREE.BufferGeometry(), this.capPaint);
  private readonly edges: THREE.LineSegments;
  private readonly creases: THREE.LineSegments;
  private readonly outline: THREE.LineSegments;
  private readonly strokes: THREE.LineSegments | null;
  private readonly held: THREE.Points; // held nodes that belong to no held face
  private readonly heldNodes: number[];
  private readonly heldEdges: Uint32Array; // outline of the held faces, as pairs of nodes
  private readonly heldOutline: THREE.LineSegments;
  private readonly arrows: THREE.LineSegments;
  private readonly section = new Section();
  private cut: Cut | null = null;
  private plane: Plane | null = null;
  private values: Float32Array = new Float32Array(0);
  private onNodes = true;
  private lined: Float32Array | null = null; // values for which nodal lines were found last; null: none yet

  constructor(readonly result: Result) {
    const { mesh } = result, corners = mesh.faces.length;
    this.positions = mesh.rest.slice();
    this.corner = {
      position: new Float32Array(3 * corners), normal: new Float32Array(3 * corners), value: new Float32Array(corners),
      plain: new Float32Array(corners),
    };
    this.normals = new Float32Array(3 * (mesh.normals.reduce((a, b) => Math.max(a, b), 0) + 1));
    for (const [name, array, size] of [
      ["position", this.corner.position, 3], ["normal", this.corner.normal, 3], ["value", this.corner.value, 1],
      ["plain", this.corner.plain, 1],
    ] as const)
      this.surface.setAttribute(name, new THREE.BufferAttribute(array, size).setUsage(THREE.DynamicDrawUsage));
    this.edges = segments(mesh.edges.length, lines(0x111418, 0.35));
    this.creases = segments(mesh.creases.length, lines(0x111418, 0.9));
    this.outline = segments(mesh.creases.length, lines(0x8a919c, 0.8));
    const most = Math.max(0, ...[...result.strokes.values()].map((s) => s.face.length));
    this.strokes = most ? segments(2 * most, lines(0x101214)) : null;
    this.held = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ color: HELD, size: 5, sizeAttenuation: false }));
    [this.heldEdges, this.heldNodes] = outlined(mesh, result.marks.held);
    this.heldOutline = segments(this.heldEdges.length, Object.assign(lines(HELD, 0.95), { depthTest: false })); // drawn after opaque objects
    this.heldOutline.renderOrder = 1; // drawn over the creases
    this.arrows = segments(6 * this.arrowNodes().length, lines(LOAD, 0.8));
    this.extent = extentOf(mesh.rest);
    const body = new THREE.Mesh(this.surface, this.paint);
    for (const part of [body, this.cap, this.edges, this.creases, this.outline, this.strokes, this.held, this.heldOutline, this.arrows])
      if (part) {
        part.frustumCulled = false;
        this.group.add(part);
      }
    fillPairs(this.outline, mesh.creases, mesh.rest);
  }

  // Sets the colour map and its range, for the surface and the section alike.
  setColours(map: THREE.Texture, size: number, quantity: Quantity, low: number, high: number, nan: THREE.Color): void {
    for (const material of [this.paint, this.capPaint])
      Object.assign(material.uniforms, {
        map: { value: map }, size: { value: size }, categories: { value: quantity.categories }, low: { value: low },
        high: { value: high }, nan: { value: nan }, nodal: { value: quantity.field === SWING },
      });
  }

  // Shows one frame. `values` has one number per node or cell; null (the result lacks the field) draws the body grey.
  // A null displacement draws the body at rest.
  update(displacement: Float32Array | null, values: Float32Array | null, quantity: Quantity | null, look: Look,
    plane: Plane | null): void {
    const { mesh } = this.result;
    for (let i = 0; i < this.positions.length; ++i)
      this.positions[i] = (mesh.rest[i] as number) + look.scale * (displacement?.[i] ?? 0);
    this.values = values ?? new Float32Array(this.positions.length / 3);
    this.onNodes = quantity === null || this.result.isOnNodes(quantity);
    for (const material of [this.paint, this.capPaint]) setUniform(material, "painted", values !== null);
    this.fillSurface();
    if (quantity?.field === SWING) this.findNodalLines();
    this.setPlane(plane);
    this.edges.visible = look.edges === "mesh";
    this.creases.visible = look.edges !== "none";
    this.outline.visible = look.rest;
    if (this.edges.visible) fillPairs(this.edges, mesh.edges, this.positions);
    if (this.creases.visible) fillPairs(this.creases, mesh.creases, this.positions);
    if (this.strokes) {
      const given = this.result.strokes.get(look.strokes);
      this.strokes.visible = given !== undefined;
      if (given) this.fillStrokes(this.strokes, given);
    }
    this.held.visible = this.heldOutline.visible = this.arrows.visible = look.marks;
    if (look.marks) this.fillMarks();
  }

  // Cuts the body along the plane; null: no cut. Hollow bodies get no section.
  setPlane(plane: Plane | null): void {
    this.plane = plane;
    const { tets, tetCell } = this.result.mesh;
    this.cap.visible = plane !== null && tets !== null;
    this.cut = null;
    if (!plane || !tets) return;
    this.cut = this.section.cut(this.positions, tets, this.values, this.onNodes ? null : tetCell, plane);
    const { positions, values, count } = this.cut, geometry = this.cap.geometry;
    geometry.dispose();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions.subarray(0, 9 * count), 3));
    geometry.setAttribute("value", new THREE.BufferAttribute(values.subarray(0, 3 * count), 1));
    const normal = new Float32Array(9 * count);
    for (let i = 0; i < 9 * count; ++i) normal[i] = plane.normal[i % 3] as number;
    geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
    geometry.setDrawRange(0, 3 * count);
  }

  // The nearest intersection of the ray with the visible surface or section; null if there is none.
  pick(ray: THREE.Ray): Hit | null {
    const { mesh } = this.result, { position, value } = this.corner;
    const onSurface = nearest(ray, position, value, mesh.faces.length / 3, this.plane);
    const onCut = this.cut ? nearest(ray, this.cut.positions, this.cut.values, this.cut.count, null) : null;
    const inside = onCut && (!onSurface || onCut.distance <= onSurface.distance);
    const hit = inside ? onCut : onSurface;
    if (!hit) return null;
    const of = inside ? (this.cut as Cut).tet[hit.triangle] as number : hit.triangle;
    const nodes = inside ? (mesh.tets as Uint32Array).subarray(4 * of, 4 * of + 4) : mesh.faces.subarray(3 * of, 3 * of + 3);
    const cell = inside ? (mesh.tetCell as Uint32Array)[of] as number : mesh.cell[of] as number;
    return {
      value: hit.value, distance: hit.distance, point: hit.point, cell: mesh.cellNumber[cell] as number,
      node: mesh.number[this.closest(nodes, hit.point)] as number,
    };
  }

  // Approximate bounding box over all frames, with displacements multiplied by `scale`.
  box(scale: number): THREE.Box3 {
    const rest = new THREE.Box3().setFromArray(this.result.mesh.rest), [low, high] = this.result.about.reach;
    const moved = new THREE.Box3(new THREE.Vector3().fromArray(low), new THREE.Vector3().fromArray(high));
    return new THREE.Box3(rest.min.clone().lerp(moved.min, scale), rest.max.clone().lerp(moved.max, scale)).union(rest);
  }

  // Bounding box of the frame shown.
  boxNow(): THREE.Box3 {
    return new THREE.Box3().setFromArray(this.positions);
  }

  private closest(nodes: Uint32Array, point: THREE.Vector3): number {
    let best = nodes[0] as number, least = Infinity;
    for (const node of nodes) {
      const d = point.distanceToSquared(this.at(node));
      if (d < least) [best, least] = [node, d];
    }
    return best;
  }

  private at(node: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.positions, 3 * node);
  }

  private fillSurface(): void {
    const { faces, normals, cell } = this.result.mesh, { position, normal, value } = this.corner, x = this.positions;
    this.normals.fill(0);
    for (let f = 0; 3 * f < faces.length; ++f) {
      for (let k = 0; k < 3; ++k) {
        const corner = 3 * f + k, node = faces[corner] as number;
        for (let i = 0; i < 3; ++i) position[3 * corner + i] = x[3 * node + i] as number;
        value[corner] = this.values[this.onNodes ? node : (cell[f] as number)] as number;
      }
      this.addNormal(f, normals);
    }
    for (let corner = 0; corner < faces.length; ++corner)
      for (let i = 0; i < 3; ++i) normal[3 * corner + i] = this.normals[3 * (normals[corner] as number) + i] as number;
    for (const name of ["position", "normal", "value"]) this.surface.getAttribute(name).needsUpdate = true;
  }

  private findNodalLines(): void {
    if (this.lined === this.values) return;
    this.lined = this.values;
    this.corner.plain.set(plainCorners(this.result.mesh.faces, this.values));
    this.surface.getAttribute("plain").needsUpdate = true;
  }

  private addNormal(face: number, normals: Uint32Array): void {
    const p = this.corner.position, at = 9 * face, side = (k: number, i: number) => (p[at + 3 * k + i] as number) - (p[at + i] as number);
    const ax = side(1, 0), ay = side(1, 1), az = side(1, 2), bx = side(2, 0), by = side(2, 1), bz = side(2, 2);
    const n = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    for (let k = 0; k < 3; ++k)
      for (let i = 0; i < 3; ++i) {
        const to = 3 * (normals[3 * face + k] as number) + i;
        this.normals[to] = (this.normals[to] as number) + (n[i] as number);
      }
  }

  private fillStrokes(strokes: THREE.LineSegments, given: Strokes): void {
    const { faces } = this.result.mesh, out = strokes.geometry.getAttribute("position") as THREE.BufferAttribute;
    const x = this.positions, lift = LIFT * this.extent;
    given.face.forEach((face, s) => {
      const n = this.normalOf(face);
      for (let end = 0; end < 2; ++end)
        for (let i = 0; i < 3; ++i) {
          let sum = lift * n.getComponent(i);
          for (let k = 0; k < 3; ++k)
            sum += (given.ends[6 * s + 3 * end + k] as number) * (x[3 * (faces[3 * face + k] as number) + i] as number);
          out.array[6 * s + 3 * end + i] = sum;
        }
    });
    strokes.geometry.setDrawRange(0, 2 * given.face.length);
    out.needsUpdate = true;
  }

  private normalOf(face: number): THREE.Vector3 {
    const p = this.corner.position, at = (k: number) => new THREE.Vector3().fromArray(p, 9 * face + 3 * k);
    return at(1).sub(at(0)).cross(at(2).sub(at(0))).normalize();
  }

  // Indices of the loaded nodes that get an arrow: every n-th one, at most MOST_ARROWS.
  private arrowNodes(): number[] {
    const { loaded } = this.result.marks, step = Math.ceil(loaded.length / MOST_ARROWS);
    return Array.from(loaded.keys()).filter((k) => k % step === 0);
  }

  private fillMarks(): void {
    const { loaded, loads } = this.result.marks;
    fillPairs(this.heldOutline, this.heldEdges, this.positions);
    const points = new Float32Array(3 * this.heldNodes.length);
    this.heldNodes.forEach((node, k) => points.set(this.positions.subarray(3 * node, 3 * node + 3), 3 * k));
    this.held.geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    const size = (k: number) => Math.hypot(loads[3 * k] as number, loads[3 * k + 1] as number, loads[3 * k + 2] as number);
    let largest = 0;
    loaded.forEach((_, k) => (largest = Math.max(largest, size(k))));
    const out: number[] = [];
    for (const k of this.arrowNodes()) {
      const tip = this.at(loaded[k] as number), force = new THREE.Vector3().fromArray(loads, 3 * k);
      arrow(tip, force.multiplyScalar((ARROW * this.extent) / largest), out);
    }
    const attribute = this.arrows.geometry.getAttribute("position") as THREE.BufferAttribute;
    attribute.array.set(out);
    attribute.needsUpdate = true;
  }
}

// The outline of the held faces as pairs of nodes, and the held nodes that belong to no held face. A face counts as held if
// all its corners are held and an adjacent, nearly coplanar face is held too. The second condition excludes the single face
// in a corner between two clamped edges.
function outlined({ faces, rest }: Mesh, held: Uint32Array): [Uint32Array, number[]] {
  const isHeld = new Set(held), beside = new Map<string, number[]>(), edge = (a: number, b: number) => `${Math.min(a, b)} ${Math.max(a, b)}`;
  const corners = (f: number) => [0, 1, 2].map((k) => faces[3 * f + k] as number);
  const edges = (f: number) => corners(f).map((a, k, all): [number, number] => [a, all[(k + 1) % 3] as number]);
  const at = (node: number) => new THREE.Vector3().fromArray(rest, 3 * node);
  const normal = (f: number) => {
    const [a, b, c] = corners(f).map(at) as [THREE.Vector3, THREE.Vector3, THREE.Vector3];
    return b.sub(a).cross(c.sub(a)).normalize();
  };
  const given = Array.from({ length: faces.length / 3 }, (_, f) => f).filter((f) => corners(f).every((node) => isHeld.has(node)));
  for (const f of given) for (const [a, b] of edges(f)) beside.set(edge(a, b), [...(beside.get(edge(a, b)) ?? []), f]);
  const flat = (f: number, [a, b]: [number, number]) => (beside.get(edge(a, b)) ?? []).some((g) => g !== f && normal(f).dot(normal(g)) > 0.8);
  const rim: number[] = [], covered = new Set<number>();
  for (const f of given) {
    const own = edges(f), inner = own.filter((pair) => flat(f, pair));
    if (!inner.length) continue;
    corners(f).forEach((node) => covered.add(node));
    own.filter((pair) => !inner.includes(pair)).forEach((pair) => rim.push(...pair));
  }
  return [Uint32Array.from(rim), [...held].filter((node) => !covered.has(node))];
}

// Appends the three segments of an arrow: a shaft that ends at the tip, and the two sides of its head.
function arrow(tip: THREE.Vector3, along: THREE.Vector3, out: number[]): void {
  const tail = tip.clone().sub(along), length = along.length();
  const across = new THREE.Vector3(0, 0, 1).cross(along);
  if (across.length() < 0.1 * length) across.set(1, 0, 0).cross(along);
  across.setLength(0.12 * length);
  const neck = tip.clone().addScaledVector(along, -0.25);
  for (const [from, to] of [[tail, tip], [neck.clone().add(across), tip], [neck.clone().sub(across), tip]] as const)
    out.push(...from.toArray(), ...to.toArray());
}

function setUniform(material: Paint, name: string, value: boolean): void {
  const uniform = material.uniforms[name];
  if (uniform) uniform.value = value;
}

function segments(ends: number, material: THREE.LineBasicMaterial): THREE.LineSegments {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * ends), 3).setUsage(THREE.DynamicDrawUsage));
  return new THREE.LineSegments(geometry, material);
}

function fillPairs(target: THREE.LineSegments, pairs: Uint32Array, x: Float32Array): void {
  const attribute = target.geometry.getAttribute("position") as THREE.BufferAttribute, out = attribute.array;
  pairs.forEach((node, k) => {
    for (let i = 0; i < 3; ++i) out[3 * k + i] = x[3 * node + i] as number;
  });
  attribute.needsUpdate = true;
}

function extentOf(x: Float32Array): number {
  const size = new THREE.Box3().setFromArray(x).getSize(new THREE.Vector3());
  return Math.max(size.x, size.y, size.z) || 1;
}

interface Met {
  triangle: number;
  distance: number;
  value: number;
  point: THREE.Vector3;
}

// The nearest triangle that the ray hits on the kept side of the plane (Moeller & Trumbore 1997); null if there is none.
// A null plane keeps everything.
function nearest(ray: THREE.Ray, p: Float32Array, values: Float32Array, count: number, plane: Plane | null): Met | null {
  let best: Met | null = null;
  const { origin: o, direction: d } = ray;
  for (let t = 0; t < count; ++t) {
    const at = 9 * t, side = (k: number, i: number) => (p[at + 3 * k + i] as number) - (p[at + i] as number);
    const ax = side(1, 0), ay = side(1, 1), az = side(1, 2), bx = side(2, 0), by = side(2, 1), bz = side(2, 2);
    const hx = d.y * bz - d.z * by, hy = d.z * bx - d.x * bz, hz = d.x * by - d.y * bx, det = ax * hx + ay * hy + az * hz;
    if (det === 0) continue;
    const sx = o.x - (p[at] as number), sy = o.y - (p[at + 1] as number), sz = o.z - (p[at + 2] as number);
    const u = (sx * hx + sy * hy + sz * hz) / det;
    if (u < 0 || u > 1) continue;
    const qx = sy * az - sz * ay, qy = sz * ax - sx * az, qz = sx * ay - sy * ax, v = (d.x * qx + d.y * qy + d.z * qz) / det;
    if (v < 0 || u + v > 1) continue;
    const distance = (bx * qx + by * qy + bz * qz) / det;
    if (distance <= 0 || (best && distance >= best.distance)) continue;
    const point = o.clone().addScaledVector(d, distance);
    if (plane && point.dot(new THREE.Vector3(...plane.normal)) > plane.offset) continue;
    const w = 1 - u - v;
    const value = w * (values[3 * t] as number) + u * (values[3 * t + 1] as number) + v * (values[3 * t + 2] as number);
    best = { triangle: t, distance, value, point };
  }
  return best;
}
