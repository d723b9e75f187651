// SPDX-License-Identifier: MIT
// A joint's trail: its path as a line in the clip's colour and pattern, made once; what is past, to come or not shown is
// told apart on the graphics card by the frames at the ends of each piece. Patterns have four lengths, not two as three's.
import * as THREE from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { Clip } from '../data/clip';
import { dashesOf } from './clip_pattern';
import { pieceFrames, shownFrames, trailPath } from './trail_path';

const WIDTH = 3.5;
const MARK = 0.028;

/** Adds to the material of fat lines which frames are shown and which moment it is. */
function withMoments(material: LineMaterial, dashes: readonly [number, number, number, number]): LineMaterial {
  const shown = { value: new THREE.Vector2() };
  const pattern = { value: new THREE.Vector4(...dashes) };
  Object.assign(material.uniforms, { shown, pattern, now: { value: 0 }, fades: { value: 0 } });
  material.vertexShader = material.vertexShader
    .replace(
      'void main() {',
      `attribute vec2 moments;
      uniform vec2 shown;
      varying float moment;
      void main() {
        moment = position.y < 0.5 ? moments.x : moments.y;`,
    )
    .replace(
      '#include <logdepthbuf_vertex>',
      `if (moments.y < shown.x || moments.x > shown.y) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      #include <logdepthbuf_vertex>`,
    );
  material.fragmentShader = material.fragmentShader
    .replace(
      'void main() {',
      'uniform vec2 shown; uniform vec4 pattern; uniform float now; uniform float fades; varying float moment;\nvoid main() {',
    )
    .replace(
      'float alpha = opacity;',
      `if (moment < shown.x || moment > shown.y) discard;
      float age = (moment - shown.x) / max(shown.y - shown.x, 1e-3);
      float alpha = opacity * mix(moment > now ? 0.3 : 1.0, 0.1 + 0.9 * age, fades);`,
    )
    .replace(
      'if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard;',
      `float along = mod(vLineDistance, pattern.x + pattern.y + pattern.z + pattern.w) - pattern.x;
      if ((along > 0.0 && along < pattern.y) || along > pattern.y + pattern.z) discard;`,
    );
  return material;
}

export class Trail {
  readonly object = new THREE.Group();
  private readonly material: LineMaterial;
  private readonly geometry = new LineGeometry();
  private readonly mark: THREE.Mesh;
  private readonly halo: THREE.Mesh;

  constructor(
    private readonly clip: Clip,
    private readonly point: number,
    private readonly frames: readonly [number, number],
    colour: number,
  ) {
    const dashes = dashesOf(colour);
    const { positions, frames: moments } = trailPath(clip, point, ...frames);
    // A whole line is dashed too, with gaps of nothing: without the round ends that show where pieces meet.
    const lines = new LineMaterial({ linewidth: WIDTH, dashed: true, transparent: true });
    this.material = withMoments(lines, dashes);
    this.material.depthWrite = false;
    const ball = new THREE.SphereGeometry(1, 20, 14);
    this.mark = new THREE.Mesh(ball, new THREE.MeshBasicMaterial());
    this.halo = new THREE.Mesh(ball, new THREE.MeshBasicMaterial({ side: THREE.BackSide }));
    this.mark.scale.setScalar(MARK);
    this.halo.scale.setScalar(MARK * 1.35);
    this.object.add(this.mark, this.halo);
    if (moments.length < 2) return;
    this.geometry.setPositions(positions);
    this.geometry.setAttribute('moments', new THREE.InstancedBufferAttribute(pieceFrames(moments), 2));
    const line = new Line2(this.geometry, this.material);
    line.computeLineDistances();
    line.frustumCulled = false;
    line.renderOrder = 12;
    this.object.add(line);
  }

  paint(colour: THREE.Color, outline: THREE.Color): void {
    this.material.color.copy(colour);
    (this.mark.material as THREE.MeshBasicMaterial).color.copy(colour);
    (this.halo.material as THREE.MeshBasicMaterial).color.copy(outline);
  }

  update(pose: Float32Array, frame: number, seconds: number | null): void {
    const [first, last] = shownFrames(frame, seconds, this.clip.header.frameRate, this.frames);
    const { shown, now, fades } = this.material.uniforms;
    (shown!.value as THREE.Vector2).set(first, last);
    now!.value = frame;
    fades!.value = seconds === null ? 0 : 1;
    const at = 3 * this.point;
    this.mark.position.set(pose[at]!, pose[at + 1]!, pose[at + 2]!);
    this.halo.position.copy(this.mark.position);
  }

  dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
    this.mark.geometry.dispose();
    (this.mark.material as THREE.Material).dispose();
    (this.halo.material as THREE.Material).dispose();
  }
}
