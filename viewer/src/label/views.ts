// SPDX-License-Identifier: MIT
// A movement seen from two sides at once: as it comes, facing the viewer, and turned so that it faces to the right.
import { Clip } from '../data/clip';
import type { Actor } from '../state/stage';

/** Between the end of a movement and its beginning [s]. */
const HOLD = 0.5;

/** The clip turned by a quarter about the vertical: what pointed to +Z points to +X. */
export function turned(clip: Clip): Clip {
  const positions = new Float32Array(clip.positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    positions[i] = clip.positions[i + 2]!;
    positions[i + 1] = clip.positions[i + 1]!;
    positions[i + 2] = -clip.positions[i]!;
  }
  const header = { ...clip.header, id: `${clip.id}-side` };
  return new Clip({ header, arrays: { positions, slide: clip.slide } });
}

function extended(values: Float32Array, perFrame: number, numFrames: number, count: number, by?: number): Float32Array {
  const longer = new Float32Array((numFrames + count) * perFrame);
  longer.set(values);
  const last = values.subarray((numFrames - 1) * perFrame);
  for (let i = numFrames; i < numFrames + count; ++i) {
    if (by === undefined) longer.set(last, i * perFrame);
    else longer.fill(by, i * perFrame, (i + 1) * perFrame);
  }
  return longer;
}

/** The clip with its last pose held for `seconds`: shown over and over, its end can be told from its beginning. */
export function held(clip: Clip, seconds: number): Clip {
  const { header, numFrames, numPoints } = clip;
  const count = Math.round(seconds * header.frameRate);
  const positions = extended(clip.positions, 3 * numPoints, numFrames, count);
  const slide = clip.slide.length > 0 ? extended(clip.slide, 2, numFrames, count, Number.NaN) : clip.slide;
  return new Clip({ header: { ...header, numFrames: numFrames + count }, arrays: { positions, slide } });
}

/** What is put on the stage: nothing of it tells which movement it is. */
export function viewsOf(movement: Clip, isFromTwoSides: boolean): Actor[] {
  const clip = held(movement, HOLD);
  const front: Actor = { clip, colour: 0, title: isFromTwoSides ? 'front' : 'fragment' };
  return isFromTwoSides ? [front, { clip: turned(clip), colour: 0, title: 'side' }] : [front];
}
