// SPDX-License-Identifier: MIT
// Laban's Effort factors as raters meet them: their ends, and what they mean in a few words.
import type { Factor } from './types';

export interface FactorInfo {
  factor: Factor;
  name: string;
  /** The words at -1 and at 1. */
  poles: readonly [string, string];
  meaning: string;
}

export const FACTORS: readonly FactorInfo[] = [
  {
    factor: 'flow',
    name: 'Flow',
    poles: ['free', 'bound'],
    meaning:
      'How far the movement is held in check. Free: it streams and would be hard to stop. Bound: it is controlled and could stop at any moment.',
  },
  {
    factor: 'weight',
    name: 'Weight',
    poles: ['light', 'strong'],
    meaning:
      'How much force the body puts in. Light: delicate, as if nothing had to be overcome. Strong: firm and forceful, with the body behind it. How heavy the person is does not matter.',
  },
  {
    factor: 'time',
    name: 'Time',
    poles: ['sustained', 'sudden'],
    meaning:
      'Whether the movement takes its time. Sustained: unhurried, lingering. Sudden: urgent, as if there were not a moment to lose. A quick movement can still be unhurried.',
  },
  {
    factor: 'space',
    name: 'Space',
    poles: ['indirect', 'direct'],
    meaning:
      'Where the attention goes. Indirect: to many things at once, roaming. Direct: to one point, straight at it. Rate it only if you like; nothing is learnt from it.',
  },
];

export function factorInfo(factor: Factor): FactorInfo {
  return FACTORS.find((info) => info.factor === factor)!;
}

/** A value in words, e.g. "0.30 bound". */
export function inWords(factor: Factor, value: number): string {
  if (value === 0) return '0.00 neutral';
  const { poles } = factorInfo(factor);
  return `${Math.abs(value).toFixed(2)} ${value < 0 ? poles[0] : poles[1]}`;
}
