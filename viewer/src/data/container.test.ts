// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { readContainer } from './container';

function write(header: object, bytes: Uint8Array): ArrayBuffer {
  let text = JSON.stringify(header);
  while (text.length % 4 !== 0) text += ' ';
  const all = new Uint8Array(4 + text.length + bytes.length);
  new DataView(all.buffer).setUint32(0, text.length, true);
  all.set(new TextEncoder().encode(text), 4);
  all.set(bytes, 4 + text.length);
  return all.buffer;
}

describe('readContainer', () => {
  it('reads numbers as they are', () => {
    const values = new Float32Array([1.5, -2, Number.NaN]);
    const buffer = write(
      { arrays: [{ name: 'a', type: 'f32', start: 0, count: 3 }], more: 7 },
      new Uint8Array(values.buffer),
    );
    const { header, arrays } = readContainer<{ more: number }>(buffer);
    expect(header.more).toBe(7);
    expect([...arrays.a!]).toEqual([1.5, -2, Number.NaN]);
  });

  it('scales stored numbers and keeps gaps', () => {
    const stored = new Uint16Array([0, 10, 0xffff]);
    const entry = { name: 'a', type: 'u16', start: 0, count: 3, scale: 0.5, offset: -1 };
    const { arrays } = readContainer(write({ arrays: [entry] }, new Uint8Array(stored.buffer)));
    expect([...arrays.a!]).toEqual([-1, 4, Number.NaN]);
  });
});
