// SPDX-License-Identifier: MIT
// Names of clips where there is little room: without what all of them begin with, and without their ending. The full
// name stands in tooltips.
import { computed } from '@preact/signals';
import { session } from './session';

/** Where the words of a name end: what is left out are whole words. */
const WORD_END = /[_\-. /]/;
const LETTER = /\p{L}/u;

function upToWordEnd(text: string): string {
  let length = text.length;
  while (length > 0 && !WORD_END.test(text[length - 1]!)) --length;
  return text.slice(0, length);
}

/** Whole words that all `names` begin with, and after which each still has a word, not numbers alone. */
export function sharedBeginning(names: readonly string[]): string {
  if (names.length < 2) return '';
  let shared = names[0]!;
  for (const name of names) {
    while (!name.startsWith(shared)) shared = shared.slice(0, -1);
  }
  if (names.includes(shared)) shared = shared.slice(0, -1);
  shared = upToWordEnd(shared);
  const saysNothing = (name: string) => LETTER.test(name) && !LETTER.test(name.slice(shared.length));
  while (shared !== '' && names.some(saysNothing)) shared = upToWordEnd(shared.slice(0, -1));
  return shared;
}

function bare(name: string): string {
  return name.replace(/\.bvh$/i, '');
}

const shortNames = computed(() => {
  const clips = (session.value?.files ?? []).filter((file) => file.kind === 'clip');
  const shared = sharedBeginning([...new Set(clips.map(({ name }) => bare(name)))]);
  const own = (name: string) => bare(name).slice(shared.length);
  return { shared, byId: new Map(clips.map(({ id, name }) => [id, { full: name, short: own(name) }])) };
});

/** What the short names leave out, as in "walk_"; empty where they leave out nothing. */
export const leftOut = computed(() => shortNames.value.shared);

/** The name of the clip `id` as short as tells it apart. */
export function nameOf(id: string): string {
  return shortNames.value.byId.get(id)?.short ?? id;
}

/** The name of the file of the clip `id`, for tooltips. */
export function fullNameOf(id: string): string {
  return shortNames.value.byId.get(id)?.full ?? id;
}
