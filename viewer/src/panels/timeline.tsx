// SPDX-License-Identifier: MIT
// The clock of the page: the bar to scrub on, the buttons under it, and the keys for both.
import * as playback from '../state/playback';
import { loop, repeats, seek, speed, time } from '../state/playback';
import type { Shortcut } from '../state/shortcuts';
import { useShortcuts } from '../ui/use_shortcuts';
import { TimelineTrack } from './timeline_track';
import { Transport } from './transport';
import './timeline.css';

const MANY_FRAMES = 10;

function entry(keys: string | string[], description: string, action: () => void): Shortcut {
  return { keys, description, group: 'Playback', action };
}

const KEYS: readonly Shortcut[] = [
  entry(['Space', 'k'], 'Play or pause', playback.togglePlaying),
  entry('ArrowLeft', 'A frame back', () => playback.stepFrames(-1)),
  entry('ArrowRight', 'A frame on', () => playback.stepFrames(1)),
  entry('Shift+ArrowLeft', 'Ten frames back', () => playback.stepFrames(-MANY_FRAMES)),
  entry('Shift+ArrowRight', 'Ten frames on', () => playback.stepFrames(MANY_FRAMES)),
  entry('Home', 'To the beginning (of the loop)', () => seek(loop.value?.[0] ?? 0)),
  entry('End', 'To the end (of the loop)', () => seek(loop.value?.[1] ?? Number.MAX_VALUE)),
  entry('i', 'Begin the loop here', () => playback.setLoopBegin(time.value)),
  entry('o', 'End the loop here', () => playback.setLoopEnd(time.value)),
  entry('x', 'Play everything again, not the loop', () => {
    loop.value = null;
  }),
  entry('r', 'Begin again at the end, or stop there', () => {
    repeats.value = !repeats.value;
  }),
  entry('-', 'Slower', () => playback.changeSpeed(-1)),
  entry(['+', '='], 'Faster', () => playback.changeSpeed(1)),
  entry('1', 'Real time', () => {
    speed.value = 1;
  }),
];

export function Timeline() {
  useShortcuts(KEYS);
  return (
    <section class="timeline" aria-label="Timeline">
      <TimelineTrack />
      <Transport />
    </section>
  );
}
