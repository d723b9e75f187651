// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { EMPTY, factorsShown, labelOf, missing, nudge, setValue, toggleNotPresent } from './draft';

describe('a label being made', () => {
  it('moves in exact hundredths and stays within -1 and 1', () => {
    let draft = EMPTY;
    for (let i = 0; i < 3; ++i) draft = nudge(draft, 'flow', 0.1);
    expect(draft.flow).toBe(0.3);
    for (let i = 0; i < 20; ++i) draft = nudge(draft, 'flow', -0.1);
    expect(draft.flow).toBe(-1);
    expect(setValue(draft, 'flow', 7).flow).toBe(1);
    expect(Object.is(nudge(nudge(EMPTY, 'time', -0.1), 'time', 0.1).time, 0)).toBe(true);
  });

  it('starts from neutral where nothing was said, or that it is not present', () => {
    expect(nudge(EMPTY, 'time', -0.1).time).toBe(-0.1);
    expect(nudge(toggleNotPresent(EMPTY, 'time'), 'time', 0.01).time).toBe(0.01);
  });

  it('takes back that a factor is not present', () => {
    const absent = toggleNotPresent(setValue(EMPTY, 'weight', 0.5), 'weight');
    expect(absent.weight).toBe('not present');
    expect(toggleNotPresent(absent, 'weight').weight).toBeNull();
  });

  it('needs a word on Flow, Weight and Time, not on Space', () => {
    expect(missing(EMPTY)).toEqual(['flow', 'weight', 'time']);
    const draft = toggleNotPresent(setValue(setValue(EMPTY, 'flow', 0), 'weight', 1), 'time');
    expect(missing(draft)).toEqual([]);
    expect(factorsShown(false)).not.toContain('space');
    expect(factorsShown(true)).toContain('space');
  });

  it('is told in numbers, with what was left out as null and the comment in one line', () => {
    const draft = toggleNotPresent(setValue(setValue(EMPTY, 'flow', -0.25), 'weight', 0), 'time');
    expect(labelOf(draft, ' odd\n hands ', 'ada', '3-x')).toEqual({
      rater: 'ada',
      item: '3-x',
      rating: { flow: -0.25, weight: 0, time: null, space: null },
      notPresent: ['time'],
      comment: 'odd hands',
    });
  });
});
