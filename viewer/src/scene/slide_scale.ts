// SPDX-License-Identifier: MIT
// The scale of footskate: how fast a foot that stands slides, as colour and as size. The same for all clips.

/** Where the scale ends [m/s]; what is faster is shown like this. */
export const FASTEST = 0.2;
/** Radius of a mark that does not slide, and of the fastest [m]. */
export const SMALLEST = 0.01;
export const LARGEST = 0.055;

/** Viridis (Smith and van der Walt 2015) at equal steps: brighter the faster, also without red and green. */
const VIRIDIS: readonly (readonly [number, number, number])[] = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 74, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [109, 205, 89],
  [180, 222, 44],
  [253, 231, 37],
];

/** Where `slide` [m/s] lies on the scale: 0 to 1. */
export function onScale(slide: number): number {
  return Math.min(Math.max(slide / FASTEST, 0), 1);
}

/** The colour at `share` (0..1) of the scale, as sRGB from 0 to 255. */
export function slideColour(share: number): [number, number, number] {
  const at = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(at), VIRIDIS.length - 2);
  const mix = (channel: 0 | 1 | 2) => {
    const from = VIRIDIS[low]![channel];
    return Math.round(from + (at - low) * (VIRIDIS[low + 1]![channel] - from));
  };
  return [mix(0), mix(1), mix(2)];
}

/** The scale as a CSS gradient from left to right. */
export function slideGradient(): string {
  const stops = VIRIDIS.map((_, i) => `rgb(${slideColour(i / (VIRIDIS.length - 1)).join(' ')})`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

export function slideRadius(slide: number): number {
  return SMALLEST + onScale(slide) * (LARGEST - SMALLEST);
}
