// SPDX-License-Identifier: MIT
// The path of a joint through a clip, thinned out where it goes evenly or rests.
import type { Clip } from '../data/clip';

export interface TrailPath {
  /** [points][3] [m]. */
  positions: Float32Array;
  /** The frame of each point. */
  frames: Float32Array;
}

/** How far a path may be from where the joint was [m]; more in a clip that lasts longer than LONG [s]. */
const OFF = 0.004;
const OFF_LONG = 0.012;
const LONG = 60;
/** No piece is longer [frames]. */
const LONGEST = 40;

/** Whether `point` is, between two frames, never farther than `off` from where an even way from one to the other has it. */
function isEven(clip: Clip, point: number, first: number, last: number, off: number): boolean {
  const { positions, numPoints } = clip;
  const a = 3 * (first * numPoints + point);
  const b = 3 * (last * numPoints + point);
  for (let frame = first + 1; frame < last; ++frame) {
    const share = (frame - first) / (last - first);
    const at = 3 * (frame * numPoints + point);
    let square = 0;
    for (let axis = 0; axis < 3; ++axis) {
      const even = positions[a + axis]! + share * (positions[b + axis]! - positions[a + axis]!);
      square += (positions[at + axis]! - even) ** 2;
    }
    if (square > off * off) return false;
  }
  return true;
}

/** The path of `point` in the frames [begin, end) of `clip`, without frames that an even way between others is near
 *  enough to; its first and last are always in it. Cost O(frames). */
export function trailPath(clip: Clip, point: number, begin: number, end: number): TrailPath {
  const off = (end - begin) / clip.header.frameRate > LONG ? OFF_LONG : OFF;
  const frames = end > begin ? [begin] : [];
  for (let frame = begin + 1; frame < end; ++frame) {
    const from = frames.at(-1)!;
    const goesOn = frame - from < LONGEST && isEven(clip, point, from, frame + 1, off);
    if (frame === end - 1 || !goesOn) frames.push(frame);
  }
  const positions = frames.flatMap((frame) => {
    const at = 3 * (frame * clip.numPoints + point);
    return [clip.positions[at]!, clip.positions[at + 1]!, clip.positions[at + 2]!];
  });
  return { positions: Float32Array.from(positions), frames: Float32Array.from(frames) };
}

/** Cuts a path into parts of at most `pieces` pieces, each beginning where the one before ends. */
export function cut({ positions, frames }: TrailPath, pieces: number): TrailPath[] {
  const parts: TrailPath[] = [];
  for (let i = 0; i + 1 < frames.length; i += pieces) {
    const end = i + pieces + 1;
    parts.push({ positions: positions.subarray(3 * i, 3 * end), frames: frames.subarray(i, end) });
  }
  return parts;
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
