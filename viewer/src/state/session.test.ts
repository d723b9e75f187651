// SPDX-License-Identifier: MIT
import { beforeEach, describe, expect, it } from 'vitest';
import type { FileEntry, SessionInfo } from '../data/types';
import * as compare from './compare';
import { clips, failure, firstMode, loadClip, numLoading, open, problems, reconnect } from './session';
import { fileOf, ToldSource } from './source_of.test_support';

/** Clips are kept for as long as the page lives, so that every test has its own. */
let test = 0;

function infoOf(files: FileEntry[], more: Partial<SessionInfo> = {}): SessionInfo {
  return { version: '1', files, ...more };
}

function named(...ids: string[]): ToldSource {
  return new ToldSource(infoOf(ids.map((id) => fileOf(`${id}${test}`))));
}

beforeEach(() => {
  ++test;
  failure.value = null;
});

describe('opening a session', () => {
  it('loads the clips that were named, in their order, and not those of pair lists', async () => {
    const source = named('a', 'b', 'c', 'd');
    source.info.files.push(fileOf(`e${test}`, { listedBy: 'p0' }), fileOf('p0', { kind: 'pairs' }));
    await open(source);
    expect(clips.value.map((clip) => clip.id)).toEqual(['a', 'b', 'c', 'd'].map((id) => id + test));
    expect(source.asked).not.toContain(`e${test}`);
    expect(numLoading.value).toBe(0);
  });

  it('tells what is wrong beside the file and goes on', async () => {
    await open(named('bad', 'b'));
    expect(problems.value.get(`bad${test}`)?.message).toContain(':3:7:');
    expect(clips.value).toHaveLength(1);
    expect(numLoading.value).toBe(0);
  });

  it('says for the page as a whole if there is no session', async () => {
    await open({ ...named('a'), session: () => Promise.reject(new Error('refused')) } as unknown as ToldSource);
    expect(failure.value?.message).toBe('refused');
  });
});

describe('a program that is gone', () => {
  it('is asked again for what did not come, and for nothing else', async () => {
    const source = named('a', 'b');
    const session = source.session.bind(source);
    source.session = async () => {
      const info = await session();
      source.isGone = true;
      return info;
    };
    await open(source);
    expect(clips.value).toHaveLength(0);
    expect(problems.value.size).toBe(0);
    source.isGone = false;
    source.session = session;
    await reconnect();
    expect(clips.value).toHaveLength(2);
    await reconnect();
    expect(source.asked.filter((question) => question === `a${test}`)).toHaveLength(1);
    expect(failure.value).toBeNull();
  });

  it('may come back with other files, and the page says so', async () => {
    const source = named('a');
    await open(source);
    source.info = infoOf([fileOf(`a${test}`, { path: '/elsewhere.bvh' })]);
    await reconnect();
    expect(failure.value?.message).toContain('other files');
  });
});

describe('the first mode', () => {
  const model = fileOf('m0', { kind: 'model' });
  const database = fileOf('d0', { kind: 'database' });
  const pairs = fileOf('p0', { kind: 'pairs' });
  it('is what the files are for', () => {
    expect(firstMode(infoOf([fileOf('a'), fileOf('b'), model]))).toBe('compare');
    expect(firstMode(infoOf([fileOf('a'), model]))).toBe('translate');
    expect(firstMode(infoOf([pairs, fileOf('a', { listedBy: 'p0' })]))).toBe('pairs');
    expect(firstMode(infoOf([database]))).toBe('label');
    expect(firstMode(infoOf([database, fileOf('a')], { rater: 'ann' }))).toBe('label');
    expect(firstMode(infoOf([]))).toBe('compare');
  });
});

describe('what is compared', () => {
  it('is every clip that was named, the first as the reference', async () => {
    await open(named('a', 'b'));
    expect(compare.comparedActors.value.map((actor) => actor.title)).toEqual([`a${test}`, `b${test}`]);
    compare.setReference(`b${test}`);
    expect(compare.comparedActors.value.map((actor) => actor.title)).toEqual([`b${test}`, `a${test}`]);
    expect(compare.comparedActors.value.map((actor) => actor.colour)).toEqual([1, 0]);
  });

  it('is not what a person took off, until it is put on again, with the number it has then', async () => {
    await open(named('a', 'b'));
    compare.choose(`a${test}`, false);
    expect(compare.chosen.value).toEqual([`b${test}`]);
    compare.choose(`a${test}`, true);
    expect(compare.comparedActors.value.map((actor) => actor.colour)).toEqual([0, 1]);
  });

  it('is a clip of a pair list once it is asked for', async () => {
    const source = named('a');
    source.info.files.push(fileOf(`e${test}`, { listedBy: 'p0' }));
    await open(source);
    expect(compare.chosen.value).toHaveLength(1);
    compare.choose(`e${test}`, true);
    await loadClip(`e${test}`);
    expect(compare.comparedActors.value.map((actor) => actor.title)).toEqual([`a${test}`, `e${test}`]);
  });

  it('is no more than can be told apart at first', async () => {
    await open(named(...Array.from({ length: 20 }, (_, i) => `n${i}x`)));
    expect(compare.comparedActors.value).toHaveLength(compare.MOST_AT_FIRST);
    compare.choose(`n19x${test}`, true);
    expect(compare.isChosen(`n19x${test}`)).toBe(true);
  });
});
