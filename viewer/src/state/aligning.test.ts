// SPDX-License-Identifier: MIT
import { beforeEach, describe, expect, it } from 'vitest';
import { alignings, alignWithFirst, stopAligning, withoutHoles } from './aligning';
import { clipOf } from './clip_of.test_support';
import { source } from './session';
import { ToldSource } from './source_of.test_support';
import { alignments } from './stage';

let told: ToldSource;
let test = 0;

/** Actors of clips that no other test has aligned. */
function actorsOf(...ids: string[]) {
  return ids.map((id, colour) => ({ clip: clipOf(`${id}${test}`, 31, 30), colour, title: id }));
}

beforeEach(() => {
  ++test;
  told = new ToldSource({ version: '1', files: [] });
  source.value = told;
  stopAligning();
});

describe('aligning with the reference', () => {
  it('asks for every other clip once', async () => {
    await alignWithFirst(actorsOf('a', 'b', 'c'));
    await alignWithFirst(actorsOf('a', 'c'));
    expect(told.asked).toEqual([`a${test} b${test}`, `a${test} c${test}`]);
    expect([...alignments.value.keys()]).toEqual([`c${test}`]);
  });

  it('waits, clip by clip', async () => {
    const done = alignWithFirst(actorsOf('a', 'b'));
    expect(alignings.value.get(`b${test}`)?.state).toBe('waiting');
    expect(alignments.value.size).toBe(0);
    await done;
    expect(alignings.value.get(`b${test}`)?.state).toBe('done');
  });

  it('says what was refused and aligns the others', async () => {
    await alignWithFirst(actorsOf('a', 'bad', 'c'));
    expect(alignings.value.get(`bad${test}`)).toMatchObject({ state: 'refused' });
    expect([...alignments.value.keys()]).toEqual([`c${test}`]);
  });

  it('does not show what comes after another reference was chosen', async () => {
    const early = alignWithFirst(actorsOf('a', 'b'));
    const late = alignWithFirst(actorsOf('b', 'a'));
    await Promise.all([early, late]);
    expect([...alignments.value.keys()]).toEqual([`a${test}`]);
  });

  it('asks again after the program was gone', async () => {
    told.isGone = true;
    await alignWithFirst(actorsOf('a', 'b'));
    expect(alignments.value.size).toBe(0);
    told.isGone = false;
    await alignWithFirst(actorsOf('a', 'b'));
    expect(alignments.value.size).toBe(1);
  });

  it('nothing is aligned with nothing', async () => {
    await alignWithFirst([]);
    expect(alignings.value.size).toBe(0);
  });
});

describe('holes in an alignment', () => {
  const none = Number.NaN;
  it('lie between their neighbours, or stay at the nearest', () => {
    expect([...withoutHoles(new Float32Array([none, 1, none, none, 7, none]))]).toEqual([1, 1, 3, 5, 7, 7]);
  });
  it('leave nothing if there are only holes', () => {
    expect(withoutHoles(new Float32Array([none, none]))).toHaveLength(0);
  });
  it('of which there are none cost nothing', () => {
    const whole = new Float32Array([1, 2]);
    expect(withoutHoles(whole)).toBe(whole);
  });
});
