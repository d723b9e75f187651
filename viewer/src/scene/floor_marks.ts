// SPDX-License-Identifier: MIT
// What is drawn on the floor of a clip, each kind as instances made once: footplants and footskate. Which plant stands now
// is told apart on the graphics card.
import * as THREE from 'three';
import type { Clip } from '../data/clip';
import { plantMarks } from './plant_marks';
import { slideMarks } from './slide_marks';
import { onScale, slideColour, slideRadius } from './slide_scale';
import type { Theme } from './theme';

/** A square on the floor with texture coordinates: from the left of who stands on it to the right, from heel to toe. */
function square(): THREE.InstancedBufferGeometry {
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute([1, 0, -1, -1, 0, -1, -1, 0, 1, 1, 0, 1], 3));
  geometry.setAttribute('uv', new THREE.Float32BufferAttribute([0, 0, 1, 0, 1, 1, 0, 1], 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return geometry;
}

function floorMaterial(vertexShader: string, fragmentShader: string, uniforms: Record<string, THREE.IUniform>) {
  const flags = { transparent: true, depthWrite: false, side: THREE.DoubleSide };
  return new THREE.ShaderMaterial({ vertexShader, fragmentShader, uniforms, ...flags });
}

function marks(geometry: THREE.BufferGeometry, material: THREE.Material, order: number): THREE.Mesh {
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = order;
  return mesh;
}

const PLANT_VERTEX = /* glsl */ `
  attribute vec4 mark;
  attribute vec3 span;
  uniform float now;
  uniform float reach;
  varying vec2 at;
  varying vec3 when;
  varying float near;
  void main() {
    at = uv;
    when = span;
    vec2 ahead = mark.zw;
    vec2 left = vec2(ahead.y, -ahead.x) * 0.46;
    vec2 place = mark.xy + position.z * ahead + position.x * left;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(place.x, 0.0, place.y, 1.0);
    float away = max(span.x - now, now - span.y) / reach;
    near = 1.0 - smoothstep(0.6, 1.0, away);
    if (away > 1.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const PLANT_FRAGMENT = /* glsl */ `
  uniform sampler2D feet;
  uniform float now;
  uniform vec3 left;
  uniform vec3 right;
  varying vec2 at;
  varying vec3 when;
  varying float near;
  void main() {
    vec4 foot = texture2D(feet, vec2((at.x + when.z) * 0.5, at.y));
    float stands = step(when.x, now) * (1.0 - step(when.y, now));
    float past = step(when.y, now);
    float faint = max(foot.r * mix(0.42, 0.6, past), foot.g * 0.1 * past);
    float alpha = near * mix(faint, max(foot.r, foot.g * 0.55), stands);
    gl_FragColor = vec4(when.z < 0.5 ? left : right, alpha);
    #include <colorspace_fragment>
  }`;

/** Pixels of the outline of one foot. */
const CELL_WIDTH = 128;
const CELL_HEIGHT = 278;

/** The sole of a foot, rounded (left) or with corners (right), within a cell. */
function sole(foot: 0 | 1): Path2D {
  const path = new Path2D();
  const [w, h, edge] = [CELL_WIDTH, CELL_HEIGHT, 10];
  if (foot === 0) {
    path.roundRect(edge, edge, w - 2 * edge, h - 2 * edge, [w / 2 - edge, w / 2 - edge, w / 2.6, w / 2.6]);
    return path;
  }
  const corners = [
    [0.3, 0],
    [0.7, 0],
    [1, 0.16],
    [1, 0.55],
    [0.82, 1],
    [0.18, 1],
    [0, 0.55],
    [0, 0.16],
  ];
  for (const [x, y] of corners) path.lineTo(edge + x! * (w - 2 * edge), edge + y! * (h - 2 * edge));
  path.closePath();
  return path;
}

/** Both soles side by side: outline and letter in red, what is within in green. */
function feetTexture(): THREE.CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = 2 * CELL_WIDTH;
  canvas.height = CELL_HEIGHT;
  const pen = canvas.getContext('2d')!;
  pen.fillStyle = '#000';
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.globalCompositeOperation = 'lighter';
  pen.lineWidth = 11;
  pen.strokeStyle = '#f00';
  pen.font = 'bold 92px sans-serif';
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const foot of [0, 1] as const) {
    pen.setTransform(1, 0, 0, 1, foot * CELL_WIDTH, 0);
    pen.fillStyle = '#0f0';
    pen.fill(sole(foot));
    pen.stroke(sole(foot));
    pen.fillStyle = '#f00';
    pen.fillText('LR'[foot]!, CELL_WIDTH / 2, CELL_HEIGHT * 0.4);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.anisotropy = 8;
  return texture;
}

/** Plants that are longer ago, or to come, are not shown [s]: in a long clip one could not make out any. */
const REACH = 15;

/** The footplants of a clip. */
export class PlantView {
  readonly object: THREE.Mesh;
  private readonly texture = feetTexture();
  private readonly uniforms = {
    feet: { value: this.texture },
    now: { value: 0 },
    reach: { value: 0 },
    left: { value: new THREE.Color() },
    right: { value: new THREE.Color() },
  };

  constructor(clip: Clip) {
    const { places, spans } = plantMarks(clip);
    this.uniforms.reach.value = REACH * clip.header.frameRate;
    const geometry = square();
    geometry.setAttribute('mark', new THREE.InstancedBufferAttribute(places, 4));
    geometry.setAttribute('span', new THREE.InstancedBufferAttribute(spans, 3));
    geometry.instanceCount = spans.length / 3;
    this.object = marks(geometry, floorMaterial(PLANT_VERTEX, PLANT_FRAGMENT, this.uniforms), 3);
  }

  paint(theme: Theme): void {
    this.uniforms.left.value.copy(theme.left);
    this.uniforms.right.value.copy(theme.right);
  }

  update(frame: number): void {
    this.uniforms.now.value = frame;
  }

  dispose(): void {
    this.object.geometry.dispose();
    (this.object.material as THREE.Material).dispose();
    this.texture.dispose();
  }
}

const SLIDE_VERTEX = /* glsl */ `
  attribute vec3 mark;
  attribute vec3 colour;
  varying vec2 at;
  varying vec3 ink;
  void main() {
    at = uv * 2.0 - 1.0;
    ink = colour;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(mark.x + position.x * mark.z, 0.0, mark.y + position.z * mark.z, 1.0);
  }`;

const SLIDE_FRAGMENT = /* glsl */ `
  uniform vec3 edge;
  varying vec2 at;
  varying vec3 ink;
  void main() {
    float r = length(at);
    float pixel = max(fwidth(r), 1e-4);
    float cover = 1.0 - smoothstep(1.0 - pixel, 1.0, r);
    float isEdge = smoothstep(1.0 - 2.2 * pixel, 1.0 - 1.2 * pixel, r) * 0.55;
    gl_FragColor = vec4(mix(ink, edge, isEdge), cover);
    #include <colorspace_fragment>
  }`;

/** The footskate of a clip. */
export class SlideView {
  readonly object: THREE.Mesh;
  private readonly uniforms = { edge: { value: new THREE.Color() } };

  constructor(clip: Clip) {
    const slides = slideMarks(clip);
    const count = slides.length / 3;
    const discs = new Float32Array(slides);
    const colours = new Float32Array(slides.length);
    const colour = new THREE.Color();
    for (let i = 0; i < count; ++i) {
      const slide = slides[3 * i + 2]!;
      discs[3 * i + 2] = slideRadius(slide);
      const [r, g, b] = slideColour(onScale(slide));
      colour.setRGB(r / 255, g / 255, b / 255, THREE.SRGBColorSpace).toArray(colours, 3 * i);
    }
    const geometry = square();
    geometry.setAttribute('mark', new THREE.InstancedBufferAttribute(discs, 3));
    geometry.setAttribute('colour', new THREE.InstancedBufferAttribute(colours, 3));
    geometry.instanceCount = count;
    this.object = marks(geometry, floorMaterial(SLIDE_VERTEX, SLIDE_FRAGMENT, this.uniforms), 6);
  }

  paint(theme: Theme): void {
    this.uniforms.edge.value.copy(theme.text);
  }

  dispose(): void {
    this.object.geometry.dispose();
    (this.object.material as THREE.Material).dispose();
  }
}
