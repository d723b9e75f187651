// SPDX-License-Identifier: MIT
// Marks along a length of time: round numbers of seconds with their names, and finer ones between, down to frames.

export interface Ticks {
  /** Moments [s] that are named. */
  named: readonly number[];
  /** Moments [s] between. */
  fine: readonly number[];
}

/** What may lie between two named marks [s]. */
const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600];
/** Names closer than this run together [px]. */
const NAME_SPACE = 84;
/** Marks closer than this are a blur [px]. */
const MARK_SPACE = 6;

function multiples(step: number, duration: number): number[] {
  const count = Math.floor(duration / step + 1e-6) + 1;
  return Array.from({ length: count }, (_, i) => i * step);
}

/** Marks for `duration` seconds at `frameRate` on `width` pixels; none if there is nothing to mark. */
export function ticksOf(duration: number, frameRate: number, width: number): Ticks {
  if (!(duration > 0) || !(width > 0)) return { named: [], fine: [] };
  const space = (step: number) => (step / duration) * width;
  const step = STEPS.find((seconds) => space(seconds) >= NAME_SPACE) ?? STEPS.at(-1)!;
  const finer = [1 / frameRate, step / 10, step / 5, step / 2].find((seconds) => space(seconds) >= MARK_SPACE);
  return { named: multiples(step, duration), fine: finer ? multiples(finer, duration) : [] };
}

/** A length of time as it is written: 4.25 s, or 1:04.25 from a minute on. */
export function written(seconds: number): string {
  if (!(seconds >= 60)) return seconds.toFixed(2);
  const hundredths = Math.round(seconds * 100);
  return `${Math.floor(hundredths / 6000)}:${((hundredths % 6000) / 100).toFixed(2).padStart(5, '0')}`;
}

/** What a tick is named: 0.5 s, 20 s, 1:30. */
export function tickName(seconds: number): string {
  return written(seconds).replace(/\.?0+$/, '') + (seconds < 60 ? ' s' : '');
}

/** The seconds that a person wrote: 4.25 or 1:04.25, also with a comma or "s"; no number if it is none. */
export function readSeconds(text: string): number {
  const match = /^\s*(?:(\d+):)?(\d*[.,]?\d+|\d+[.,]?)\s*s?\s*$/.exec(text);
  if (!match) return Number.NaN;
  return Number(match[1] ?? 0) * 60 + Number(match[2]!.replace(',', '.'));
}
