// SPDX-License-Identifier: MIT
// Footskate on the floor: for every frame in which a foot stands, where its slower end is and how fast that slides.
import type { Clip } from '../data/clip';

/** [marks][3]: x and z [m], and how fast it slides [m/s]; the slowest first, so that they do not hide what is worse. */
export type SlideMarks = Float32Array;

/** A mark this near the one before, and about as fast, is left out [m, m/s]. */
const NEAR = 0.003;
const ALIKE = 0.01;

/** How far `point` moves over the floor from one frame to the next [m]. */
function way(clip: Clip, frame: number, point: number): number {
  const stride = 3 * clip.numPoints;
  const a = Math.max(0, frame - 1) * stride + 3 * point;
  const b = Math.min(clip.numFrames - 1, frame + 1) * stride + 3 * point;
  return Math.hypot(clip.positions[b]! - clip.positions[a]!, clip.positions[b + 2]! - clip.positions[a + 2]!);
}

/** The marks of one foot in the order of time. */
function marksOf(clip: Clip, foot: number, { ankle, toe }: { ankle: number; toe: number }): number[][] {
  const marks: number[][] = [];
  for (let frame = 0; frame < clip.numFrames; ++frame) {
    const slide = clip.slide[2 * frame + foot]!;
    if (!Number.isFinite(slide)) continue;
    const slower = way(clip, frame, ankle) < way(clip, frame, toe) ? ankle : toe;
    const at = 3 * (frame * clip.numPoints + slower);
    const [x, z] = [clip.positions[at]!, clip.positions[at + 2]!];
    const before = marks.at(-1);
    const isNew = !before || Math.hypot(x - before[0]!, z - before[1]!) > NEAR || Math.abs(slide - before[2]!) > ALIKE;
    if (isNew) marks.push([x, z, slide]);
  }
  return marks;
}

/** All marks of `clip`, in its own coordinates; none if its slide was not measured. Cost O(frames log frames). */
export function slideMarks(clip: Clip): SlideMarks {
  const { legs } = clip.header;
  if (!legs || clip.slide.length < 2 * clip.numFrames) return new Float32Array();
  const marks = legs.flatMap((leg, foot) => marksOf(clip, foot, leg));
  marks.sort((a, b) => a[2]! - b[2]!);
  return Float32Array.from(marks.flat());
}
