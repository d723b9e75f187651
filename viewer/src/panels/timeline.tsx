// SPDX-License-Identifier: MIT
import './timeline.css';
import { duration, isPlaying, seek, time } from '../state/playback';

/** Play, pause and scrub. */
export function Timeline() {
  return (
    <section class="timeline">
      <button
        type="button"
        onClick={() => {
          isPlaying.value = !isPlaying.value;
        }}
      >
        {isPlaying.value ? 'Pause' : 'Play'}
      </button>
      <input
        type="range"
        min={0}
        max={duration.value}
        step="any"
        value={time.value}
        aria-label="time"
        onInput={(event) => seek(Number(event.currentTarget.value))}
      />
    </section>
  );
}
