// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { filesInShort, wordsOf } from './words';

describe('words', () => {
  it('say what a style was learnt from', () => {
    const provenance = {
      inputs: [{ file: '/motions/walk_1.bvh' }, { file: 'walk_2.bvh' }],
      outputs: [{ file: 'limp.bvh' }],
    };
    expect(filesInShort(provenance, 'inputs')).toBe('walk_1.bvh and 1 more');
    expect(filesInShort(provenance, 'outputs')).toBe('limp.bvh');
  });

  it('say nothing of provenance that is something else', () => {
    for (const provenance of [null, 'by hand', 7, {}, { inputs: 'x' }, { inputs: [] }]) {
      expect(filesInShort(provenance, 'inputs')).toBeNull();
    }
    expect(filesInShort({ inputs: [null] }, 'inputs')).toBe('?');
  });

  it('name controls they do not know', () => {
    expect(wordsOf('charm').title).toBe('charm');
  });
});
