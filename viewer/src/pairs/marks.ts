// SPDX-License-Identifier: MIT
// Cut marks: where a stretch begins and ends in its clip. Frames are whole numbers, the end is not included.
import type { Plant } from '../data/types';
import type { Range } from './pair';

/** What is moved: one end, or both at once. */
export type Mark = 'begin' | 'end' | 'both';

/** What can be aligned has at least two frames. */
export const FEWEST_FRAMES = 2;

function within(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), Math.max(low, high));
}

/** The stretch with `mark` at the frame nearest to `to`, as far as the clip and the other mark let it; `both` moves the
 *  stretch so that it begins there. */
export function moved(range: Range, mark: Mark, to: number, numFrames: number): Range {
  const [begin, end] = range;
  const frame = Math.round(to);
  if (mark === 'begin') return [within(frame, 0, end - FEWEST_FRAMES), end];
  if (mark === 'end') return [begin, within(frame, begin + FEWEST_FRAMES, numFrames)];
  const first = within(frame, 0, numFrames - (end - begin));
  return [first, first + end - begin];
}

/** Where `mark` is. */
export function placeOf(range: Range, mark: Mark): number {
  return mark === 'end' ? range[1] : range[0];
}

/** The frames at which a foot comes down, each once, in order. */
export function onsetsOf(plants: readonly Plant[]): number[] {
  return [...new Set(plants.map((plant) => plant.begin))].sort((a, b) => a - b);
}

/** The onset nearest to `frame`, or the frame itself if none is within `reach` frames. */
export function snapped(frame: number, onsets: readonly number[], reach: number): number {
  let nearest = frame;
  let least = reach;
  for (const onset of onsets) {
    if (Math.abs(onset - frame) > least) continue;
    least = Math.abs(onset - frame);
    nearest = onset;
  }
  return nearest;
}

/** The next onset before (-1) or after (1) `frame`; the frame itself if there is none. */
export function nextOnset(frame: number, onsets: readonly number[], direction: 1 | -1): number {
  const further = onsets.filter((onset) => (onset - frame) * direction > 0);
  return (direction > 0 ? further[0] : further.at(-1)) ?? frame;
}
