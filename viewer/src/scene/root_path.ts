// SPDX-License-Identifier: MIT
// The way of a body over the floor, smoothed: what the camera follows. As it belongs to the clip and not to what was drawn
// before, scrubbing and looping move the camera exactly as they move the body.
import type { Clip } from '../data/clip';

/** Over how long the way is averaged [s]: about a stride, so that the sway of the hips does not shake the camera. */
const SMOOTHING = 1;

/** Mean of `values` [n][2] over up to `reach` frames on either side, the same number on both. Cost O(n). */
function averaged(values: Float64Array, reach: number): Float64Array {
  const n = values.length / 2;
  const sums = new Float64Array(values.length + 2);
  for (let i = 0; i < values.length; ++i) sums[i + 2] = sums[i]! + values[i]!;
  const out = new Float64Array(values.length);
  for (let i = 0; i < n; ++i) {
    const r = Math.min(reach, i, n - 1 - i);
    for (let axis = 0; axis < 2; ++axis) {
      out[2 * i + axis] = (sums[2 * (i + r + 1) + axis]! - sums[2 * (i - r) + axis]!) / (2 * r + 1);
    }
  }
  return out;
}

/** Where the pelvis is over the floor, smoothed [frames][2] (x and z) [m]. Cost O(frames). */
export function rootPath(clip: Clip): Float64Array {
  const stride = 3 * clip.numPoints;
  const path = new Float64Array(2 * clip.numFrames);
  for (let frame = 0; frame < clip.numFrames; ++frame) {
    const at = frame * stride + 3 * clip.header.pelvis;
    path[2 * frame] = clip.positions[at]!;
    path[2 * frame + 1] = clip.positions[at + 2]!;
  }
  const reach = Math.round((SMOOTHING * clip.header.frameRate) / 4);
  return averaged(averaged(path, reach), reach);
}

/** The path at `frame` (a fraction lies between two frames) into `out`. */
export function pathAt(path: Float64Array, frame: number, out: { x: number; z: number }): void {
  const last = path.length / 2 - 1;
  const first = Math.min(Math.max(Math.floor(frame), 0), last);
  const second = Math.min(first + 1, last);
  const share = Math.min(Math.max(frame - first, 0), 1);
  out.x = path[2 * first]! + share * (path[2 * second]! - path[2 * first]!);
  out.z = path[2 * first + 1]! + share * (path[2 * second + 1]! - path[2 * first + 1]!);
}
