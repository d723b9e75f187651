// SPDX-License-Identifier: MIT
// Compare: which clips are on the stage and which of them the others follow. Named clips are on it as they come, until a
// person takes them off; the first one is the reference.
import { computed, effect, signal } from '@preact/signals';
import { numbered } from './looks';
import { nameOf } from './names';
import { loadClip, loadedClips, namedClips, problems, session } from './session';
import type { Actor } from './stage';

/** More named clips than this are not put on the stage of themselves: one could not tell them apart. */
export const MOST_AT_FIRST = 12;

/** Ids in the order a person asked for; the first of those that have come is the reference. */
const order = signal<readonly string[]>([]);
/** Ids of the clips a person took off the stage. */
const hidden = signal<ReadonlySet<string>>(new Set());
/** Ids of the clips of pair lists that a person put on it. */
const added = signal<readonly string[]>([]);

/** The ids of what is on the stage or will be when it has come, the reference first. */
export const chosen = computed<readonly string[]>(() => {
  const named = namedClips.value.map((file) => file.id);
  const ids = new Set(session.value?.files.map((file) => file.id));
  const isThere = (id: string) => ids.has(id) && !hidden.value.has(id) && !problems.value.has(id);
  const all = [...named.slice(0, MOST_AT_FIRST), ...added.value].filter(isThere);
  const first = order.value.filter((id) => all.includes(id));
  return [...new Set([...first, ...all])];
});

/** The number that tells each chosen clip from the others; a clip keeps its own. */
export const numbers = signal<ReadonlyMap<string, number>>(new Map());
effect(() => {
  numbers.value = numbered(chosen.value, numbers.peek());
});

/** What Compare puts on the stage. */
export const comparedActors = computed<Actor[]>(() =>
  chosen.value.flatMap((id) => {
    const clip = loadedClips.value.get(id);
    return clip ? [{ clip, colour: numbers.value.get(id) ?? 0, title: nameOf(id) }] : [];
  }),
);

export function isChosen(id: string): boolean {
  return chosen.value.includes(id);
}

/** Puts a clip on the stage, or takes it off. */
export function choose(id: string, isOn: boolean): void {
  const without = new Set(hidden.value);
  if (isOn) without.delete(id);
  else without.add(id);
  hidden.value = without;
  if (!isOn || chosen.value.includes(id)) return;
  added.value = [...added.value, id];
  loadClip(id).catch(() => {}); // told beside the file
}

/** Lets the others follow the clip `id`. */
export function setReference(id: string): void {
  choose(id, true);
  order.value = [id, ...order.value.filter((other) => other !== id)];
}
