// SPDX-License-Identifier: MIT
import { beforeEach, describe, expect, it } from 'vitest';
import { clipOf } from './clip_of.test_support';
import * as playback from './playback';
import { advance, duration, frameAt, isPlaying, loop, seek, speed, time } from './playback';
import { type Actor, actors, alignments, step } from './stage';

function actorOf(id: string, numFrames: number, frameRate: number, frames?: [number, number]): Actor {
  return { clip: clipOf(id, numFrames, frameRate), colour: 0, title: id, frames };
}

/** The first at 30 frames/s for 3 s, the second at 60 frames/s for 1 s. */
const first = actorOf('a', 91, 30);
const second = actorOf('b', 61, 60);

beforeEach(() => {
  actors.value = [first, second];
  alignments.value = new Map();
  step.value = 'time';
  time.value = 0;
  speed.value = 1;
  isPlaying.value = false;
  loop.value = null;
  playback.repeats.value = true;
});

describe('in step by time', () => {
  it('clips of different rates show the same second', () => {
    expect(frameAt(first, 0.5)).toBeCloseTo(15);
    expect(frameAt(second, 0.5)).toBeCloseTo(30);
  });
  it('a shorter clip waits at its last frame, and the longest sets the duration', () => {
    expect(frameAt(second, 2)).toBe(60);
    expect(duration.value).toBe(3);
  });
  it('a part of a clip begins with its first frame', () => {
    const part = actorOf('c', 100, 30, [40, 50]);
    actors.value = [part];
    expect(frameAt(part, 0)).toBe(40);
    expect(frameAt(part, 1)).toBe(49);
    expect(duration.value).toBeCloseTo(0.3);
  });
});

describe('in step by frame', () => {
  beforeEach(() => {
    step.value = 'frame';
  });
  it('all show the same frame', () => {
    expect(frameAt(first, 0.5)).toBeCloseTo(15);
    expect(frameAt(second, 0.5)).toBeCloseTo(15);
  });
  it('it lasts until the clip with most frames has ended, on the clock of the first', () => {
    actors.value = [second, first];
    expect(duration.value).toBeCloseTo(1.5);
    expect(frameAt(first, duration.value)).toBeCloseTo(90);
  });
});

describe('in step by alignment', () => {
  const moments = Float32Array.from({ length: 91 }, (_, i) => (i < 30 ? i : 30 + (i - 30) / 2));
  beforeEach(() => {
    step.value = 'alignment';
    alignments.value = new Map([['b', moments]]);
  });
  it('a clip shows the moment that belongs to the frame of the first', () => {
    expect(frameAt(second, 0.5)).toBeCloseTo(15);
    expect(frameAt(second, 2)).toBeCloseTo(45);
    expect(frameAt(first, 2)).toBeCloseTo(60);
  });
  it('between two frames it is between their moments', () => {
    expect(frameAt(second, 1 + 1 / 60)).toBeCloseTo(30.25);
  });
  it('lasts as long as the first clip', () => {
    actors.value = [second, first];
    expect(duration.value).toBe(1);
  });
  it('a part of the first clip looks its own frames up', () => {
    const part = actorOf('a', 91, 30, [60, 90]);
    actors.value = [part, second];
    expect(frameAt(second, 0)).toBeCloseTo(45);
  });
  it('a clip without an alignment goes by time', () => {
    alignments.value = new Map();
    expect(frameAt(second, 0.5)).toBeCloseTo(30);
  });
});

