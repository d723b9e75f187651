// SPDX-License-Identifier: MIT
// What tells one clip from the others wherever it is drawn: a colour of style.css and a line pattern, so that neither is
// needed alone.
/** Lengths of dashes and gaps in pixels; empty for a whole line. */
const DASHES: readonly (readonly number[])[] = [[], [7, 4], [2, 3], [10, 3, 2, 3], [4, 2], [12, 5]];
const NUM_COLOURS = 6;

/** The colour of the clip number `index` (Actor.colour), as CSS has it. */
export function colourOf(index: number): string {
  return `var(--clip-${index % NUM_COLOURS})`;
}

/** The line pattern of the clip number `index`: together with the colour, no two of 36 are alike. */
export function dashOf(index: number): readonly number[] {
  return DASHES[(index + Math.floor(index / NUM_COLOURS)) % DASHES.length]!;
}

/** Gives everything in `ids` a number: the one it had, or the smallest that is free. */
export function numbered(ids: readonly string[], before: ReadonlyMap<string, number>): Map<string, number> {
  const numbers = new Map(ids.flatMap((id) => (before.has(id) ? [[id, before.get(id)!] as const] : [])));
  const taken = new Set(numbers.values());
  let free = 0;
  for (const id of ids) {
    if (numbers.has(id)) continue;
    while (taken.has(free)) ++free;
    taken.add(free);
    numbers.set(id, free);
  }
  return numbers;
}
