// SPDX-License-Identifier: MIT
// Play, step, speed, and the time as numbers that can be typed. What changes with every frame is written straight into
// the page, so that nothing else is made again.
import { useSignalEffect } from '@preact/signals';
import { useRef } from 'preact/hooks';
import * as playback from '../state/playback';
import { duration, frameRange, frameRate, isPlaying, loop, repeats, seek, speed, time } from '../state/playback';
import { actors } from '../state/stage';
import { readSeconds, written } from '../state/ticks';
import { Icon, type IconName } from '../ui/icon';

interface ActionProps {
  icon: IconName;
  label: string;
  keys: string;
  action: () => void;
  isDisabled?: boolean;
  isPressed?: boolean;
}

function Action({ icon, label, keys, action, isDisabled, isPressed }: ActionProps) {
  return (
    <button
      type="button"
      class="action"
      aria-label={label}
      title={`${label} (${keys})`}
      disabled={isDisabled}
      aria-pressed={isPressed}
      onClick={action}
    >
      <Icon name={icon} />
    </button>
  );
}

interface ReadoutProps {
  label: string;
  /** What stands there now; read again whenever a signal in it changes. */
  text: () => string;
  /** Takes what a person typed; nonsense is to be left alone. */
  take: (text: string) => void;
}

/** A number that follows the clock until a person types another. */
function Readout({ label, text, take }: ReadoutProps) {
  const input = useRef<HTMLInputElement>(null);
  useSignalEffect(() => {
    const now = text();
    if (input.current && document.activeElement !== input.current) input.current.value = now;
  });
  const commit = () => {
    if (input.current!.value !== text()) take(input.current!.value);
    input.current!.value = text();
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Escape') input.current!.value = text();
    if (event.key !== 'Enter' && event.key !== 'Escape') return;
    input.current!.blur();
  };
  return (
    <input
      ref={input}
      class="readout"
      type="text"
      inputMode="decimal"
      aria-label={label}
      title={`${label}: type another and press Enter`}
      onFocus={() => {
        isPlaying.value = false;
        input.current!.select();
      }}
      onBlur={commit}
      onKeyDown={onKeyDown}
    />
  );
}

/** The frame of the first clip that is nearest to the time, counted in its file. */
function nearestFrame(): number {
  const first = actors.value[0];
  return Math.round(time.value * frameRate.value) + (first ? frameRange(first)[0] : 0);
}

function seekFrame(text: string): void {
  const first = actors.value[0];
  if (first && /^\s*\d+\s*$/.test(text)) seek((Number(text) - frameRange(first)[0]) / frameRate.value);
}

function Readouts() {
  const first = actors.value[0];
  return (
    <div class="readouts">
      <Readout label="Time in seconds" text={() => written(time.value)} take={(text) => seek(readSeconds(text))} />
      <span class="of">/ {written(duration.value)} s</span>
      <span class="unit">frame</span>
      <Readout label="Frame" text={() => String(nearestFrame())} take={seekFrame} />
      <span class="of">
        / {first ? frameRange(first)[1] - 1 : 0} at {Number(frameRate.value.toFixed(2))} Hz
      </span>
    </div>
  );
}

function Steps() {
  const isEmpty = duration.value === 0;
  const name = isPlaying.value ? 'Pause' : 'Play';
  return (
    <div class="steps">
      <Action icon="first" label="To the beginning" keys="Home" action={() => seek(0)} isDisabled={isEmpty} />
      <Action icon="back" label="A frame back" keys="←" action={() => playback.stepFrames(-1)} isDisabled={isEmpty} />
      <button
        type="button"
        class="action play primary"
        aria-label={name}
        title={`${name} (Space)`}
        disabled={isEmpty}
        onClick={playback.togglePlaying}
      >
        <Icon name={isPlaying.value ? 'pause' : 'play'} />
      </button>
      <Action icon="on" label="A frame on" keys="→" action={() => playback.stepFrames(1)} isDisabled={isEmpty} />
      <Action icon="last" label="To the end" keys="End" action={() => seek(Number.MAX_VALUE)} isDisabled={isEmpty} />
    </div>
  );
}

function Stretch() {
  const isEmpty = duration.value === 0;
  return (
    <div class="stretch">
      <Action
        icon="repeat"
        label="Repeat"
        keys="R"
        isPressed={repeats.value || loop.value !== null}
        isDisabled={loop.value !== null}
        action={() => {
          repeats.value = !repeats.value;
        }}
      />
      <button
        type="button"
        title="Begin the loop here (I)"
        disabled={isEmpty}
        onClick={() => playback.setLoopBegin(time.peek())}
      >
        In
      </button>
      <button
        type="button"
        title="End the loop here (O)"
        disabled={isEmpty}
        onClick={() => playback.setLoopEnd(time.peek())}
      >
        Out
      </button>
      {loop.value && (
        <>
          <output class="of">
            {written(loop.value[0])} – {written(loop.value[1])} s
          </output>
          <Action
            icon="close"
            label="Play everything again"
            keys="X"
            action={() => {
              loop.value = null;
            }}
          />
        </>
      )}
    </div>
  );
}

function Speed() {
  return (
    <select
      aria-label="Speed"
      title="Speed (- slower, + faster, 1 real time)"
      value={speed.value}
      onChange={(event) => {
        speed.value = Number(event.currentTarget.value);
      }}
    >
      {playback.SPEEDS.map((offered) => (
        <option key={offered} value={offered}>
          {offered} ×
        </option>
      ))}
    </select>
  );
}

/** The row of buttons and numbers under the bar. */
export function Transport() {
  return (
    <div class="transport">
      <Readouts />
      <Steps />
      <Stretch />
      <Speed />
    </div>
  );
}
