// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { clipOf, type Walk } from './clip_of.test_support';
import { type Course, courseOf, type Placement, placed, placements } from './placement';
import { pathAt } from './root_path';

const SIDE_BY_SIDE = { layout: 'side-by-side', facesAlike: true, startsTogether: false } as const;
const FROM_ONE_PLACE = { layout: 'overlaid', facesAlike: true, startsTogether: true } as const;

function course(walk: Walk): Course {
  return courseOf(clipOf(walk), [0, walk.frames]);
}

function placeAt(by: Course, placement: Placement, frame: number): { x: number; z: number } {
  const place = { x: 0, z: 0 };
  pathAt(by.path, Math.min(frame, by.end - 1), place);
  return placed(place, placement);
}

/** How near two placed courses come to each other. */
function nearest(a: Course, b: Course, [pa, pb]: Placement[]): number {
  let found = Infinity;
  for (let frame = 0; frame < Math.max(a.end, b.end); ++frame) {
    const [p, q] = [placeAt(a, pa!, frame), placeAt(b, pb!, frame)];
    found = Math.min(found, Math.hypot(p.x - q.x, p.z - q.z));
  }
  return found;
}

describe('side by side', () => {
  const far = course({ frames: 60, start: [7, -3], heading: 2, speed: 1 });
  const near = course({ frames: 60, start: [0, 1], heading: -1, speed: 1 });

  it('brings clips that begin anywhere next to each other, facing forward', () => {
    const [a, b] = placements([far, near], SIDE_BY_SIDE);
    expect(placeAt(far, a!, 0).z).toBeCloseTo(0, 5);
    expect(placeAt(near, b!, 0).z).toBeCloseTo(0, 5);
    expect(placeAt(far, a!, 0).x).toBeCloseTo(-placeAt(near, b!, 0).x, 5);
    expect(placeAt(far, a!, 59).x).toBeCloseTo(placeAt(far, a!, 0).x, 2);
    expect(placeAt(far, a!, 59).z).toBeGreaterThan(1);
  });

  it('keeps room between bodies that walk towards each other', () => {
    const wishes = { ...SIDE_BY_SIDE, facesAlike: false };
    const right = course({ frames: 45, heading: Math.PI / 2, speed: 1 });
    const left = course({ frames: 45, heading: -Math.PI / 2, speed: 1 });
    expect(nearest(right, left, placements([right, left], wishes))).toBeGreaterThan(1.2);
    expect(nearest(far, near, placements([far, near], SIDE_BY_SIDE))).toBeGreaterThan(1.2);
  });

  it('keeps room at the moments that are shown together', () => {
    const wishes = { ...SIDE_BY_SIDE, facesAlike: false };
    const right = course({ frames: 60, heading: Math.PI / 2, speed: 1 });
    // Shows its end while the other one begins.
    const back = { ...course({ frames: 60, heading: Math.PI / 2, speed: 1 }), frameAt: (t: number) => 59 - 30 * t };
    const [a, b] = placements([right, back], wishes);
    for (let frame = 0; frame < 60; ++frame) {
      const [p, q] = [placeAt(right, a!, frame), placeAt(back, b!, 59 - frame)];
      expect(Math.hypot(p.x - q.x, p.z - q.z)).toBeGreaterThan(1.2);
    }
  });

  it('does not put bodies out of sight of each other', () => {
    const right = course({ frames: 900, heading: Math.PI / 2, speed: 1 });
    const left = course({ frames: 900, heading: -Math.PI / 2, speed: 1 });
    const [a, b] = placements([right, left], { ...SIDE_BY_SIDE, facesAlike: false });
    expect(b!.x - a!.x).toBeLessThan(6);
  });

  it('stands in the order of the clips', () => {
    const starts = placements([far, near, far, near], SIDE_BY_SIDE).map(
      (placement, i) => placeAt([far, near][i % 2]!, placement, 0).x,
    );
    expect(starts).toEqual([...starts].sort((p, q) => p - q));
  });
});

describe('overlaid', () => {
  const a = course({ frames: 30, start: [2, 2], heading: 1, speed: 1 });
  const b = course({ frames: 30, start: [-4, 0], heading: -2, speed: 1 });

  it('leaves every clip where it is', () => {
    const wishes = { ...FROM_ONE_PLACE, startsTogether: false };
    expect(placements([a, b], wishes)).toEqual([
      { x: 0, z: 0, yaw: 0 },
      { x: 0, z: 0, yaw: 0 },
    ]);
  });

  it('lays one way over the other from one place', () => {
    expect(nearest(a, b, placements([a, b], FROM_ONE_PLACE))).toBeLessThan(1e-3);
  });

  it('begins where what is played begins', () => {
    const part = { ...a, begin: 10 };
    const [placement] = placements([part], FROM_ONE_PLACE);
    expect(Math.hypot(placeAt(part, placement!, 10).x, placeAt(part, placement!, 10).z)).toBeCloseTo(0, 5);
  });
});

it('an empty clip has a place', () => {
  expect(placements([course({ frames: 0 })], SIDE_BY_SIDE)[0]).toEqual({ x: 0, z: -0, yaw: -0 });
});
