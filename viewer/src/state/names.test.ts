// SPDX-License-Identifier: MIT
import { afterEach, describe, expect, it } from 'vitest';
import { fullNameOf, leftOut, nameOf, sharedBeginning } from './names';
import { session } from './session';

function openClips(...names: string[]): void {
  const files = names.map((name) => ({ id: name, name, path: name, kind: 'clip' as const }));
  session.value = { version: '', files };
}

describe('the beginning that names share', () => {
  it('is made of whole words', () => {
    expect(sharedBeginning(['set_walk_normal_001', 'set_walk_nasty_001'])).toBe('set_walk_');
    expect(sharedBeginning(['a-1', 'b-1'])).toBe('');
  });
  it('leaves every name a word, not a number alone', () => {
    expect(sharedBeginning(['set_walk_001', 'set_walk_002'])).toBe('set_');
    expect(sharedBeginning(['set_walk', 'set_walk_2'])).toBe('set_');
    expect(sharedBeginning(['take_1', 'take_2'])).toBe('');
  });
  it('may leave numbers where there are no words', () => {
    expect(sharedBeginning(['2026-01', '2026-02'])).toBe('2026-');
  });
  it('is empty for one name and for none', () => {
    expect(sharedBeginning(['walk_fast'])).toBe('');
    expect(sharedBeginning([])).toBe('');
  });
});

describe('short names', () => {
  afterEach(() => {
    session.value = null;
  });
  it('have neither the shared beginning nor the ending', () => {
    openClips('set_walk_normal_001.bvh', 'set_walk_tired_001.BVH');
    expect(nameOf('set_walk_tired_001.BVH')).toBe('tired_001');
    expect(fullNameOf('set_walk_tired_001.BVH')).toBe('set_walk_tired_001.BVH');
    expect(leftOut.value).toBe('set_walk_');
  });
  it('of what is not among the files are its id', () => {
    openClips('walk.bvh');
    expect(nameOf('other')).toBe('other');
  });
});
