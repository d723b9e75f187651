// SPDX-License-Identifier: MIT
import { beforeEach, describe, expect, it } from 'vitest';
import { clipOf } from '../state/clip_of.test_support';
import { type Actor, actors, alignments, step } from '../state/stage';
import { clockOf, followsAlignment, momentOf, onClock, plantsOnClock, slopeAt, times, valueAt } from './on_clock';

const none = Number.NaN;
const ramp = (count: number) => Float32Array.from({ length: count }, (_, i) => i);

function show(...clips: [id: string, numFrames: number, frameRate: number][]): Actor[] {
  actors.value = clips.map(([id, numFrames, rate], colour) => ({
    clip: clipOf(id, numFrames, rate),
    colour,
    title: id,
  }));
  return actors.value;
}

beforeEach(() => {
  step.value = 'time';
  alignments.value = new Map();
});

describe('a value between frames', () => {
  it('is in proportion', () => {
    expect(valueAt([1, 3], 0.25)).toBe(1.5);
    expect(valueAt([1, 3], 1)).toBe(3);
  });
  it('is the nearer one beside a gap, and none in it', () => {
    expect(valueAt([1, none, none], 0.4)).toBe(1);
    expect(valueAt([1, none, none], 0.6)).toBeNull();
    expect(valueAt([none, none], 0.5)).toBeNull();
    expect(valueAt([], 0)).toBeNull();
  });
});

describe('curves on the clock', () => {
  it('end with their clips, in step by time', () => {
    const [, other] = show(['a', 5, 1], ['b', 3, 1]);
    expect(onClock(ramp(3), other!)).toEqual([0, 1, 2, null, null]);
  });

  it('are drawn at every frame of the fastest clip', () => {
    const [first] = show(['a', 3, 1], ['b', 5, 2]);
    expect(times.value).toEqual([0, 0.5, 1, 1.5, 2]);
    expect(onClock(ramp(3), first!)).toEqual([0, 0.5, 1, 1.5, 2]);
  });

  it('lie above each other frame by frame, in step by frame', () => {
    step.value = 'frame';
    const [, other] = show(['a', 4, 1], ['b', 4, 2]);
    expect(onClock(ramp(4), other!)).toEqual([0, 1, 2, 3]);
  });

  it('lie where their moments belong, through an alignment', () => {
    const [, other] = show(['a', 4, 1], ['b', 8, 1]);
    step.value = 'alignment';
    alignments.value = new Map([['b', new Float32Array([0, 1, 5, 7])]]);
    expect(onClock(ramp(8), other!)).toEqual([0, 1, 5, 7]);
    expect(momentOf(other!, 1.5)).toBe(3);
    expect(times.value.map((at) => slopeAt(other!, at))).toEqual([1, 2.5, 3, 2]);
  });

  it('end with their clips where there is no alignment', () => {
    const [, other] = show(['a', 4, 1], ['b', 2, 1]);
    step.value = 'alignment';
    expect(onClock(ramp(2), other!)).toEqual([0, 1, null, null]);
    expect(followsAlignment(other!)).toBe(false);
  });

  it('keep to the frames that are played', () => {
    const [first] = show(['a', 9, 1]);
    actors.value = [{ ...first!, frames: [3, 6] }];
    expect(onClock(ramp(9), actors.value[0]!)).toEqual([3, 4, 5]);
  });
});

describe('the moment of the clock at which a clip is at a frame', () => {
  it('is its inverse', () => {
    const [, other] = show(['a', 4, 1], ['b', 8, 1]);
    step.value = 'alignment';
    alignments.value = new Map([['b', new Float32Array([0, 1, 5, 7])]]);
    expect(clockOf(other!, 3)).toBeCloseTo(1.5, 6);
    expect(clockOf(other!, 0)).toBe(0);
    expect(clockOf(other!, 99)).toBeCloseTo(3, 6);
  });

  it('tells when feet stand', () => {
    const [first] = show(['a', 11, 10]);
    first!.clip.header.plants.push({ foot: 0, begin: 2, end: 6 }, { foot: 1, begin: 6, end: 11 });
    const [[from, to]] = plantsOnClock(first!, 0) as [[number, number]];
    expect(from).toBeCloseTo(0.2, 6);
    expect(to).toBeCloseTo(0.5, 6);
    expect(plantsOnClock(first!, 1)).toHaveLength(1);
  });
});
