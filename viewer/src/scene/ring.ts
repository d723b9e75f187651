// SPDX-License-Identifier: MIT
// The ring on the floor under a body, in its clip's colour and pattern, with a point to where the body faces.
import * as THREE from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { ringArcs } from './clip_pattern';

const RADIUS = 0.34;
const INNER = 0.3;
const SEGMENTS = 72;
/** The size of the point [m]. */
const POINT = 0.07;

export class Ring {
  readonly object: THREE.Mesh;
  private readonly material = new THREE.MeshBasicMaterial({ transparent: true, depthWrite: false });

  constructor(colour: number) {
    const parts: THREE.BufferGeometry[] = ringArcs(colour, 2 * Math.PI * RADIUS).map(({ begin, length }) => {
      const segments = Math.max(2, Math.round(SEGMENTS * length));
      const turn = 2 * Math.PI;
      return new THREE.RingGeometry(INNER, RADIUS, segments, 1, turn * begin, turn * length);
    });
    parts.push(new THREE.CircleGeometry(POINT, 3).rotateZ(-Math.PI / 2).translate(0, -(RADIUS + POINT), 0));
    this.object = new THREE.Mesh(mergeGeometries(parts).rotateX(-Math.PI / 2), this.material);
    for (const part of parts) part.dispose();
    this.object.renderOrder = 5;
  }

  paint(colour: THREE.Color): void {
    this.material.color.copy(colour);
  }

  /** Puts the ring under the point `pelvis` of `pose`, turned to where the body faces: an angle from +Z towards +X [rad]. */
  update(pose: Float32Array, pelvis: number, facing: number): void {
    this.object.rotation.y = facing;
    this.object.position.set(pose[3 * pelvis]!, 0, pose[3 * pelvis + 2]!);
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.material.dispose();
  }
}
