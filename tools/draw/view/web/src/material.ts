// Materials for faces and lines. Faces are coloured by a value at each corner and lit from beside the camera.
import * as THREE from "three";

export interface ColourMap {
  colours: number[][]; // RGB, 0 to 255
  categories: boolean; // one colour per integer
}

const vertexShader = `
#include <clipping_planes_pars_vertex>
attribute float value, plain; // plain: 1 where there is no nodal line
varying float vValue, vPlain;
varying vec3 vNormal;
void main() {
  vValue = value;
  vPlain = plain;
  vNormal = normalMatrix * normal;
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * mvPosition;
  #include <clipping_planes_vertex>
}`;

const fragmentShader = `
#include <clipping_planes_pars_fragment>
uniform sampler2D map;
uniform float low, high, size;
uniform vec3 nan, back;
uniform bool categories, painted, nodal;
varying float vValue, vPlain;
varying vec3 vNormal;
void main() {
  #include <clipping_planes_fragment>
  float place = categories ? (mod(floor(vValue + 0.5), size) + 0.5) / size : clamp((vValue - low) / (high - low), 0.0, 1.0);
  vec3 colour = texture2D(map, vec2(categories ? place : (place * (size - 1.0) + 0.5) / size, 0.5)).rgb;
  if (!(vValue == vValue)) colour = nan;
  if (nodal && vPlain < 0.5 && abs(vValue) < 1.2 * fwidth(vValue)) colour *= 0.2;
  if (!painted) colour = back;
  vec3 n = normalize(vNormal);
  if (!gl_FrontFacing) { n = -n; colour = back * 0.8; }
  float light = 0.50 + 0.50 * max(dot(n, normalize(vec3(-0.35, 0.50, 0.79))), 0.0);
  gl_FragColor = vec4(colour * light, 1.0);
}`;

export type Paint = THREE.ShaderMaterial;

export function paint(): Paint {
  return new THREE.ShaderMaterial({
    vertexShader, fragmentShader, clipping: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: {
      map: { value: null }, low: { value: 0 }, high: { value: 1 }, size: { value: 1 }, categories: { value: false },
      painted: { value: true }, nodal: { value: false }, nan: { value: new THREE.Color() }, back: { value: new THREE.Color(0.55, 0.57, 0.6) },
    },
  });
}

export function colourTexture(map: ColourMap): THREE.DataTexture {
  const data = new Uint8Array(map.colours.flatMap(([r = 0, g = 0, b = 0]) => [r, g, b, 255]));
  const texture = new THREE.DataTexture(data, map.colours.length, 1, THREE.RGBAFormat);
  const filter = map.categories ? THREE.NearestFilter : THREE.LinearFilter;
  texture.minFilter = texture.magFilter = filter;
  texture.needsUpdate = true;
  return texture;
}

export function lines(colour: number, opacity = 1): THREE.LineBasicMaterial {
  return new THREE.LineBasicMaterial({ color: colour, opacity, transparent: opacity < 1 });
}
