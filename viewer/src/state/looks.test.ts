// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { colourOf, dashOf, numbered } from './looks';

describe('looks', () => {
  it('no two of 36 clips look alike', () => {
    const looks = Array.from({ length: 36 }, (_, i) => `${colourOf(i)} ${dashOf(i)}`);
    expect(new Set(looks).size).toBe(36);
  });

  it('a clip keeps its number when others go, and a new one takes the first that is free', () => {
    const before = numbered(['a', 'b', 'c'], new Map());
    expect([...before]).toEqual([
      ['a', 0],
      ['b', 1],
      ['c', 2],
    ]);
    const after = numbered(['c', 'd', 'b'], before);
    expect(after.get('c')).toBe(2);
    expect(after.get('b')).toBe(1);
    expect(after.get('d')).toBe(0);
  });
});
