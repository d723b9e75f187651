// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { type Report, ReportSource } from './report_source';
import { SourceError } from './source';

interface Stored {
  name: string;
  values: number[];
  /** In 16 bits with this step, from 0. */
  scale?: number;
}

/** A container in base64, as the program writes it. */
function packed(header: object, stored: Stored[]): string {
  const arrays: object[] = [];
  const parts: Uint8Array[] = [];
  let start = 0;
  for (const { name, values, scale } of stored) {
    const numbers = scale === undefined ? new Float32Array(values) : new Uint16Array(values.map((x) => x / scale));
    const bytes = new Uint8Array(Math.ceil(numbers.byteLength / 4) * 4);
    bytes.set(new Uint8Array(numbers.buffer));
    arrays.push({ name, type: scale === undefined ? 'f32' : 'u16', start, count: values.length, scale, offset: 0 });
    parts.push(bytes);
    start += bytes.length;
  }
  let text = JSON.stringify({ ...header, arrays });
  while (text.length % 4 !== 0) text += ' ';
  const length = new Uint8Array(new Uint32Array([text.length]).buffer);
  const all = [length, new TextEncoder().encode(text), ...parts].flatMap((part) => [...part]);
  return btoa(String.fromCharCode(...all));
}

const points = [
  { name: 'a', parent: -1, side: 'centre', isTip: false },
  { name: 'b', parent: 0, side: 'centre', isTip: false },
];
const header = { id: 'c1', name: 'walk', frameRate: 30, numFrames: 2, points };
const files = ['c0', 'c1'].map((id) => ({ id, kind: 'clip' as const, name: id, path: id }));

function source(more: Partial<Report>): ReportSource {
  const session = { version: '1', files, report: { title: 't', notes: [], leftOut: [] } };
  return new ReportSource({ session, clips: {}, curves: {}, alignments: {}, ...more });
}

describe('ReportSource', () => {
  it('puts positions around the pelvis back to where they were', async () => {
    const around = { name: 'aroundPelvis', values: [0, 0, 0, 1, 2, 3, 0, 0, 0, 4, 5, 6], scale: 0.5 };
    const path = { name: 'pelvisPath', values: [100, 0, 0, 200, 0, -7] };
    const clip = await source({ clips: { c1: packed(header, [path, around]) } }).clip('c1');
    expect([...clip.positions]).toEqual([100, 0, 0, 101, 2, 3, 200, 0, -7, 204, 5, -1]);
  });

  it('takes positions as they are where they were not split', async () => {
    const values = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
    const clip = await source({ clips: { c1: packed(header, [{ name: 'positions', values }]) } }).clip('c1');
    expect([...clip.positions]).toEqual(values);
  });

  it('gives a curve by its name and says which it does not hold', async () => {
    const curves = { c1: packed({}, [{ name: 'a/speed', values: [0, 1.5], scale: 0.5 }]) };
    const report = source({ curves });
    expect([...(await report.curve('c1', 'a/speed'))]).toEqual([0, 1.5]);
    await expect(report.curve('c1', 'b/speed')).rejects.toThrow('b/speed');
    await expect(report.curve('c0', 'a/speed')).rejects.toThrow(SourceError);
  });

  it('gives alignments with the first clip and no other', async () => {
    const alignments = { c1: packed({ reference: 'c0', clip: 'c1' }, [{ name: 'moments', values: [0, 2] }]) };
    const report = source({ alignments });
    expect([...(await report.alignment('c0', 'c1')).moments]).toEqual([0, 2]);
    await expect(report.alignment('c1', 'c0')).rejects.toThrow('first clip');
  });
});
