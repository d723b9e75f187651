// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { clipOf, LEFT_ANKLE, LEFT_TOE } from './clip_of.test_support';
import { plantMarks } from './plant_marks';
import { slideMarks } from './slide_marks';
import { onScale, slideColour, slideRadius } from './slide_scale';

describe('plantMarks', () => {
  const plants = [
    { foot: 0, begin: 2, end: 8 },
    { foot: 1, begin: 5, end: 9 },
  ] as const;

  it('lays a sole under each foot, from heel to toe', () => {
    const { places, spans } = plantMarks(clipOf({ frames: 10, start: [3, 4], header: { plants: [...plants] } }));
    expect([...spans]).toEqual([2, 8, 0, 5, 9, 1]);
    const [x, z, aheadX, aheadZ] = places;
    expect(x).toBeCloseTo(3.1, 5);
    expect(z! - aheadZ!).toBeLessThan(4);
    expect(z! + aheadZ!).toBeGreaterThan(4.15);
    expect(aheadX).toBeCloseTo(0, 5);
    expect(places[4]).toBeCloseTo(2.9, 5);
  });

  it('points where the foot points', () => {
    const clip = clipOf({ frames: 10, heading: Math.PI / 2, header: { plants: [plants[0]] } });
    const [, , aheadX, aheadZ] = plantMarks(clip).places;
    expect(aheadX).toBeGreaterThan(0.1);
    expect(aheadZ).toBeCloseTo(0, 5);
  });

  it('has nothing to mark without legs', () => {
    const { places } = plantMarks(clipOf({ frames: 10, header: { plants: [...plants], legs: undefined } }));
    expect(places).toHaveLength(0);
  });
});

describe('slideMarks', () => {
  const slide = new Float32Array(20).fill(Number.NaN);
  for (let frame = 3; frame < 7; ++frame) slide[2 * frame] = 0.3 - 0.05 * frame;

  it('marks only frames in which a foot stands, the slowest first', () => {
    const marks = slideMarks(clipOf({ frames: 10, speed: 1, slide }));
    expect(marks).toHaveLength(3 * 4);
    const speeds = [2, 5, 8, 11].map((i) => marks[i]!);
    expect(speeds).toEqual([...speeds].sort((a, b) => a - b));
    expect(speeds[3]).toBeCloseTo(0.15, 5);
  });

  it('marks the end of the foot that is slower', () => {
    const clip = clipOf({ frames: 10, slide });
    for (let frame = 0; frame < 10; ++frame) clip.positions[3 * (frame * clip.numPoints + LEFT_ANKLE)]! += frame;
    const marks = slideMarks(clip);
    const toe = 3 * (3 * clip.numPoints + LEFT_TOE);
    expect(marks[0]).toBeCloseTo(clip.positions[toe]!, 5);
    expect(marks[1]).toBeCloseTo(clip.positions[toe + 2]!, 5);
  });

  it('marks a foot at rest once', () => {
    const still = new Float32Array(20).fill(Number.NaN);
    for (let frame = 0; frame < 10; ++frame) still[2 * frame] = 0;
    expect(slideMarks(clipOf({ frames: 10, slide: still }))).toHaveLength(3);
  });

  it('is empty where nothing was measured', () => {
    expect(slideMarks(clipOf({ frames: 10 }))).toHaveLength(0);
  });
});

describe('the scale of footskate', () => {
  it('grows and brightens with the speed, and ends', () => {
    const brightness = (slide: number) => slideColour(onScale(slide)).reduce((sum, channel) => sum + channel, 0);
    expect(slideRadius(0.1)).toBeGreaterThan(slideRadius(0));
    expect(brightness(0.2)).toBeGreaterThan(brightness(0.1));
    expect(slideRadius(5)).toBe(slideRadius(0.2));
    expect(slideColour(onScale(5))).toEqual([253, 231, 37]);
  });
});
