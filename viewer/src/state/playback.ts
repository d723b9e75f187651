// SPDX-License-Identifier: MIT
// The clock of the page: a time on the first actor's clip, which the others follow.
import { computed, signal } from '@preact/signals';
import { type Actor, actors, alignments, step } from './stage';

/** Seconds since the first actor's first frame that is played. */
export const time = signal(0);
export const isPlaying = signal(false);
/** 1 is real time. */
export const speed = signal(1);
/** The stretch that is played over and over [s]; none: everything. */
export const loop = signal<readonly [number, number] | null>(null);

export function frameRange(actor: Actor): readonly [number, number] {
  return actor.frames ?? [0, actor.clip.numFrames];
}

/** From the first frame to the last [s]. */
export function durationOf(actor: Actor): number {
  const [begin, end] = frameRange(actor);
  return Math.max(0, end - begin - 1) / actor.clip.header.frameRate;
}

export const duration = computed(() => {
  const [first, ...others] = actors.value;
  if (!first) return 0;
  if (step.value === 'alignment') return durationOf(first);
  if (step.value === 'time') return Math.max(...actors.value.map(durationOf));
  const frames = (actor: Actor) => frameRange(actor)[1] - frameRange(actor)[0];
  return Math.max(frames(first), ...others.map(frames)) / first.clip.header.frameRate;
});

/** The frame of `actor` (a fraction lies between two) that is shown at `at` seconds, kept within what is played. */
export function frameAt(actor: Actor, at: number): number {
  const first = actors.value[0] ?? actor;
  const [begin, end] = frameRange(actor);
  const keep = (frame: number) => Math.min(Math.max(frame, begin), Math.max(begin, end - 1));
  if (step.value === 'time' || actor === first) return keep(begin + at * actor.clip.header.frameRate);
  if (step.value === 'frame') return keep(begin + at * first.clip.header.frameRate);
  const moments = alignments.value.get(actor.clip.id);
  if (!moments || moments.length === 0) return keep(begin + at * actor.clip.header.frameRate);
  const frame = frameRange(first)[0] + at * first.clip.header.frameRate;
  const low = Math.min(Math.floor(frame), moments.length - 1);
  const high = Math.min(low + 1, moments.length - 1);
  return keep(moments[low]! + (frame - low) * (moments[high]! - moments[low]!));
}

/** Goes to a moment, kept within the clips. */
export function seek(to: number): void {
  time.value = Math.min(Math.max(to, 0), duration.value);
}

/** Lets `seconds` of a person's time go by. At the end (of the loop) it begins again. */
export function advance(seconds: number): void {
  if (!isPlaying.value || duration.value === 0) return;
  const [begin, end] = loop.value ?? [0, duration.value];
  const next = time.value + seconds * speed.value;
  time.value = next > end || next < begin ? begin : next;
}
