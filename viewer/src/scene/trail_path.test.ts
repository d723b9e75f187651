// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { clipOf, LEFT_TOE } from './clip_of.test_support';
import { dashesOf, ringArcs } from './clip_pattern';
import { pieceFrames, shownFrames, trailPath } from './trail_path';

describe('trailPath', () => {
  it('goes through every frame of a joint that moves', () => {
    const clip = clipOf({ frames: 30, speed: 3 });
    const { positions, frames } = trailPath(clip, LEFT_TOE, 5, 20);
    expect([...frames]).toEqual(Array.from({ length: 15 }, (_, i) => 5 + i));
    expect(positions[2]).toBeCloseTo(0.15 + 0.5, 5);
  });

  it('is thin where a joint rests, but keeps both ends', () => {
    const { frames } = trailPath(clipOf({ frames: 30 }), LEFT_TOE, 0, 30);
    expect([...frames]).toEqual([0, 29]);
  });

  it('knows the frames at the ends of each piece', () => {
    expect([...pieceFrames(Float32Array.from([0, 3, 4]))]).toEqual([0, 3, 3, 4]);
    expect(pieceFrames(Float32Array.from([0]))).toHaveLength(0);
  });
});

describe('shownFrames', () => {
  it('is the clip, or what was just now', () => {
    expect(shownFrames(50, null, 30, [10, 100])).toEqual([10, 99]);
    expect(shownFrames(50, 1, 30, [10, 100])).toEqual([20, 50]);
    expect(shownFrames(15, 1, 30, [10, 100])).toEqual([10, 15]);
  });
});

describe('ringArcs', () => {
  it('is whole for the first clip, and in pieces for others, each in its own way', () => {
    const around = 2;
    const drawn = [0, 1, 2, 3, 4, 5].map((colour) => ringArcs(colour, around));
    expect(drawn[0]).toEqual([{ begin: 0, length: 1 }]);
    expect(new Set(drawn.map((arcs) => arcs.length)).size).toBeGreaterThan(3);
    for (const arcs of drawn) {
      for (const { begin, length } of arcs) expect(begin + length).toBeLessThanOrEqual(1 + 1e-9);
    }
  });

  it('has the pattern of the trails', () => {
    const [drawn, gap, , last] = dashesOf(3);
    expect(gap).toBeGreaterThan(0);
    expect(drawn).toBeGreaterThan(gap);
    expect(last).toBeGreaterThan(0);
  });
});
