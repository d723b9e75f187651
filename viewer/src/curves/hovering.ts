// SPDX-License-Identifier: MIT
// A pointer over a curve shows that moment on the stage, and gives back the moment before when it leaves; a click keeps
// it. While clips play, only a click does anything.
import { isPlaying, seek, time } from '../state/playback';

/** What to go back to, and the moment that was shown last. */
let before: number | null = null;
let shown = 0;

export function hover(at: number): void {
  if (isPlaying.value) return;
  before ??= time.value;
  seek(at);
  shown = time.value;
}

export function keep(at: number): void {
  seek(at);
  before = null;
}

/** Goes back, unless it plays or somebody else has set the time since. */
export function leave(): void {
  if (before !== null && !isPlaying.value && time.value === shown) seek(before);
  before = null;
}
