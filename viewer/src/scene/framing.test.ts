// SPDX-License-Identifier: MIT
import { PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { type Direction, framing } from './framing';

const LENS = { fov: 0.6, aspect: 1.4 };
const POINTS = Float32Array.from([-1, 0, -1, 1, 0, 3, 0, 1.8, 0, 2, 0.3, -1]);

/** The points in the picture of a camera that is put where `framing` says: -1 to 1. */
function seen(direction: Direction): Vector3[] {
  const { target, distance } = framing(POINTS, direction, LENS);
  const camera = new PerspectiveCamera((LENS.fov * 180) / Math.PI, LENS.aspect, 0.01, 100);
  const look = new Vector3(...target);
  camera.position.setFromSphericalCoords(distance, Math.PI / 2 - direction.elevation, direction.azimuth).add(look);
  camera.lookAt(look);
  camera.updateMatrixWorld();
  return [0, 3, 6, 9].map((i) => new Vector3().fromArray(POINTS, i).project(camera));
}

describe('framing', () => {
  it.each([
    { azimuth: 0, elevation: 0.1 },
    { azimuth: 0.7, elevation: 0.3 },
    { azimuth: -2, elevation: 1.5 },
  ])('sees everything, and fills the picture: %o', (direction) => {
    const places = seen(direction);
    const widest = Math.max(...places.map(({ x }) => Math.abs(x)));
    const highest = Math.max(...places.map(({ y }) => Math.abs(y)));
    expect(widest).toBeLessThan(0.9);
    expect(highest).toBeLessThan(0.8);
    expect(Math.max(widest / 0.86, highest / 0.74)).toBeCloseTo(1, 3);
  });

  it('stays out of what is small', () => {
    expect(framing([0, 1, 0], { azimuth: 0, elevation: 0 }, LENS).distance).toBeGreaterThan(1);
  });
});
