// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { clipOf, LEFT_TOE } from './clip_of.test_support';
import { dashesOf, ringArcs } from './clip_pattern';
import { cut, pieceFrames, shownFrames, trailPath } from './trail_path';

describe('trailPath', () => {
  it('is never far from where the joint was', () => {
    const clip = clipOf({ frames: 90 });
    const at = (frame: number) => 3 * (frame * clip.numPoints + LEFT_TOE);
    for (let frame = 0; frame < 90; ++frame) clip.positions[at(frame)] = 0.3 * Math.sin(frame / 8);
    const { positions, frames } = trailPath(clip, LEFT_TOE, 5, 80);
    expect(frames.length).toBeLessThan(40);
    expect([frames[0], frames.at(-1)]).toEqual([5, 79]);
    for (let i = 0; i + 1 < frames.length; ++i) {
      for (let frame = frames[i]!; frame < frames[i + 1]!; ++frame) {
        const share = (frame - frames[i]!) / (frames[i + 1]! - frames[i]!);
        const x = positions[3 * i]! + share * (positions[3 * i + 3]! - positions[3 * i]!);
        expect(Math.abs(x - clip.positions[at(frame)]!)).toBeLessThan(0.0041);
      }
    }
  });

  it('is thin where a joint rests or goes evenly, but keeps both ends', () => {
    for (const speed of [0, 2]) {
      const { frames } = trailPath(clipOf({ frames: 30, speed }), LEFT_TOE, 0, 30);
      expect([...frames]).toEqual([0, 29]);
    }
  });

  it('is empty without frames', () => {
    expect(trailPath(clipOf({ frames: 5 }), LEFT_TOE, 3, 3).frames).toHaveLength(0);
  });

  it('can be cut into parts that hang together', () => {
    const path = {
      positions: Float32Array.from({ length: 15 }, (_, i) => i),
      frames: Float32Array.from([0, 1, 2, 3, 4]),
    };
    const parts = cut(path, 3);
    expect(parts.map(({ frames }) => [...frames])).toEqual([
      [0, 1, 2, 3],
      [3, 4],
    ]);
    expect([...parts[1]!.positions]).toEqual([9, 10, 11, 12, 13, 14]);
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
