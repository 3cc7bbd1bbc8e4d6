// The canvas: shows one or more bodies in adjacent panes, all with the same camera.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Body, Hit } from "./body";
import type { Plane } from "./section";
import { Triad } from "./triad";

const AZIMUTH = -60, ELEVATION = 20; // degrees; the same defaults as in `draw`
const FIELD_OF_VIEW = 20; // degrees
const NARROW = 640; // pixels: in a narrower window panes are stacked

export interface Pick extends Hit {
  pane: number;
}

// Whether WebGL runs on the CPU. Antialiasing and high resolution, which cost most, are then turned off.
const isSoftware = ((): boolean => {
  const gl = document.createElement("canvas").getContext("webgl2"), known = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && known ? String(gl.getParameter(known.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
})();

interface Rectangle {
  x: number; // pixels from the left
  y: number; // pixels from the top
  width: number;
  height: number;
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW);
  private readonly orbit: OrbitControls;
  private readonly scenes: THREE.Scene[];
  private readonly clip = new THREE.Plane();
  private readonly triad = new Triad();
  private readonly resizing = new ResizeObserver(() => this.resize());
  private pending = 0; // identifier of the requested animation frame; 0: none
  private isOver = false;
  private isMoved = false; // whether the user has moved the camera
  private scale = 1; // displacement scale factor
  private direction: [number, number] = [AZIMUTH, ELEVATION]; // degrees

  constructor(
    private readonly holder: HTMLElement,
    private readonly bodies: Body[],
    isStill: boolean,
  ) {
    const fine = isStill || !isSoftware;
    this.renderer = new THREE.WebGLRenderer({ antialias: fine, alpha: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setPixelRatio(fine ? Math.min(devicePixelRatio, 2) : 1);
    this.renderer.setScissorTest(true);
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    holder.append(this.canvas);
    this.scenes = bodies.map((body) => new THREE.Scene().add(body.group));
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, this.canvas);
    this.orbit.addEventListener("change", () => this.draw());
    this.orbit.addEventListener("start", () => (this.isMoved = true));
    this.resizing.observe(holder);
    this.look(AZIMUTH, ELEVATION);
    this.resize();
  }

  // Views all bodies from a direction: azimuth about z and elevation, in degrees.
  look(azimuth: number, elevation: number): void {
    this.direction = [azimuth, elevation];
    this.isMoved = false;
    const a = THREE.MathUtils.degToRad(azimuth), e = THREE.MathUtils.degToRad(Math.min(Math.max(elevation, -89.9), 89.9));
    const toward = new THREE.Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    const box = new THREE.Box3();
    for (const body of this.bodies) box.union(body.box(this.scale));
    const target = box.getCenter(new THREE.Vector3());
    this.orbit.target.copy(target);
    this.camera.position.copy(target).addScaledVector(toward, this.distanceFor(box, toward));
    this.orbit.update();
    this.draw();
  }

  // Azimuth and elevation of the camera, in degrees.
  eye(): [number, number] {
    const [x, y, z] = this.toward();
    return [THREE.MathUtils.radToDeg(Math.atan2(y, x)), THREE.MathUtils.radToDeg(Math.asin(Math.min(Math.max(z, -1), 1)))];
  }
  // Unit vector from the target to the camera.
  toward(): [number, number, number] {
    const { x, y, z } = this.camera.position.clone().sub(this.orbit.target).normalize();
    return [x, y, z];
  }

  // Stops drawing and releases the resources of the graphics card.
  end(): void {
    this.isOver = true;
    cancelAnimationFrame(this.pending);
    this.orbit.dispose();
    this.resizing.disconnect();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  // Fits the bodies into view, with displacements multiplied by `scale`.
  fit(scale: number): void {
    this.scale = scale;
    this.look(...this.direction);
  }

  // The distance (m) from camera to target at which the box fits into a pane.
  private distanceFor(box: THREE.Box3, toward: THREE.Vector3): number {
    const target = box.getCenter(new THREE.Vector3()), right = new THREE.Vector3().crossVectors(this.camera.up, toward).normalize();
    const up = new THREE.Vector3().crossVectors(toward, right), slope = Math.tan(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2));
    const pane = this.panes()[0] as Rectangle, aspect = pane.width / Math.max(pane.height, 1);
    let distance = 0;
    for (let k = 0; k < 8; ++k) {
      const corner = new THREE.Vector3(
        k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z,
      ).sub(target);
      const high = Math.abs(corner.dot(up)) / slope, wide = Math.abs(corner.dot(right)) / (slope * aspect);
      distance = Math.max(distance, 1.12 * Math.max(high, wide) + corner.dot(toward));
    }
    return distance || 1;
  }

  setPlane(plane: Plane | null): void {
    if (plane) this.clip.set(new THREE.Vector3(...plane.normal).negate(), plane.offset);
    for (const body of this.bodies)
      body.group.traverse((part) => {
        if (part instanceof THREE.Mesh || part instanceof THREE.LineSegments || part instanceof THREE.Points)
          (part.material as THREE.Material).clippingPlanes = plane && part !== body.cap ? [this.clip] : null;
      });
    this.renderer.localClippingEnabled = plane !== null;
  }

  // Requests a redraw at the next animation frame.
  draw(): void {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => this.drawNow());
  }

  drawNow(): void {
    cancelAnimationFrame(this.pending);
    this.pending = 0;
    if (this.isOver) return;
    this.renderer.setScissor(0, 0, this.holder.clientWidth, this.holder.clientHeight);
    this.renderer.clear();
    this.panes().forEach((pane, k) => {
      const fromBelow = this.holder.clientHeight - pane.y - pane.height;
      this.renderer.setViewport(pane.x, fromBelow, pane.width, pane.height);
      this.renderer.setScissor(pane.x, fromBelow, pane.width, pane.height);
      this.setAspect(pane);
      this.renderer.render(this.scenes[k] as THREE.Scene, this.camera);
    });
    const toEye = new THREE.Vector3(...this.toward());
    this.triad.draw(this.renderer, toEye, this.camera.up, this.holder.clientWidth, this.holder.clientHeight);
  }

  // The point of a body at a place on the page, in CSS pixels; null if no body is there.
  pick(clientX: number, clientY: number): Pick | null {
    const bounds = this.canvas.getBoundingClientRect(), x = clientX - bounds.left, y = clientY - bounds.top;
    const index = this.panes().findIndex((p) => x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height);
    const pane = this.panes()[index];
    if (!pane) return null;
    this.setAspect(pane);
    const place = new THREE.Vector2((2 * (x - pane.x)) / pane.width - 1, 1 - (2 * (y - pane.y)) / pane.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(place, this.camera);
    const hit = (this.bodies[index] as Body).pick(caster.ray);
    return hit && { ...hit, pane: index };
  }

  // The place on the page, in CSS pixels, of a point in a pane; for tests.
  place(point: THREE.Vector3, pane = 0): { x: number; y: number } {
    const p = this.panes()[pane] as Rectangle, bounds = this.canvas.getBoundingClientRect();
    this.setAspect(p);
    const flat = point.clone().project(this.camera);
    return { x: bounds.left + p.x + ((flat.x + 1) / 2) * p.width, y: bounds.top + p.y + ((1 - flat.y) / 2) * p.height };
  }

  private setAspect(pane: Rectangle): void {
    this.camera.aspect = pane.width / Math.max(pane.height, 1);
    const extent = Math.max(...this.bodies.map((b) => b.extent)), distance = this.camera.position.distanceTo(this.orbit.target);
    this.camera.near = Math.max(distance - 20 * extent, 1e-3 * distance);
    this.camera.far = distance + 20 * extent;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  private panes(): Rectangle[] {
    const width = this.holder.clientWidth, height = this.holder.clientHeight, n = this.bodies.length;
    const stacked = width < NARROW;
    return this.bodies.map((_, k) =>
      stacked
        ? { x: 0, y: (k * height) / n, width, height: height / n }
        : { x: (k * width) / n, y: 0, width: width / n, height },
    );
  }

  // Keeps all bodies in view unless the user has moved the camera.
  private resize(): void {
    this.renderer.setSize(this.holder.clientWidth, this.holder.clientHeight);
    if (!this.isMoved) this.look(...this.direction);
    this.drawNow();
  }
}
