// SPDX-License-Identifier: MIT
// Curves of several clips on the one clock that keeps them in step (state/playback.ts), so that what shows at once on
// the stage lies above each other.
import { computed } from '@preact/signals';
import { duration, durationOf, frameAt, frameRange, frameRate } from '../state/playback';
import { type Actor, actors, alignments, step } from '../state/stage';

/** A value per moment; null where there is none. */
export type Values = (number | null)[];

/** The moments of the clock at which curves are drawn: at least one per frame of the fastest clip [s]. */
export const times = computed<readonly number[]>(() => {
  const rates = step.value === 'time' ? actors.value.map((actor) => actor.clip.header.frameRate) : [];
  const rate = Math.max(frameRate.value, ...rates);
  const last = Math.ceil(duration.value * rate - 1e-6);
  return Array.from({ length: last + 1 }, (_, i) => Math.min(i / rate, duration.value));
});

/** Whether what shows of `actor` is what its alignment says, and not just its time. */
export function followsAlignment(actor: Actor): boolean {
  const isAligned = actor === actors.value[0] || (alignments.value.get(actor.clip.id)?.length ?? 0) > 0;
  return step.value === 'alignment' && isAligned;
}

/** When `actor` has come to its end [s]. */
export function endOf(actor: Actor): number {
  if (followsAlignment(actor)) return duration.value;
  if (step.value !== 'frame') return durationOf(actor);
  const [begin, end] = frameRange(actor);
  return Math.max(0, end - begin - 1) / frameRate.value;
}

/** Between two frames in proportion; where only the nearer one has a value, that; otherwise null. */
export function valueAt(values: ArrayLike<number>, frame: number): number | null {
  const low = Math.floor(frame);
  const share = frame - low;
  const first = values[low] ?? Number.NaN;
  const second = share === 0 ? first : (values[low + 1] ?? Number.NaN);
  const value = first + share * (second - first);
  if (!Number.isNaN(value)) return value;
  const near = share <= 0.5 ? first : second;
  return Number.isNaN(near) ? null : near;
}

/** A clip's curve (a value per frame) at the moments of the clock; null after the clip's end. */
export function onClock(values: ArrayLike<number>, actor: Actor): Values {
  const end = endOf(actor) + 1e-6;
  return times.value.map((at) => (at > end ? null : valueAt(values, frameAt(actor, at))));
}

/** The moment of `actor`'s own time that shows at a moment of the clock [s]. */
export function momentOf(actor: Actor, at: number): number {
  return (frameAt(actor, at) - frameRange(actor)[0]) / actor.clip.header.frameRate;
}

/** How fast the clip's time goes by at a moment of the clock: over a frame before and after, as far as there is one. */
export function slopeAt(actor: Actor, at: number): number | null {
  const before = Math.max(at - 1 / frameRate.value, 0);
  const after = Math.min(at + 1 / frameRate.value, duration.value);
  return after > before ? (momentOf(actor, after) - momentOf(actor, before)) / (after - before) : null;
}

/** The first moment of the clock at which `actor` is at `frame` or beyond it [s]; the last one if it never is. */
export function clockOf(actor: Actor, frame: number): number {
  let low = 0;
  let high = duration.value;
  if (frameAt(actor, low) >= frame) return low;
  for (let i = 0; i < 40; ++i) {
    const middle = 0.5 * (low + high);
    if (frameAt(actor, middle) >= frame) high = middle;
    else low = middle;
  }
  return high;
}

/** When a foot of `actor` stands: from and to on the clock [s]. */
export function plantsOnClock(actor: Actor, foot: 0 | 1): (readonly [number, number])[] {
  const [begin, end] = frameRange(actor);
  return actor.clip.header.plants
    .filter((plant) => plant.foot === foot && plant.end > begin && plant.begin < end)
    .map((plant) => [clockOf(actor, plant.begin), clockOf(actor, plant.end - 1)] as const);
}
