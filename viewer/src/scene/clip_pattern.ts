// SPDX-License-Identifier: MIT
// The pattern that tells a clip from the others (state/looks.ts), in space: along lines and round the ring at a body's feet.
import { dashOf } from '../state/looks';

/** Metres for each pixel of the pattern as it is drawn in lists and curves. */
const SCALE = 0.014;

/** Lengths drawn and left out in turns [m], twice each; the second is 0 for a whole line. */
export function dashesOf(colour: number): readonly [number, number, number, number] {
  const pattern = dashOf(colour).map((length) => SCALE * length);
  const [a = 1, b = 0, c = a, d = b] = pattern;
  return [a, b, c, d];
}

/** A piece of a ring: where it begins and how far it goes, in parts of a turn. */
export interface Arc {
  begin: number;
  length: number;
}

/** The ring of a clip whose way round is `around` metres: its pattern, fitted to a whole number of repeats. */
export function ringArcs(colour: number, around: number): Arc[] {
  const [a, b, c, d] = dashesOf(colour);
  if (b === 0) return [{ begin: 0, length: 1 }];
  const once = a + b + c + d;
  const repeats = Math.max(1, Math.round(around / once));
  return Array.from({ length: repeats }, (_, i) => [
    { begin: i / repeats, length: a / once / repeats },
    { begin: (i + (a + b) / once) / repeats, length: c / once / repeats },
  ]).flat();
}
