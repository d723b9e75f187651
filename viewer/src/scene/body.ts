// SPDX-License-Identifier: MIT
// What of a clip's points is drawn as a body: its bones, how large it is, and where it faces.
import type { Clip } from '../data/clip';
import type { ClipHeader, Side } from '../data/types';

/** A bone from the point `parent` to the point `child`. */
export interface Bone {
  parent: number;
  child: number;
  side: Side;
  isTip: boolean;
}

/** The indices of the pelvis and of what hangs on it; what is above only carries the body about. */
export function bodyPoints({ points, pelvis }: Pick<ClipHeader, 'points' | 'pelvis'>): number[] {
  const isBody = points.map((_, i) => i === pelvis);
  points.forEach((point, i) => {
    if (point.parent >= 0 && isBody[point.parent]) isBody[i] = true;
  });
  return points.flatMap((_, i) => (isBody[i] ? [i] : []));
}

/** The bones that are drawn. */
export function bonesOf(header: Pick<ClipHeader, 'points' | 'pelvis'>): Bone[] {
  return bodyPoints(header)
    .filter((i) => i !== header.pelvis)
    .map((i) => {
      const { parent, side, isTip } = header.points[i]!;
      return { parent, child: i, side, isTip };
    });
}

/** How far the point `b` is from `a` in a pose [points][3] [m]. */
export function distance(pose: Float32Array, a: number, b: number): number {
  return Math.hypot(
    pose[3 * a]! - pose[3 * b]!,
    pose[3 * a + 1]! - pose[3 * b + 1]!,
    pose[3 * a + 2]! - pose[3 * b + 2]!,
  );
}

/** The longest way along the bones from the pelvis to a tip [m]: about 1.2 for a grown person. 1 without bones. */
export function bodySize(header: Pick<ClipHeader, 'points' | 'pelvis'>, pose: Float32Array): number {
  const reach = new Map<number, number>([[header.pelvis, 0]]);
  for (const { parent, child } of bonesOf(header)) {
    reach.set(child, (reach.get(parent) ?? 0) + distance(pose, parent, child));
  }
  const size = Math.max(...reach.values());
  return size > 0 && Number.isFinite(size) ? size : 1;
}

/** How thick a bone is drawn [m]: longer ones thicker, but neither threads nor barrels; the trunk stout, tips thin. */
export function boneRadius({ side, isTip }: Bone, length: number, size: number): number {
  const radius = Math.min(Math.max(0.13 * length, 0.011 * size), 0.038 * size);
  if (isTip) return 0.6 * radius;
  return side === 'centre' ? 1.6 * radius : radius;
}

/** A head: at the point `base`, in the direction from one point to another. */
export interface Head {
  base: number;
  from: number;
  to: number;
  length: number;
}

/** Where the trunk ends highest, a head: as long as the file says, or, where it says nothing, as long as heads are. */
export function headOf(header: Pick<ClipHeader, 'points' | 'pelvis'>, pose: Float32Array, size: number): Head | null {
  const bones = bonesOf(header).filter((bone) => bone.side === 'centre');
  const ends = bones.filter(({ child }) => !bones.some(({ parent }) => parent === child));
  ends.sort((a, b) => pose[3 * b.child + 1]! - pose[3 * a.child + 1]!);
  const [end] = ends;
  if (!end) return null;
  const length = distance(pose, end.parent, end.child);
  if (end.isTip && length > 0.05 * size) return { base: end.parent, from: end.parent, to: end.child, length };
  const base = end.isTip ? end.parent : end.child;
  const from = header.points[base]!.parent;
  return base === header.pelvis ? null : { base, from, to: base, length: 0.17 * size };
}

/** The points by which a body has a left and a right, hips and shoulders: they do not swing. */
export function sidePoints({
  points,
  pelvis,
}: Pick<ClipHeader, 'points' | 'pelvis'>): Record<'left' | 'right', number[]> {
  const inward = bodyPoints({ points, pelvis }).filter((i) => points[points[i]!.parent]?.side === 'centre');
  const of = (side: Side) => inward.filter((i) => points[i]!.side === side);
  return { left: of('left'), right: of('right') };
}

/** Which way is left on the floor, not normalized, where `positions` has the points of a pose from `start` on; written
 *  into `out`: zero for a body without sides. */
export function leftward(
  positions: Float32Array,
  start: number,
  { left, right }: Record<'left' | 'right', readonly number[]>,
  out: { x: number; z: number },
): void {
  out.x = out.z = 0;
  if (left.length === 0 || right.length === 0) return;
  for (const i of left) {
    out.x += positions[start + 3 * i]! / left.length;
    out.z += positions[start + 3 * i + 2]! / left.length;
  }
  for (const i of right) {
    out.x -= positions[start + 3 * i]! / right.length;
    out.z -= positions[start + 3 * i + 2]! / right.length;
  }
}

/** Where the body faces about frame `begin` (over at most a second, before `end`): the angle from +Z towards +X [rad];
 *  0 for a body without sides. */
export function headingAt(clip: Clip, begin: number, end: number): number {
  const last = Math.min(end, begin + Math.ceil(clip.header.frameRate), clip.numFrames);
  const stride = Math.max(1, Math.floor((last - begin) / 10));
  const sides = sidePoints(clip.header);
  const left = { x: 0, z: 0 };
  let x = 0;
  let z = 0;
  for (let frame = begin; frame < last; frame += stride) {
    leftward(clip.positions, 3 * frame * clip.numPoints, sides, left);
    const length = Math.hypot(left.x, left.z) || 1;
    x -= left.z / length;
    z += left.x / length;
  }
  return x === 0 && z === 0 ? 0 : Math.atan2(x, z);
}
