// SPDX-License-Identifier: MIT
import { beforeEach, describe, expect, it } from 'vitest';
import { clipOf } from '../state/clip_of.test_support';
import { isPlaying, seek, time } from '../state/playback';
import { actors } from '../state/stage';
import { hover, keep, leave } from './hovering';

beforeEach(() => {
  leave();
  actors.value = [{ clip: clipOf('a', 101, 10), colour: 0, title: 'a' }];
  isPlaying.value = false;
  seek(1);
});

describe('hovering', () => {
  it('shows the moment and goes back', () => {
    hover(3);
    hover(4);
    expect(time.value).toBe(4);
    leave();
    expect(time.value).toBe(1);
  });

  it('keeps the moment that was clicked', () => {
    hover(3);
    keep(3);
    hover(5);
    leave();
    expect(time.value).toBe(3);
  });

  it('leaves clips that play alone', () => {
    isPlaying.value = true;
    hover(3);
    expect(time.value).toBe(1);
  });

  it('does not undo what was done meanwhile', () => {
    hover(3);
    seek(6);
    leave();
    expect(time.value).toBe(6);
    hover(3);
    isPlaying.value = true;
    leave();
    expect(time.value).toBe(3);
  });
});
