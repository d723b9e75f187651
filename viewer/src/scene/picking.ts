// SPDX-License-Identifier: MIT
// Which joint is under the pointer.

/** What is nearest, and how far it is from the pointer [pixels]. */
export interface Nearest {
  point: number;
  distance: number;
}

/** Of `points` of `pose` [points][3], the one drawn nearest to (x, y) in a picture of `width` by `height` pixels, if one
 *  is within `reach`. `projection` takes the pose to clip space: 16 numbers, column by column. */
export function nearestPoint(
  pose: Float32Array,
  points: readonly number[],
  projection: ArrayLike<number>,
  [width, height]: readonly [number, number],
  [x, y]: readonly [number, number],
  reach: number,
): Nearest | null {
  const m = projection;
  let nearest: Nearest | null = null;
  for (const point of points) {
    const [px, py, pz] = [pose[3 * point]!, pose[3 * point + 1]!, pose[3 * point + 2]!];
    const w = m[3]! * px + m[7]! * py + m[11]! * pz + m[15]!;
    if (!(w > 0)) continue;
    const sx = ((m[0]! * px + m[4]! * py + m[8]! * pz + m[12]!) / w + 1) * 0.5 * width;
    const sy = (1 - (m[1]! * px + m[5]! * py + m[9]! * pz + m[13]!) / w) * 0.5 * height;
    const distance = Math.hypot(sx - x, sy - y);
    if (distance <= (nearest?.distance ?? reach)) nearest = { point, distance };
  }
  return nearest;
}
