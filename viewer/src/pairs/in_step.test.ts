// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { alongWhole, evenly } from './in_step';

describe('two stretches in step', () => {
  it('by progress begin and end together', () => {
    const moments = evenly([10, 21], [100, 121], 40);
    expect([moments[10], moments[15], moments[20]]).toEqual([100, 110, 120]);
    expect(moments).toHaveLength(40);
  });
  it('of one frame stand still', () => {
    expect([...evenly([3, 4], [7, 8], 5)]).toEqual([7, 7, 7, 7, 7]);
  });
  it('by an alignment hold their ends outside', () => {
    expect([...alongWhole([5, 7], 1, 4)]).toEqual([5, 5, 7, 7]);
  });
});
