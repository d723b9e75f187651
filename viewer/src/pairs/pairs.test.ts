// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { factsOf } from './facts';
import { begun, edited, redone, settled, undone } from './history';
import { moved, nextOnset, onsetsOf, snapped } from './marks';
import { EVERYTHING, neighbour, ordered } from './order';
import { isCut, newPair, type Pair, pairsOf, progressOf, replaced, savedComment, toldList, withFrames } from './pair';

const CYCLE = 'left cycle: 1.23 -> 0.89 m/s, turning +1 -> -2 degrees, 1.10 -> 0.90 s; distance 0.05';
const WHOLE = 'whole: 3.00 -> 2.50 s, joints move by 12 -> 9 cm; distance 0.31';

const told = {
  version: 'v',
  heading: 'h',
  ending: 'e',
  pairs: [
    { input: { clip: 'c0', frames: null }, output: { clip: 'c2', frames: null }, comment: WHOLE, verdict: 'none' },
    {
      input: { clip: 'c1', frames: [10, 43] },
      output: { clip: 'c2', frames: [12, 40] },
      comment: CYCLE,
      verdict: 'accepted',
    },
    { input: { clip: 'c0', frames: [1, 9] }, output: { clip: 'c3', frames: [2, 8] }, comment: '', verdict: 'rejected' },
  ] as const,
};
const pairs = pairsOf(told);
const nameOf = (id: string) => ({ c0: 'walk_10', c1: 'walk_9', c2: 'old_1', c3: 'old_2' })[id] ?? id;
const ids = (list: readonly Pair[]) => list.map((pair) => pair.id);

describe('facts of a comment', () => {
  it('are those of a gait cycle', () => {
    expect(factsOf(CYCLE)).toEqual({
      kind: 'left cycle',
      distance: 0.05,
      facts: [
        { name: 'speed', unit: 'm/s', input: 1.23, output: 0.89 },
        { name: 'turning', unit: 'degrees', input: 1, output: -2 },
        { name: 'duration', unit: 's', input: 1.1, output: 0.9 },
      ],
    });
  });
  it('are those of whole clips', () => {
    const { kind, distance, facts } = factsOf(WHOLE);
    expect([kind, distance]).toEqual(['whole', 0.31]);
    expect(facts.map((fact) => fact.name)).toEqual(['duration', 'joints move by']);
  });
  it('are none where a person wrote something else', () => {
    expect(factsOf('my favourite')).toEqual({ kind: 'other', distance: null, facts: [] });
  });
});

describe('cut marks', () => {
  it('snap to frames and stay in the clip, two frames apart', () => {
    expect(moved([10, 20], 'begin', 12.4, 100)).toEqual([12, 20]);
    expect(moved([10, 20], 'begin', 50, 100)).toEqual([18, 20]);
    expect(moved([10, 20], 'begin', -5, 100)).toEqual([0, 20]);
    expect(moved([10, 20], 'end', 300, 100)).toEqual([10, 100]);
    expect(moved([10, 20], 'end', 0, 100)).toEqual([10, 12]);
  });
  it('move together without changing the length', () => {
    expect(moved([10, 20], 'both', 15, 100)).toEqual([15, 25]);
    expect(moved([10, 20], 'both', 95, 100)).toEqual([90, 100]);
    expect(moved([10, 20], 'both', -3, 100)).toEqual([0, 10]);
  });
  it('go to where feet come down', () => {
    const onsets = onsetsOf([
      { foot: 1, begin: 30, end: 40 },
      { foot: 0, begin: 10, end: 25 },
      { foot: 1, begin: 10, end: 12 },
    ]);
    expect(onsets).toEqual([10, 30]);
    expect(snapped(12, onsets, 5)).toBe(10);
    expect(snapped(20, onsets, 5)).toBe(20);
    expect(nextOnset(10, onsets, 1)).toBe(30);
    expect(nextOnset(10, onsets, -1)).toBe(10);
  });
});

describe('undo', () => {
  it('takes back one change after the other and brings them again', () => {
    const one = withFrames(pairs[1]!, 'input', [11, 43]);
    const first = edited(begun(pairs), replaced(pairs, one), 1);
    const both = edited(first, [], 2);
    const back = undone(both)!;
    expect([back.about, back.history.now.pairs]).toEqual([2, first.now.pairs]);
    expect(undone(back.history)!.history.now.pairs).toBe(pairs);
    expect(redone(back.history)!.history.now.pairs).toEqual([]);
    expect(undone(begun(pairs))).toBeNull();
    expect(redone(both)).toBeNull();
  });
  it('takes a drag back at once, and the next one by itself', () => {
    let history = begun(pairs);
    for (const begin of [11, 12, 13]) {
      history = edited(history, replaced(pairs, withFrames(pairs[1]!, 'input', [begin, 43])), 1, 'drag');
    }
    expect(history.past).toHaveLength(1);
    history = edited(settled(history), pairs, 1, 'drag');
    expect(history.past).toHaveLength(2);
  });
  it('forgets what was taken back once something else is done', () => {
    const back = undone(edited(begun(pairs), [], 0))!.history;
    expect(edited(back, pairs, 1).future).toEqual([]);
  });
});

describe('the order', () => {
  it('is by distance, with pairs that have none last', () => {
    expect(ids(ordered(pairs, { ...EVERYTHING, sort: 'distance' }, nameOf))).toEqual([1, 0, 2]);
  });
  it('is by name as people count', () => {
    expect(ids(ordered(pairs, { ...EVERYTHING, sort: 'input' }, nameOf))).toEqual([1, 0, 2]);
  });
  it('leaves out what does not fit', () => {
    expect(ids(ordered(pairs, { ...EVERYTHING, onlyOpen: true }, nameOf))).toEqual([0]);
    expect(ids(ordered(pairs, { ...EVERYTHING, kind: 'left cycle' }, nameOf))).toEqual([1]);
    expect(ids(ordered(pairs, { ...EVERYTHING, clip: 'OLD_2' }, nameOf))).toEqual([2]);
  });
  it('has neighbours, and ends', () => {
    const shown = ordered(pairs, { ...EVERYTHING, sort: 'distance' }, nameOf);
    expect(neighbour(shown, 1, 1)).toBe(0);
    expect(neighbour(shown, 2, 1)).toBe(2);
    expect(neighbour(shown, 7, 1)).toBe(1);
    expect(neighbour([], 7, 1)).toBe(7);
  });
});

describe('what is saved', () => {
  it('is what was told if nothing was changed', () => {
    expect(toldList(told, pairs)).toEqual(told);
  });
  it('says once that a person moved the marks, and what was proposed', () => {
    const cut = withFrames(pairs[1]!, 'input', [11, 43]);
    expect(isCut(cut)).toBe(true);
    expect(savedComment(cut)).toBe(`${CYCLE}\ncut by hand; proposed: 10 to 43 with 12 to 40`);
    expect(savedComment({ ...cut, comment: savedComment(cut) })).toBe(savedComment(cut));
    expect(savedComment(withFrames(cut, 'input', [10, 43]))).toBe(CYCLE);
    expect(savedComment(withFrames(pairs[0]!, 'output', [1, 5]))).toContain('the whole clip with the whole clip');
  });
  it('holds pairs that were added', () => {
    const added = newPair(pairs, { clip: 'c0', frames: [0, 5] }, { clip: 'c2', frames: null });
    expect(added.id).toBe(3);
    expect(savedComment(withFrames(added, 'input', [1, 5]))).toBe('added by hand');
  });
  it('counts how far a person has come', () => {
    expect(progressOf(pairs)).toEqual({ total: 3, accepted: 1, rejected: 1 });
  });
});
