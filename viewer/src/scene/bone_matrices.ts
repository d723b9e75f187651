// SPDX-License-Identifier: MIT
// Matrices of the instances that draw bones and joints, written straight from the points. A bone's shape lies along +Y
// from 0 to 1 with radius 1. Nothing is allocated.

/** The smallest cross product that still says which way a bone is turned. */
const PARALLEL = 1e-4;

/** Writes into columns x and z of matrix `m` the turn about the axis y: the one before, as far as the axis lets it. */
function turn(m: Float32Array, m0: number, x: number, y: number, z: number, radius: number): void {
  let ax = m[m0]!;
  let ay = m[m0 + 1]!;
  let az = m[m0 + 2]!;
  let along = ax * x + ay * y + az * z;
  ax -= along * x;
  ay -= along * y;
  az -= along * z;
  let length = Math.hypot(ax, ay, az);
  if (!(length > PARALLEL * radius)) {
    // Any direction across the axis: start from the coordinate axis that is least along it.
    const useX = Math.abs(x) <= Math.abs(z);
    along = useX ? x : z;
    ax = (useX ? 1 : 0) - along * x;
    ay = -along * y;
    az = (useX ? 0 : 1) - along * z;
    length = Math.hypot(ax, ay, az);
  }
  const scale = radius / length;
  ax *= scale;
  ay *= scale;
  az *= scale;
  m[m0] = ax;
  m[m0 + 1] = ay;
  m[m0 + 2] = az;
  m[m0 + 8] = ay * z - az * y;
  m[m0 + 9] = az * x - ax * z;
  m[m0 + 10] = ax * y - ay * x;
}

/** Writes matrix number `index` of `m` (column by column, 16 numbers each): the bone from point `parent` to `child` of
 *  `pose` [points][3]. A bone turns about itself as little as it can from the matrix that was there before, so that an
 *  angular one does not spin. Without a length it is not seen. */
export function writeBone(
  m: Float32Array,
  index: number,
  pose: Float32Array,
  parent: number,
  child: number,
  radius: number,
): void {
  const m0 = 16 * index;
  const x = pose[3 * child]! - pose[3 * parent]!;
  const y = pose[3 * child + 1]! - pose[3 * parent + 1]!;
  const z = pose[3 * child + 2]! - pose[3 * parent + 2]!;
  const length = Math.hypot(x, y, z);
  if (!(length > 1e-6)) {
    m.fill(0, m0, m0 + 16);
    m[m0 + 15] = 1;
    return;
  }
  turn(m, m0, x / length, y / length, z / length, radius);
  m[m0 + 3] = m[m0 + 7] = m[m0 + 11] = 0;
  m[m0 + 4] = x;
  m[m0 + 5] = y;
  m[m0 + 6] = z;
  m[m0 + 12] = pose[3 * parent]!;
  m[m0 + 13] = pose[3 * parent + 1]!;
  m[m0 + 14] = pose[3 * parent + 2]!;
  m[m0 + 15] = 1;
}

/** Writes matrix number `index` of `m`: a ball of `radius` at `point` of `pose`. */
export function writeJoint(m: Float32Array, index: number, pose: Float32Array, point: number, radius: number): void {
  const m0 = 16 * index;
  m[m0] = m[m0 + 5] = m[m0 + 10] = radius;
  m[m0 + 12] = pose[3 * point]!;
  m[m0 + 13] = pose[3 * point + 1]!;
  m[m0 + 14] = pose[3 * point + 2]!;
  m[m0 + 15] = 1;
}

/** The two ends of a head. */
const ends = new Float32Array(6);

/** Writes matrix number `index` of `m`: a head that goes from `base` on in the direction from `from` to `to`. */
export function writeHead(
  m: Float32Array,
  index: number,
  pose: Float32Array,
  { base, from, to, length }: { base: number; from: number; to: number; length: number },
  radius: number,
): void {
  let square = 0;
  for (let axis = 0; axis < 3; ++axis) square += (pose[3 * to + axis]! - pose[3 * from + axis]!) ** 2;
  const scale = square > 0 ? length / Math.sqrt(square) : 0;
  for (let axis = 0; axis < 3; ++axis) {
    const begin = pose[3 * base + axis]!;
    ends[axis] = begin;
    ends[3 + axis] = begin + scale * (pose[3 * to + axis]! - pose[3 * from + axis]!);
  }
  writeBone(m, index, ends, 0, 1, radius);
}
