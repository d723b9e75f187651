// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { positionOf, valueAt } from './scale';

const RANGES = [
  { least: 0, greatest: 1.5, values: [0, 0.01, 0.8, 1, 1.5] },
  { least: 0.1, greatest: 1000, values: [0.1, 2, 40, 1000] },
  { least: 0, greatest: 60, values: [0, 0.3, 5, 60] },
];

describe('a slider', () => {
  it('gives back the number it is put on', () => {
    for (const { values, ...range } of RANGES) {
      for (const value of values) expect(valueAt(positionOf(value, range), range)).toBe(value);
    }
  });

  it('reaches both ends and keeps within them', () => {
    for (const range of RANGES) {
      expect(positionOf(range.least - 1, range)).toBe(0);
      expect(positionOf(range.greatest + 1, range)).toBe(1);
    }
  });
});
