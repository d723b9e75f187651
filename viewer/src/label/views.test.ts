// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { Clip } from '../data/clip';
import { clipOf } from '../state/clip_of.test_support';
import { turned, viewsOf } from './views';

describe('turned', () => {
  it('turns what points forward to the right and keeps heights', () => {
    const { header } = clipOf('a', 1, 30);
    const clip = new Clip({ header, arrays: { positions: new Float32Array([1, 2, 3]) } });
    expect([...turned(clip).positions.subarray(0, 3)]).toEqual([3, 2, -1]);
  });
});

describe('viewsOf', () => {
  it('shows one movement from two sides, or from one', () => {
    const clip = clipOf('a', 1, 30);
    expect(viewsOf(clip, true).map((actor) => actor.title)).toEqual(['front', 'side']);
    expect(viewsOf(clip, false).map((actor) => actor.title)).toEqual(['fragment']);
  });
});
