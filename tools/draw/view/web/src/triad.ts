// Draws the directions of x, y and z in a corner of the picture.
import * as THREE from "three";

const PIXELS = 84, REACH = 1.45;
const AXES: [name: string, direction: [number, number, number], colour: string][] = [
  ["x", [1, 0, 0], "#d0473d"], ["y", [0, 1, 0], "#3a9a4b"], ["z", [0, 0, 1], "#3f74d1"],
];

export class Triad {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.OrthographicCamera(-REACH, REACH, REACH, -REACH, 0.1, 10);

  constructor() {
    for (const [name, direction, colour] of AXES) {
      const end = new THREE.Vector3(...direction);
      const line = new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), end]);
      this.scene.add(new THREE.Line(line, new THREE.LineBasicMaterial({ color: colour })), letter(name, colour, end.multiplyScalar(1.22)));
    }
  }

  // Draws the axes as seen by the main camera, in the upper right corner of a picture of this size (pixels).
  draw(renderer: THREE.WebGLRenderer, towardEye: THREE.Vector3, up: THREE.Vector3, width: number, height: number): void {
    this.camera.position.copy(towardEye).multiplyScalar(5);
    this.camera.up.copy(up);
    this.camera.lookAt(0, 0, 0);
    renderer.setViewport(width - PIXELS, height - PIXELS, PIXELS, PIXELS);
    renderer.setScissor(width - PIXELS, height - PIXELS, PIXELS, PIXELS);
    renderer.clearDepth();
    renderer.render(this.scene, this.camera);
  }
}

function letter(text: string, colour: string, place: THREE.Vector3): THREE.Sprite {
  const canvas = document.createElement("canvas"), size = 64, pen = canvas.getContext("2d");
  canvas.width = canvas.height = size;
  if (pen) {
    pen.font = "bold 46px sans-serif";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillStyle = colour;
    pen.fillText(text, size / 2, size / 2);
  }
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), depthTest: false }));
  sprite.position.copy(place);
  sprite.scale.setScalar(0.62);
  return sprite;
}
