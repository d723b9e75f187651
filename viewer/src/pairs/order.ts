// SPDX-License-Identifier: MIT
// Which pairs of a list are shown, and in which order.
import { factsOf, type Kind } from './facts';
import type { Pair } from './pair';

export type SortKey = 'list' | 'distance' | 'kind' | 'input' | 'output';

export interface Wish {
  sort: SortKey;
  kind: Kind | 'any';
  /** A part of the name of either clip. */
  clip: string;
  /** Only pairs that are neither accepted nor rejected. */
  onlyOpen: boolean;
}

export const EVERYTHING: Wish = { sort: 'list', kind: 'any', clip: '', onlyOpen: false };

type Names = (clip: string) => string;

function fits(pair: Pair, wish: Wish, nameOf: Names): boolean {
  if (wish.onlyOpen && pair.verdict !== 'none') return false;
  if (wish.kind !== 'any' && factsOf(pair.comment).kind !== wish.kind) return false;
  const part = wish.clip.trim().toLowerCase();
  return [pair.input, pair.output].some((side) => nameOf(side.clip).toLowerCase().includes(part));
}

/** By which a pair comes before another; what has no distance comes last. */
function keyOf(pair: Pair, sort: SortKey, nameOf: Names): string | number {
  switch (sort) {
    case 'list':
      return pair.id;
    case 'distance':
      return factsOf(pair.comment).distance ?? Number.POSITIVE_INFINITY;
    case 'kind':
      return factsOf(pair.comment).kind;
    default:
      return nameOf(pair[sort].clip);
  }
}

function compare(a: string | number, b: string | number): number {
  if (a === b) return 0;
  return typeof a === 'string' ? a.localeCompare(String(b), undefined, { numeric: true }) : a < (b as number) ? -1 : 1;
}

/** The pairs that fit, sorted; those that are equal stay in the list's order. */
export function ordered(pairs: readonly Pair[], wish: Wish, nameOf: Names): Pair[] {
  const keyed = pairs
    .filter((pair) => fits(pair, wish, nameOf))
    .map((pair) => ({
      pair,
      key: keyOf(pair, wish.sort, nameOf),
    }));
  return keyed.sort((a, b) => compare(a.key, b.key) || a.pair.id - b.pair.id).map(({ pair }) => pair);
}

/** The id `count` places after `id` in `shown`; the last or first if there are not so many, the first if it is not there. */
export function neighbour(shown: readonly Pair[], id: number, count: number): number {
  const at = shown.findIndex((pair) => pair.id === id);
  const to = at < 0 ? 0 : Math.min(Math.max(at + count, 0), shown.length - 1);
  return shown[to]?.id ?? id;
}
