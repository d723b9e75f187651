// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { Clip } from '../data/clip';
import { clipOf } from '../state/clip_of.test_support';
import { held, turned, viewsOf } from './views';

describe('turned', () => {
  it('turns what points forward to the right and keeps heights', () => {
    const { header } = clipOf('a', 1, 30);
    const clip = new Clip({ header, arrays: { positions: new Float32Array([1, 2, 3]) } });
    expect([...turned(clip).positions.subarray(0, 3)]).toEqual([3, 2, -1]);
  });
});

describe('held', () => {
  it('adds the last pose and no sliding', () => {
    const { header } = clipOf('a', 2, 30);
    const points = [{ name: 'hips', parent: -1, side: 'centre', isTip: false }] as const;
    const positions = new Float32Array([1, 2, 3, 4, 5, 6]);
    const slide = new Float32Array([0.5, 0.5, 0.5, 0.5]);
    const longer = held(new Clip({ header: { ...header, points: [...points] }, arrays: { positions, slide } }), 0.1);
    expect(longer.numFrames).toBe(5);
    expect([...longer.positions]).toEqual([1, 2, 3, 4, 5, 6, 4, 5, 6, 4, 5, 6, 4, 5, 6]);
    expect([...longer.slide.subarray(4)].every(Number.isNaN)).toBe(true);
  });
});

describe('viewsOf', () => {
  it('shows one movement from two sides, or from one', () => {
    const clip = clipOf('a', 1, 30);
    expect(viewsOf(clip, true).map((actor) => actor.title)).toEqual(['front', 'side']);
    expect(viewsOf(clip, false).map((actor) => actor.title)).toEqual(['fragment']);
  });
});
