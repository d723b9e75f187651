// SPDX-License-Identifier: MIT
import { afterEach, describe, expect, it } from 'vitest';
import { Clip } from '../data/clip';
import type { Figure } from '../data/types';
import { clipOf } from '../state/clip_of.test_support';
import { frameAt } from '../state/playback';
import { type Actor, actors, alignments, step } from '../state/stage';
import { figureRows, momentOf, shown } from './figure_rows';

function actor(id: string, figures: Figure[], numFrames = 31, frameRate = 30): Actor {
  const { header } = clipOf(id, numFrames, frameRate);
  return { clip: new Clip({ header: { ...header, figures }, arrays: {} }), colour: 0, title: id };
}

function jerk(value: number | null, better: 'less' | 'more' = 'less'): Figure {
  return { name: 'Jerk', value, unit: 'm/s³', better };
}

const marksOf = (all: Actor[]) => figureRows(all)[0]!.cells.map((cell) => cell?.mark);

afterEach(() => {
  actors.value = [];
  alignments.value = new Map();
  step.value = 'time';
});

describe('figureRows', () => {
  it('puts the figures of one name in one row, a cell per clip', () => {
    const slide: Figure = { name: 'Slide', value: 1, unit: 'cm/s' };
    const rows = figureRows([actor('a', [jerk(1)]), actor('b', [slide, jerk(2)])]);
    expect(rows.map((row) => row.name)).toEqual(['Jerk', 'Slide']);
    expect(rows[1]!.cells.map((cell) => cell?.figure.value)).toEqual([undefined, 1]);
  });

  it('marks the best and the worst, by which way is better', () => {
    const [a, b, c] = [1, 2, 3].map((value) => actor(String(value), [jerk(value)]));
    expect(marksOf([a!, b!, c!])).toEqual(['best', null, 'worst']);
    expect(marksOf([1, 2].map((value) => actor(String(value), [jerk(value, 'more')])))).toEqual(['worst', 'best']);
  });

  it('marks nothing where there is nothing to compare, or no difference to be seen', () => {
    expect(marksOf([actor('a', [jerk(1)]), actor('b', [jerk(null)])])).toEqual([null, null]);
    expect(marksOf([actor('a', [jerk(1.0001)]), actor('b', [jerk(1)])])).toEqual([null, null]);
    expect(marksOf([1, 2].map((value) => actor(String(value), [{ name: 'Speed', value, unit: '' }])))).toEqual([
      null,
      null,
    ]);
  });
});

describe('shown', () => {
  it('gives three digits', () => {
    expect([0.126, 12.34, 123.4].map(shown)).toEqual(['0.13', '12.3', '123']);
  });
});

describe('momentOf', () => {
  it('finds when a frame is shown, by time and through an alignment', () => {
    const first = actor('a', [], 31, 30);
    const second = actor('b', [], 121, 60);
    actors.value = [first, second];
    expect(momentOf(second, 90)).toBeCloseTo(1.5, 6);
    step.value = 'alignment';
    alignments.value = new Map([['b', Float32Array.from({ length: 31 }, (_, i) => 4 * i)]]);
    const moment = momentOf(second, 90);
    expect(frameAt(second, moment)).toBeCloseTo(90, 4);
    expect(moment).toBeCloseTo(90 / 4 / 30, 6);
  });
});
