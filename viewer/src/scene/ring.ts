// SPDX-License-Identifier: MIT
// The ring on the floor under a body, in its clip's colour and pattern.
import * as THREE from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { ringArcs } from './clip_pattern';

const RADIUS = 0.34;
const INNER = 0.3;
const SEGMENTS = 72;

export class Ring {
  readonly object: THREE.Mesh;
  private readonly material = new THREE.MeshBasicMaterial({ transparent: true, depthWrite: false });

  constructor(colour: number) {
    const parts = ringArcs(colour, 2 * Math.PI * RADIUS).map(({ begin, length }) => {
      const segments = Math.max(2, Math.round(SEGMENTS * length));
      const turn = 2 * Math.PI;
      return new THREE.RingGeometry(INNER, RADIUS, segments, 1, turn * begin, turn * length);
    });
    this.object = new THREE.Mesh(mergeGeometries(parts).rotateX(-Math.PI / 2), this.material);
    for (const part of parts) part.dispose();
    this.object.renderOrder = 5;
  }

  paint(colour: THREE.Color): void {
    this.material.color.copy(colour);
  }

  /** Puts the ring under the point `pelvis` of `pose`. */
  update(pose: Float32Array, pelvis: number): void {
    this.object.position.set(pose[3 * pelvis]!, 0, pose[3 * pelvis + 2]!);
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.material.dispose();
  }
}
