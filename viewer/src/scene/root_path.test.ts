// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { clipOf } from './clip_of.test_support';
import { pathAt, rootPath } from './root_path';

function at(path: Float64Array, frame: number): { x: number; z: number } {
  const out = { x: 0, z: 0 };
  pathAt(path, frame, out);
  return out;
}

describe('rootPath', () => {
  it('does not lag behind a body that walks evenly, to its very ends', () => {
    const path = rootPath(clipOf({ frames: 90, speed: 1.5 }));
    for (const frame of [0, 1, 10, 44.5, 88, 89]) expect(at(path, frame).z).toBeCloseTo((1.5 * frame) / 30, 4);
  });

  it('takes out the sway of the hips', () => {
    const clip = clipOf({ frames: 120, speed: 1 });
    const sway = (frame: number) => 0.05 * Math.sin((2 * Math.PI * frame) / 30);
    for (let frame = 0; frame < 120; ++frame) {
      clip.positions[3 * (frame * clip.numPoints + clip.header.pelvis)]! += sway(frame);
    }
    const path = rootPath(clip);
    for (let frame = 30; frame < 90; ++frame) expect(Math.abs(at(path, frame).x)).toBeLessThan(0.025);
  });

  it('keeps within the clip', () => {
    const path = rootPath(clipOf({ frames: 10, speed: 1 }));
    expect(at(path, -5)).toEqual(at(path, 0));
    expect(at(path, 50)).toEqual(at(path, 9));
  });
});