describe('playing', () => {
  it('takes as long as it should at any speed', () => {
    isPlaying.value = true;
    speed.value = 0.25;
    advance(0.4);
    expect(time.value).toBeCloseTo(0.1);
  });
  it('begins again at the end, with what was left over', () => {
    playback.play();
    time.value = 2.9;
    advance(0.3);
    expect(time.value).toBeCloseTo(0.2);
    expect(isPlaying.value).toBe(true);
  });
  it('stops at the end if it does not repeat, and plays from the beginning then', () => {
    playback.repeats.value = false;
    playback.play();
    time.value = 2.9;
    advance(0.3);
    expect(time.value).toBe(3);
    expect(isPlaying.value).toBe(false);
    playback.togglePlaying();
    expect(time.value).toBe(0);
  });
  it('stays within the stretch, and goes to it from outside', () => {
    playback.setLoop(1, 2);
    playback.play();
    time.value = 1.9;
    advance(0.2);
    expect(time.value).toBeCloseTo(1.1);
    time.value = 0.2;
    advance(0.1);
    expect(time.value).toBe(1);
  });
  it('does not jump when the page was not drawn for long', () => {
    actors.value = [actorOf('long', 3001, 30)];
    playback.play();
    advance(60);
    expect(time.value).toBe(1);
  });
  it('does nothing without clips', () => {
    actors.value = [];
    playback.play();
    expect(isPlaying.value).toBe(false);
  });
});

describe('a stretch', () => {
  it('is set by its ends in either order, a frame long at least', () => {
    playback.setLoop(2, 1);
    expect(loop.value).toEqual([1, 2]);
    playback.setLoop(1, 1);
    expect(loop.value![1] - loop.value![0]).toBeCloseTo(1 / 30);
    playback.setLoop(3, 3);
    expect(loop.value![1]).toBe(3);
  });
  it('goes to the end of the clips if only its beginning was set, and the other way round', () => {
    playback.setLoopBegin(1);
    expect(loop.value).toEqual([1, 3]);
    playback.setLoopEnd(2);
    expect(loop.value).toEqual([1, 2]);
    playback.setLoopBegin(2.5);
    expect(loop.value).toEqual([2.5, 3]);
    playback.setLoopEnd(1.5);
    expect(loop.value).toEqual([0, 1.5]);
  });
  it('and the time stay within what is shown', () => {
    playback.setLoop(0.5, 2);
    seek(3);
    actors.value = [second];
    expect(loop.value).toEqual([0.5, 1]);
    expect(time.value).toBe(1);
    playback.setLoop(0.8, 1);
    actors.value = [actorOf('short', 10, 30)];
    expect(loop.value).toBeNull();
  });
});

describe('stepping', () => {
  it('goes from frame to frame and stops', () => {
    playback.play();
    playback.stepFrames(1);
    expect(time.value).toBeCloseTo(1 / 30);
    expect(isPlaying.value).toBe(false);
  });
  it('counts the next frame as one from between two', () => {
    time.value = 1.5 / 30;
    playback.stepFrames(1);
    expect(time.value).toBeCloseTo(2 / 30);
    time.value = 1.5 / 30;
    playback.stepFrames(-1);
    expect(time.value).toBeCloseTo(1 / 30);
  });
  it('visits every frame though times are not exact', () => {
    for (let i = 1; i <= 90; ++i) {
      playback.stepFrames(1);
      expect(time.value * 30).toBeCloseTo(i, 6);
    }
    playback.stepFrames(10);
    expect(time.value).toBe(3);
  });
});

describe('speed', () => {
  it('goes through what is offered and stays at the ends', () => {
    playback.changeSpeed(1);
    expect(speed.value).toBe(1.5);
    for (let i = 0; i < 20; ++i) playback.changeSpeed(-1);
    expect(speed.value).toBe(0.1);
    for (let i = 0; i < 20; ++i) playback.changeSpeed(1);
    expect(speed.value).toBe(4);
  });
});

describe('scrubbing', () => {
  it('pauses, and goes on if it played', () => {
    playback.play();
    playback.beginScrubbing();
    expect(isPlaying.value).toBe(false);
    playback.endScrubbing();
    expect(isPlaying.value).toBe(true);
  });
  it('does not begin to play', () => {
    playback.beginScrubbing();
    playback.endScrubbing();
    expect(isPlaying.value).toBe(false);
  });
  it('does not go anywhere that is no moment', () => {
    seek(Number.NaN);
    expect(time.value).toBe(0);
    seek(-4);
    expect(time.value).toBe(0);
  });
});
