// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { bodyPoints, bodySize, boneRadius, bonesOf, headingAt, headOf } from './body';
import { clipOf } from './clip_of.test_support';

const clip = clipOf({ frames: 2 });
const pose = clip.pose(0, new Float32Array(3 * clip.numPoints));

describe('a body', () => {
  it('leaves out what is above the pelvis', () => {
    expect(bodyPoints(clip.header)).not.toContain(0);
    expect(bonesOf(clip.header).some(({ parent }) => parent === 0)).toBe(false);
    expect(bonesOf(clip.header)).toHaveLength(clip.numPoints - 2);
  });

  it('is as large as its longest way from the pelvis', () => {
    const leg = Math.hypot(0.1, 0.05) + 0.45 + 0.4 + Math.hypot(0.08, 0.15);
    expect(bodySize(clip.header, pose)).toBeCloseTo(leg, 5);
  });

  it('has a head where the file says nothing of one', () => {
    const head = headOf(clip.header, pose, 1);
    expect(head).toMatchObject({ base: 3, from: 2, to: 3 });
    expect(head!.length).toBeGreaterThan(0.1);
  });

  it('has the head that the file tells of', () => {
    const long = clip.pose(0, new Float32Array(3 * clip.numPoints));
    long[3 * 12 + 1]! += 0.2;
    const head = headOf(clip.header, long, 1)!;
    expect(head).toMatchObject({ base: 3, from: 3, to: 12 });
    expect(head.length).toBeCloseTo(0.2, 5);
  });

  it('has thin tips and a stout trunk', () => {
    const bone = { parent: 0, child: 1, side: 'left', isTip: false } as const;
    const limb = boneRadius(bone, 0.1, 1);
    expect(boneRadius({ ...bone, isTip: true }, 0.1, 1)).toBeLessThan(limb);
    expect(boneRadius({ ...bone, side: 'centre' }, 0.1, 1)).toBeGreaterThan(limb);
  });
});

describe('headingAt', () => {
  it.each([0, 1, -2, 3])('finds the way that a body faces: %d', (heading) => {
    expect(headingAt(clipOf({ frames: 40, heading }), 0, 40)).toBeCloseTo(heading, 5);
  });

  it('is 0 for a body without sides', () => {
    const points = clip.header.points.map((point) => ({ ...point, side: 'centre' as const }));
    expect(headingAt(clipOf({ frames: 3, heading: 1, header: { points } }), 0, 3)).toBe(0);
  });
});
