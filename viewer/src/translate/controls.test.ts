// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { bodyOf, withModel, withOtherModel, withoutModel, withShare, withValue } from './controls';

const sum = (models: readonly { share: number }[]) => models.reduce((all, { share }) => all + share, 0);
const STRENGTH = { name: 'strength', group: 'style', least: 0, greatest: 1.5, usual: 1 };

describe('shares', () => {
  it('leave the rest to the first model', () => {
    const models = withShare(withModel(withModel([], 'a'), 'b'), 'b', 0.3);
    expect(models).toEqual([
      { id: 'a', share: 0.7 },
      { id: 'b', share: 0.3 },
    ]);
  });

  it('begin equal', () => {
    expect(withModel(withModel([], 'a'), 'b').map(({ share }) => share)).toEqual([0.5, 0.5]);
  });

  it('give way to each other and are never more than 1', () => {
    let models = [...'abcd'].reduce(withModel, [] as ReturnType<typeof withModel>);
    for (const [id, share] of [
      ['b', 0.9],
      ['c', 0.77],
      ['d', 1],
      ['b', 0.333],
      ['c', 7],
    ] as const) {
      models = withShare(models, id, share);
      const others = sum(models.slice(1));
      expect(others).toBeLessThanOrEqual(1 + 1e-9);
      expect(sum(models)).toBeCloseTo(1, 2);
    }
  });

  it('go back to the others when a model is taken away', () => {
    const models = withShare(withModel(withModel([], 'a'), 'b'), 'b', 0.3);
    expect(withoutModel(models, 'a')).toEqual([{ id: 'b', share: 1 }]);
    expect(withoutModel(models, 'b')).toEqual([{ id: 'a', share: 1 }]);
  });

  it('stay when another model takes a place', () => {
    expect(withOtherModel([{ id: 'a', share: 1 }], 0, 'b')).toEqual([{ id: 'b', share: 1 }]);
  });
});

describe('settings', () => {
  it('hold only what is not as usual', () => {
    const usual = { clip: 'c0', models: [{ id: 'm0', share: 1 }], values: {} };
    const half = withValue(usual, STRENGTH, 0.5);
    expect(half.values).toEqual({ strength: 0.5 });
    expect(withValue(half, STRENGTH, 1)).toEqual(usual);
  });

  it('are asked for without a share of the first model', () => {
    const models = [
      { id: 'm0', share: 0.6 },
      { id: 'm1', share: 0.4 },
    ];
    expect(bodyOf({ clip: 'c0', models, values: { pose: 0 } })).toEqual({
      clip: 'c0',
      models: [{ id: 'm0' }, { id: 'm1', share: 0.4 }],
      pose: 0,
    });
  });
});
