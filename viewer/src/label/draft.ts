// SPDX-License-Identifier: MIT
// A label while it is made: per factor a value, "not present", or nothing yet. Values move in hundredths from -1 to 1.
import type { Factor, LabelSaid } from './types';

export type Said = number | 'not present' | null;
export type Draft = Readonly<Record<Factor, Said>>;

export const EMPTY: Draft = { flow: null, weight: null, time: null, space: null };
const ALL: readonly Factor[] = ['flow', 'weight', 'time', 'space'];
const REQUIRED: readonly Factor[] = ['flow', 'weight', 'time'];

/** The factors that are asked for, and shown. */
export function factorsShown(asksSpace: boolean): readonly Factor[] {
  return asksSpace ? ALL : REQUIRED;
}

function hundredths(value: number): number {
  const rounded = Math.round(Math.min(Math.max(value, -1), 1) * 100) / 100;
  return rounded === 0 ? 0 : rounded; // not -0
}

export function setValue(draft: Draft, factor: Factor, value: number): Draft {
  return { ...draft, [factor]: hundredths(value) };
}

/** Moves a value; what is not rated yet, or not present, starts from neutral. */
export function nudge(draft: Draft, factor: Factor, by: number): Draft {
  const said = draft[factor];
  return setValue(draft, factor, (typeof said === 'number' ? said : 0) + by);
}

/** Says that a factor is not present, or that this is not said after all. */
export function toggleNotPresent(draft: Draft, factor: Factor): Draft {
  return { ...draft, [factor]: draft[factor] === 'not present' ? null : 'not present' };
}

/** The factors on which there has to be a word before the label can be saved. */
export function missing(draft: Draft): Factor[] {
  return REQUIRED.filter((factor) => draft[factor] === null);
}

/** The label as the program is told it. */
export function labelOf(draft: Draft, comment: string, rater: string, item: string): LabelSaid {
  const value = (factor: Factor) => (typeof draft[factor] === 'number' ? draft[factor] : null);
  return {
    rater,
    item,
    rating: { flow: value('flow'), weight: value('weight'), time: value('time'), space: value('space') },
    notPresent: ALL.filter((factor) => draft[factor] === 'not present'),
    comment: comment.replace(/\s+/g, ' ').trim(),
  };
}
