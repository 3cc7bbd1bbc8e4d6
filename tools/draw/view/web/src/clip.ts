// The controls of the clip plane. The plane is normal to an axis, or to the line of sight at the time of the choice.
import * as THREE from "three";
import { button, element, labelled, select } from "./dom";
import type { Plane } from "./section";

const CHOICES: Record<string, [text: string, normal: Plane["normal"] | "eye" | null]> = {
  none: ["none", null], x: ["across x", [1, 0, 0]], y: ["across y", [0, 1, 0]], z: ["across z", [0, 0, 1]], eye: ["facing the eye", "eye"],
};

export interface Clipped {
  choice: string;
  normal: Plane["normal"] | null; // null: no clipping
  part: number; // position of the plane within the bounding box, 0 to 1
  flipped: boolean; // remove the other side
}

export class Clip {
  readonly node: HTMLElement;
  private at: Clipped;

  constructor(
    before: Clipped | null,
    isHollow: boolean,
    private readonly toEye: () => Plane["normal"],
    private readonly changed: () => void,
  ) {
    this.at = before ?? { choice: "none", normal: null, part: 0.5, flipped: false };
    const place = element("input", { type: "range", min: 0, max: 1, step: 0.005, "aria-label": "place of the clip plane" });
    const side = button("⇄", "The other side", () => this.set({ flipped: !this.at.flipped }));
    place.value = String(this.at.part);
    place.addEventListener("input", () => this.set({ part: Number(place.value) }));
    const enable = () => (place.disabled = side.disabled = !this.at.normal);
    const made = select(Object.entries(CHOICES).map(([key, [text]]) => [key, text]), (choice) => {
      const normal = CHOICES[choice]?.[1] ?? null;
      this.set({ choice, normal: normal === "eye" ? this.toEye() : normal });
      enable();
    });
    made.id = "clip";
    made.value = this.at.choice;
    enable();
    const note = isHollow ? [element("p", { class: "hint" }, "hollow: use --volume to include the interior")] : [];
    this.node = element("div", {}, labelled("clip plane", made, place, side), ...note);
  }

  get clipped(): Clipped {
    return this.at;
  }

  // The clip plane through a bounding box; null if clipping is off.
  plane(box: THREE.Box3): Plane | null {
    const { normal, part, flipped } = this.at;
    if (!normal) return null;
    const n = new THREE.Vector3(...normal), half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
    const reach = Math.abs(n.x) * half.x + Math.abs(n.y) * half.y + Math.abs(n.z) * half.z;
    const place = box.getCenter(new THREE.Vector3()).dot(n) + (2 * part - 1) * reach;
    if (flipped) n.negate();
    return { normal: [n.x, n.y, n.z], offset: flipped ? -place : place };
  }

  private set(change: Partial<Clipped>): void {
    this.at = { ...this.at, ...change };
    this.changed();
  }
}
