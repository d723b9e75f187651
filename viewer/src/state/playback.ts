// SPDX-License-Identifier: MIT
// The clock of the page: a time on the first actor's clip, which the others follow.
import { computed, effect, signal } from '@preact/signals';
import { type Actor, actors, alignments, step } from './stage';

/** Seconds since the first actor's first frame that is played. */
export const time = signal(0);
export const isPlaying = signal(false);
/** 1 is real time. */
export const speed = signal(1);
/** The speeds that are offered. */
export const SPEEDS = [0.1, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4] as const;
/** The stretch that is played over and over [s]; none: everything. */
export const loop = signal<readonly [number, number] | null>(null);
/** Whether it begins again at the end; a stretch always does. */
export const repeats = signal(true);

/** A page that was not drawn for longer (in the background, say) goes on where it was [s]. */
const LONGEST_WAIT = 1;
/** How far from a frame the time may be and still count as on it [frames]: sums of times are not exact. */
const FRAME_SLACK = 1e-3;

export function frameRange(actor: Actor): readonly [number, number] {
  return actor.frames ?? [0, actor.clip.numFrames];
}

/** From the first frame to the last [s]. */
export function durationOf(actor: Actor): number {
  const [begin, end] = frameRange(actor);
  return Math.max(0, end - begin - 1) / actor.clip.header.frameRate;
}

/** Until the last of the clips has ended [s], on the first actor's clock. */
export const duration = computed(() => {
  const [first] = actors.value;
  if (!first) return 0;
  if (step.value === 'alignment') return durationOf(first);
  if (step.value === 'time') return Math.max(...actors.value.map(durationOf));
  const frames = (actor: Actor) => Math.max(0, frameRange(actor)[1] - frameRange(actor)[0] - 1);
  return Math.max(...actors.value.map(frames)) / first.clip.header.frameRate;
});

/** The first actor's frames per second; 30 if there is none. */
export const frameRate = computed(() => actors.value[0]?.clip.header.frameRate ?? 30);

function within(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), Math.max(low, high));
}

/** The moment that belongs to a frame of the first clip: between two frames, between their moments. */
function momentAt(moments: Float32Array, frame: number): number {
  const at = within(frame, 0, moments.length - 1);
  const low = Math.floor(at);
  const high = Math.min(low + 1, moments.length - 1);
  return moments[low]! + (at - low) * (moments[high]! - moments[low]!);
}

/** The frame of `actor` (a fraction lies between two) that is shown at `at` seconds, kept within what is played. */
export function frameAt(actor: Actor, at: number): number {
  const first = actors.value[0] ?? actor;
  const [begin, end] = frameRange(actor);
  const rate = step.value === 'frame' ? first.clip.header.frameRate : actor.clip.header.frameRate;
  const moments = step.value === 'alignment' && actor !== first && alignments.value.get(actor.clip.id);
  if (!moments || moments.length === 0) return within(begin + at * rate, begin, end - 1);
  return within(momentAt(moments, frameRange(first)[0] + at * first.clip.header.frameRate), begin, end - 1);
}

/** Goes to a moment, kept within the clips. */
export function seek(to: number): void {
  if (Number.isFinite(to)) time.value = within(to, 0, duration.value);
}

/** Plays; from the beginning if it stands at the end. */
export function play(): void {
  if (duration.value === 0) return;
  if (loop.value === null && time.value >= duration.value) time.value = 0;
  isPlaying.value = true;
}

export function togglePlaying(): void {
  if (isPlaying.value) isPlaying.value = false;
  else play();
}

/** Stops, and goes on by `count` frames of the first clip; from between two frames, the next one counts as one. */
export function stepFrames(count: number): void {
  isPlaying.value = false;
  const frame = time.value * frameRate.value;
  const from = count > 0 ? Math.floor(frame + FRAME_SLACK) : Math.ceil(frame - FRAME_SLACK);
  seek((from + count) / frameRate.value);
}

/** The next of the offered speeds above (1) or below (-1) the present one; at the last one it stays. */
export function changeSpeed(direction: 1 | -1): void {
  const further = SPEEDS.filter((offered) => (offered - speed.value) * direction > 1e-9);
  speed.value = (direction > 0 ? further[0] : further.at(-1)) ?? speed.value;
}

/** Plays between two moments over and over, at least one frame apart; in either order. */
export function setLoop(one: number, other: number): void {
  const frame = 1 / frameRate.value;
  if (duration.value < frame) return;
  const begin = within(Math.min(one, other), 0, duration.value - frame);
  loop.value = [begin, within(Math.max(one, other), begin + frame, duration.value)];
}

/** Lets the stretch begin here; it ends where it did, or with the clips if that is before. */
export function setLoopBegin(at: number): void {
  const end = loop.value?.[1] ?? duration.value;
  setLoop(at, end > at ? end : duration.value);
}

/** Lets the stretch end here; it begins where it did, or with the clips if that is after. */
export function setLoopEnd(at: number): void {
  const begin = loop.value?.[0] ?? 0;
  setLoop(begin < at ? begin : 0, at);
}

/** Whether it played before a person took hold of the time. */
let playedBefore = false;

/** A person takes hold of the time: it stands meanwhile. */
export function beginScrubbing(): void {
  playedBefore = isPlaying.value;
  isPlaying.value = false;
}

/** Goes on as before. */
export function endScrubbing(): void {
  isPlaying.value = playedBefore;
  playedBefore = false;
}

/** Where the time is after it went on to `next` [s] within [begin, end]: at the end it begins again, or stops. */
function goOn(next: number, begin: number, end: number): void {
  if (next >= begin && next <= end) {
    time.value = next;
  } else if (loop.value !== null || repeats.value) {
    time.value = next < begin ? begin : begin + ((next - begin) % (end - begin));
  } else {
    time.value = end;
    isPlaying.value = false;
  }
}

/** Lets `seconds` of a person's time go by. */
export function advance(seconds: number): void {
  if (!isPlaying.value || duration.value === 0) return;
  const [begin, end] = loop.value ?? [0, duration.value];
  goOn(time.value + Math.min(seconds, LONGEST_WAIT) * speed.value, begin, end);
}

// What is shown has changed: time and stretch stay within it.
effect(() => {
  const end = duration.value;
  if (end === 0) return;
  if (time.peek() > end) time.value = end;
  const stretch = loop.peek();
  if (stretch && stretch[0] >= end) loop.value = null;
  else if (stretch && stretch[1] > end) loop.value = [stretch[0], end];
});
