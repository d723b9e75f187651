// SPDX-License-Identifier: MIT
// The path of a joint through a clip, thinned out where it rests.
import type { Clip } from '../data/clip';

export interface TrailPath {
  /** [points][3] [m]. */
  positions: Float32Array;
  /** The frame of each point. */
  frames: Float32Array;
}

/** Points closer to the one before than this are left out [m]. */
const THINNED = 0.004;

/** The path of `point` in the frames [begin, end) of `clip`; its first and last frames are always in it. */
export function trailPath(clip: Clip, point: number, begin: number, end: number): TrailPath {
  const positions: number[] = [];
  const frames: number[] = [];
  const stride = clip.numPoints;
  for (let frame = begin; frame < end; ++frame) {
    const at = 3 * (frame * stride + point);
    const [x, y, z] = [clip.positions[at]!, clip.positions[at + 1]!, clip.positions[at + 2]!];
    const n = positions.length;
    const moved = n === 0 ? Infinity : Math.hypot(x - positions[n - 3]!, y - positions[n - 2]!, z - positions[n - 1]!);
    if (moved < THINNED && frame !== end - 1) continue;
    positions.push(x, y, z);
    frames.push(frame);
  }
  return { positions: Float32Array.from(positions), frames: Float32Array.from(frames) };
}

/** The frames that are shown [first, last] at `frame`, when a trail shows `seconds` (null: everything). */
export function shownFrames(
  frame: number,
  seconds: number | null,
  frameRate: number,
  [begin, end]: readonly [number, number],
): [number, number] {
  if (seconds === null) return [begin, Math.max(begin, end - 1)];
  return [Math.max(begin, frame - seconds * frameRate), frame];
}

/** For every piece between two points of a path: the frames at its ends [pieces][2]. */
export function pieceFrames(frames: Float32Array): Float32Array {
  const ends = new Float32Array(2 * Math.max(0, frames.length - 1));
  for (let i = 0; i + 1 < frames.length; ++i) {
    ends[2 * i] = frames[i]!;
    ends[2 * i + 1] = frames[i + 1]!;
  }
  return ends;
}
