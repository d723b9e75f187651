// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { clipsListedBy, fileGroups, titleOf } from './file_groups';
import { fileOf } from './source_of.test_support';

const files = [
  fileOf('p0', { kind: 'pairs', name: 'pairs.toml' }),
  fileOf('a'),
  fileOf('b', { listedBy: 'p0' }),
  fileOf('m0', { kind: 'model', name: 'limp.strut' }),
];

describe('the list of files', () => {
  it('goes by kind, clips first, and leaves out the kinds that are not there', () => {
    expect(fileGroups(files).map((group) => group.title)).toEqual(['Clips', 'Models', 'Pair lists']);
  });
  it('has the clips of a pair list under it only', () => {
    expect(fileGroups(files)[0]!.files.map((file) => file.id)).toEqual(['a']);
    expect(clipsListedBy('p0', files).map((file) => file.id)).toEqual(['b']);
  });
  it('gives the page its title', () => {
    expect(titleOf(files)).toBe('pairs.toml, a.bvh, limp.strut – strut');
    expect(titleOf([...files, fileOf('c'), fileOf('d')])).toBe('pairs.toml, a.bvh, limp.strut and 2 more – strut');
    expect(titleOf([])).toBe('strut');
  });
});
