// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { shortened } from './names';

describe('short names', () => {
  it('leave out the words that all begin with', () => {
    expect(shortened(['set_walk_normal_001.bvh', 'set_walk_nasty_001.BVH'])).toEqual(['normal_001', 'nasty_001']);
    expect(shortened(['a-1.bvh', 'b-1.bvh'])).toEqual(['a-1', 'b-1']);
  });
  it('stay whole where nothing would be left', () => {
    expect(shortened(['walk_1.bvh'])).toEqual(['walk_1']);
    expect(shortened(['walk_.bvh', 'walk_2.bvh'])).toEqual(['walk_', '2']);
    expect(shortened([])).toEqual([]);
  });
});
