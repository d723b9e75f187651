// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import type { CurveInfo } from '../data/types';
import { counterpart, groupsOf, ownerOf, search } from './catalogue';

const curve = (name: string, joint: string, label: string): CurveInfo => ({ name, joint, label, unit: 'm' });

const CURVES = [
  curve('body/speed', '', 'speed over the ground'),
  curve('0/rotation/x', 'Hips', 'rotation x'),
  curve('0/speed', 'Hips', 'speed'),
  curve('1/rotation/x', '', 'rotation x'),
  curve('2/rotation/x', 'LeftKnee', 'rotation x'),
];

describe('groups of curves', () => {
  it('are the body and its joints; a joint without a name has its number', () => {
    expect(groupsOf(CURVES).map((group) => group.title)).toEqual(['Whole body', 'Hips', 'joint 1', 'LeftKnee']);
  });

  it('keep joints of one name apart', () => {
    const twins = [curve('3/speed', 'Twist', 'speed'), curve('4/speed', 'Twist', 'speed')];
    expect(groupsOf(twins)).toHaveLength(2);
  });
});

describe('search', () => {
  const found = (text: string) => search(groupsOf(CURVES), text).flatMap((group) => group.curves.map((c) => c.name));

  it('wants all words, in any order and case', () => {
    expect(found('X left')).toEqual(['2/rotation/x']);
    expect(found('speed')).toEqual(['body/speed', '0/speed']);
    expect(found('speed nothing')).toEqual([]);
  });

  it('finds everything without a word', () => {
    expect(found('  ')).toHaveLength(CURVES.length);
  });
});

describe('the counterpart of a curve', () => {
  it('is of the same joint, though the other skeleton counts differently', () => {
    const others = [curve('2/rotation/x', 'RightKnee', 'rotation x'), curve('7/rotation/x', 'LeftKnee', 'rotation x')];
    expect(counterpart(CURVES[4]!, others)?.name).toBe('7/rotation/x');
  });

  it('is none where the other has no such joint', () => {
    expect(counterpart(CURVES[4]!, [curve('2/rotation/x', 'Tail', 'rotation x')])).toBeUndefined();
  });

  it('prefers the same number among joints of one name', () => {
    const twins = [curve('3/speed', 'Twist', 'speed'), curve('4/speed', 'Twist', 'speed')];
    expect(counterpart(twins[1]!, twins)).toBe(twins[1]);
    expect(ownerOf(twins[1]!)).toBe('Twist');
  });
});
