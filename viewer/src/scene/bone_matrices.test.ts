// SPDX-License-Identifier: MIT
import { Matrix4, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { writeBone, writeHead, writeJoint } from './bone_matrices';

const RADIUS = 0.1;

function matrixOf(m: Float32Array, index = 0): Matrix4 {
  return new Matrix4().fromArray(m, 16 * index);
}

/** A bone from (1, 2, 3) on in the direction (x, y, z). */
function bone(x: number, y: number, z: number, m = new Float32Array(16)) {
  writeBone(m, 0, Float32Array.from([1, 2, 3, 1 + x, 2 + y, 3 + z]), 0, 1, RADIUS);
  return m;
}

describe('writeBone', () => {
  it.each([
    [0, 0.5, 0],
    [0, -0.5, 0],
    [0.3, 0, 0],
    [0, 0, -2],
    [0.1, -0.2, 0.3],
  ])('lays the shape from one end to the other: %d %d %d', (x, y, z) => {
    const matrix = matrixOf(bone(x, y, z));
    const from = new Vector3(0, 0, 0).applyMatrix4(matrix);
    const to = new Vector3(0, 1, 0).applyMatrix4(matrix);
    expect(from.distanceTo(new Vector3(1, 2, 3))).toBeCloseTo(0, 6);
    expect(to.distanceTo(new Vector3(1 + x, 2 + y, 3 + z))).toBeCloseTo(0, 6);
  });

  it('is as thick as told, with square corners, and not mirrored', () => {
    const [x, y, z] = [new Vector3(), new Vector3(), new Vector3()];
    const matrix = matrixOf(bone(0.1, -0.2, 0.3));
    matrix.extractBasis(x, y, z);
    expect(x.length()).toBeCloseTo(RADIUS, 6);
    expect(z.length()).toBeCloseTo(RADIUS, 6);
    expect(x.dot(y)).toBeCloseTo(0, 6);
    expect(x.dot(z)).toBeCloseTo(0, 6);
    expect(matrix.determinant()).toBeGreaterThan(0);
  });

  it('does not spin as it swings past the vertical', () => {
    const m = bone(0.3, 0.9, 0);
    const before = new Vector3();
    const after = new Vector3();
    for (let k = 0; k <= 60; ++k) {
      matrixOf(m).extractBasis(before, new Vector3(), new Vector3());
      const angle = (k / 60) * Math.PI;
      bone(0.3 * Math.cos(angle), 0.9, 0.3 * Math.sin(angle), m);
      matrixOf(m).extractBasis(after, new Vector3(), new Vector3());
      expect(before.angleTo(after)).toBeLessThan(0.06);
    }
  });

  it('is not seen without a length, nor where the file has no numbers', () => {
    for (const m of [bone(0, 0, 0), bone(Number.NaN, 0, 0)]) {
      expect(matrixOf(m).determinant()).toBe(0);
      expect(m.every(Number.isFinite)).toBe(true);
    }
  });
});

describe('writeJoint and writeHead', () => {
  it('puts a ball at its point', () => {
    const m = new Float32Array(32);
    writeJoint(m, 1, Float32Array.from([0, 0, 0, 4, 5, 6]), 1, RADIUS);
    const top = new Vector3(0, 1, 0).applyMatrix4(matrixOf(m, 1));
    expect(top.distanceTo(new Vector3(4, 5 + RADIUS, 6))).toBeCloseTo(0, 6);
  });

  it('puts a head beyond the neck', () => {
    const m = new Float32Array(16);
    writeHead(m, 0, Float32Array.from([0, 1, 0, 0, 1.1, 0]), { base: 1, from: 0, to: 1, length: 0.2 }, RADIUS);
    const top = new Vector3(0, 1, 0).applyMatrix4(matrixOf(m));
    expect(top.distanceTo(new Vector3(0, 1.3, 0))).toBeCloseTo(0, 6);
  });
});
