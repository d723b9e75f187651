// SPDX-License-Identifier: MIT
// An actor's body: solid bones and joints, as instances whose matrices are written straight from the points.
import * as THREE from 'three';
import type { Clip } from '../data/clip';
import type { Side } from '../data/types';
import { type Bone, bodyPoints, bodySize, boneRadius, bonesOf, distance, type Head, headOf } from './body';
import { writeBone, writeHead, writeJoint } from './bone_matrices';
import { boneShape, headShape, jointShape } from './bone_shapes';
import type { Theme } from './theme';

const SIDES: readonly Side[] = ['left', 'right', 'centre'];
/** A joint is this much of the thickest bone at it. */
const JOINT = 0.62;
/** How wide a head is: its radius, of its length. */
const HEAD = 0.31;
/** How grey a head is. */
const HEAD_GREY = 0.35;
/** How much is seen of a body that another one is laid over. */
const GHOST = 0.62;

const headColour = new THREE.Color();

interface Limbs {
  side: Side;
  bones: Bone[];
  radii: Float32Array;
  mesh: THREE.InstancedMesh;
}

function instances(shape: THREE.BufferGeometry, count: number): THREE.InstancedMesh {
  const material = new THREE.MeshStandardMaterial({ roughness: 0.55, metalness: 0 });
  material.vertexColors = shape.hasAttribute('color');
  const mesh = new THREE.InstancedMesh(shape, material, count);
  mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
  mesh.frustumCulled = false;
  mesh.castShadow = true;
  return mesh;
}

export class Figure {
  readonly object = new THREE.Group();
  private readonly limbs: Limbs[];
  private readonly head: Head | null;
  private readonly headMesh: THREE.InstancedMesh;
  private readonly joints: THREE.InstancedMesh;
  private readonly jointPoints: Int32Array;
  private readonly jointRadii: Float32Array;

  /** The body of `clip`, thick as fits its first pose. */
  constructor(clip: Clip) {
    const pose = clip.pose(0, new Float32Array(3 * clip.numPoints));
    const size = bodySize(clip.header, pose);
    const bones = bonesOf(clip.header);
    const thickness = new Map<number, number>();
    const radius = (bone: Bone) => boneRadius(bone, distance(pose, bone.parent, bone.child), size);
    for (const bone of bones) {
      for (const end of [bone.parent, bone.child]) {
        const own = radius(bone) * (end === bone.child ? 0.75 : 1);
        thickness.set(end, Math.max(thickness.get(end) ?? 0, JOINT * own));
      }
    }
    this.head = headOf(clip.header, pose, size);
    this.headMesh = instances(headShape(), this.head ? 1 : 0);
    const isNeck = ({ parent, child }: Bone) => this.head?.from === parent && this.head.to === child;
    this.limbs = SIDES.map((side) => {
      const own = bones.filter((bone) => bone.side === side && !(isNeck(bone) && bone.isTip));
      return { side, bones: own, radii: Float32Array.from(own, radius), mesh: instances(boneShape(side), own.length) };
    });
    const points = bodyPoints(clip.header).filter((i) => !clip.header.points[i]!.isTip);
    this.jointPoints = Int32Array.from(points);
    this.jointRadii = Float32Array.from(points, (i) => thickness.get(i) ?? 0.02 * size);
    this.joints = instances(jointShape(), points.length);
    // Bones and head make the whole shadow.
    this.joints.castShadow = false;
    this.object.add(...this.meshes());
  }

  /** `colour` is the clip's: trunk and joints show whose body it is, the limbs which side. */
  paint(theme: Theme, colour: THREE.Color, isGhost: boolean): void {
    const paint = (mesh: THREE.InstancedMesh, own: THREE.Color) => {
      const material = mesh.material as THREE.MeshStandardMaterial;
      material.color.copy(own);
      if (material.transparent !== isGhost) material.needsUpdate = true;
      material.transparent = isGhost;
      material.opacity = isGhost ? GHOST : 1;
      mesh.renderOrder = isGhost ? 20 : 10;
    };
    for (const { side, mesh } of this.limbs) paint(mesh, side === 'centre' ? colour : theme[side]);
    paint(this.joints, colour);
    paint(this.headMesh, headColour.copy(colour).lerp(theme.soft, HEAD_GREY));
  }

  private meshes(): THREE.InstancedMesh[] {
    return [this.joints, this.headMesh, ...this.limbs.map(({ mesh }) => mesh)];
  }

  /** Puts every bone where `pose` [points][3] has it. */
  update(pose: Float32Array): void {
    for (const { bones, radii, mesh } of this.limbs) {
      const matrices = mesh.instanceMatrix.array as Float32Array;
      for (let k = 0; k < bones.length; ++k) {
        writeBone(matrices, k, pose, bones[k]!.parent, bones[k]!.child, radii[k]!);
      }
      mesh.instanceMatrix.needsUpdate = true;
    }
    if (this.head) {
      const { length } = this.head;
      writeHead(this.headMesh.instanceMatrix.array as Float32Array, 0, pose, this.head, HEAD * length);
      this.headMesh.instanceMatrix.needsUpdate = true;
    }
    const matrices = this.joints.instanceMatrix.array as Float32Array;
    for (let k = 0; k < this.jointPoints.length; ++k) {
      writeJoint(matrices, k, pose, this.jointPoints[k]!, this.jointRadii[k]!);
    }
    this.joints.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    for (const mesh of this.meshes()) {
      mesh.geometry.dispose();
      (mesh.material as THREE.Material).dispose();
      mesh.dispose();
    }
  }
}
