// SPDX-License-Identifier: MIT
// The stretch of time that all charts show.
import { effect, signal } from '@preact/signals';
import { duration, frameRate } from '../state/playback';

/** From and to [s]; null: everything. */
export const stretch = signal<readonly [number, number] | null>(null);

/** Shows from one moment to another, at least three frames. */
export function zoomTo([from, to]: readonly [number, number]): void {
  const least = 3 / frameRate.peek();
  const begin = Math.max(0, Math.min(from, duration.peek() - least));
  stretch.value = [begin, Math.min(Math.max(to, begin + least), duration.peek())];
}

export function zoomOut(): void {
  stretch.value = null;
}

/** From and to [s], whether everything is shown or not. */
export function shown(): readonly [number, number] {
  return stretch.value ?? [0, Math.max(duration.value, 1e-3)];
}

// Other clips: a stretch that no longer lies in them is everything.
effect(() => {
  const end = duration.value;
  const now = stretch.peek();
  if (now && now[1] > end + 1e-6) stretch.value = null;
});
