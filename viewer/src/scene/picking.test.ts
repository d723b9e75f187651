// SPDX-License-Identifier: MIT
import { Matrix4, PerspectiveCamera } from 'three';
import { describe, expect, it } from 'vitest';
import { nearestPoint } from './picking';

const camera = new PerspectiveCamera(40, 2, 0.1, 50);
camera.position.set(0, 0, 5);
camera.updateMatrixWorld();
const projection = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
const SIZE = [400, 200] as const;
const POSE = Float32Array.from([0, 0, 0, 0.2, 0, 0, 0, 0, 9]);

describe('nearestPoint', () => {
  it('finds what is drawn under the pointer', () => {
    const found = nearestPoint(POSE, [0, 1, 2], projection, SIZE, [200, 100], 10)!;
    expect(found.point).toBe(0);
    expect(found.distance).toBeCloseTo(0, 5);
  });

  it('finds the nearer of two', () => {
    expect(nearestPoint(POSE, [0, 1], projection, SIZE, [209, 100], 12)!.point).toBe(1);
  });

  it('finds nothing far away, nor behind the camera', () => {
    expect(nearestPoint(POSE, [0, 1], projection, SIZE, [20, 20], 10)).toBeNull();
    expect(nearestPoint(POSE, [2], projection, SIZE, [200, 100], 10)).toBeNull();
  });
});
