// SPDX-License-Identifier: MIT
// What keeps the two sides of a pair in step, as moments of the output for the frames of the input's whole clip.
import type { Range } from './pair';

export type PairStep = 'alignment' | 'progress' | 'time';

/** Both begin and end together and run evenly between. */
export function evenly(input: Range, output: Range, numFrames: number): Float32Array {
  const slope = (output[1] - 1 - output[0]) / Math.max(1, input[1] - 1 - input[0]);
  return Float32Array.from({ length: numFrames }, (_, i) => output[0] + slope * (i - input[0]));
}

/** `moments` of the input's stretch, which begins at `begin`; before and after it, the nearest. */
export function alongWhole(moments: readonly number[], begin: number, numFrames: number): Float32Array {
  const last = moments.length - 1;
  return Float32Array.from({ length: numFrames }, (_, i) => moments[Math.min(Math.max(i - begin, 0), last)] ?? 0);
}
