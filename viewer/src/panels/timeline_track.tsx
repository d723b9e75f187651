// SPDX-License-Identifier: MIT
// The bar of the timeline: where the clock stands, the stretch that is played over and over, and when the feet of the
// first clip stand. Drag to scrub; drag with Shift held down to choose a stretch.
import { useComputed } from '@preact/signals';
import type { RefObject } from 'preact';
import { useRef } from 'preact/hooks';
import * as playback from '../state/playback';
import { duration, frameRange, frameRate, isPlaying, loop, seek, time } from '../state/playback';
import { actors } from '../state/stage';
import { tickName, ticksOf, written } from '../state/ticks';
import { useLive } from '../ui/use_live';
import { useSize } from '../ui/use_size';

/** Where an element will be. */
type Place = RefObject<HTMLDivElement | null>;

/** What a name of a tick takes [px]. */
const NAME_WIDTH = 70;

const FEET = ['left', 'right'] as const;

/** Where a moment lies on the bar [%]. */
function percent(at: number): string {
  return `${duration.value > 0 ? (100 * at) / duration.value : 0}%`;
}

/** The moment under the pointer [s]. */
function momentUnder(bar: HTMLElement, event: PointerEvent): number {
  const { left, width } = bar.getBoundingClientRect();
  return ((event.clientX - left) / Math.max(width, 1)) * duration.value;
}

function Ticks({ width }: { width: number }) {
  const { named, fine } = ticksOf(duration.value, frameRate.value, width);
  const fps = frameRate.value;
  const hasRoom = (at: number) => ((duration.value - at) / duration.value) * width > NAME_WIDTH;
  return (
    <div class="ticks" aria-hidden="true">
      {fine.map((at) => (
        <i key={at} style={{ left: percent(at) }} />
      ))}
      {named.map((at) => (
        <span key={at} style={{ left: percent(at) }}>
          {hasRoom(at) && tickName(at)}
          {hasRoom(at) && <small>{Math.round(at * fps)}</small>}
        </span>
      ))}
    </div>
  );
}

/** When the feet of the first clip stand: the left one above, the right one below. */
function Plants() {
  const first = actors.value[0];
  if (!first || first.clip.header.plants.length === 0 || duration.value === 0) return null;
  const [begin, end] = frameRange(first);
  const total = duration.value * frameRate.value;
  const bars = (foot: number) =>
    first.clip.header.plants
      .filter((plant) => plant.foot === foot && plant.end > begin && plant.begin < end)
      .map((plant) => [Math.max(plant.begin - begin, 0), Math.min(plant.end, end) - begin - 1] as const)
      .map(([from, to]) => `M${from} 0H${Math.max(to, from + 0.3)}V1H${from}z`)
      .join('');
  return (
    <div class="plants" aria-hidden="true" title="When the feet of the first clip stand">
      {FEET.map((side, foot) => (
        <div key={side} class={side}>
          <b>{side === 'left' ? 'L' : 'R'}</b>
          <svg aria-hidden="true" viewBox={`0 0 ${total} 1`} preserveAspectRatio="none">
            <path d={bars(foot)} />
          </svg>
        </div>
      ))}
    </div>
  );
}

/** One end of the stretch: dragged, or moved by arrow keys. */
function LoopEnd({ end, bar }: { end: 0 | 1; bar: Place }) {
  const at = loop.value![end];
  const move = (to: number) => {
    const other = loop.value![1 - end]!;
    const frame = 1 / frameRate.value;
    // An end stays on its own side of the other.
    playback.setLoop(end === 0 ? Math.min(to, other - frame) : Math.max(to, other + frame), other);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const direction = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (direction === undefined) return;
    event.preventDefault();
    move(loop.value![end] + (direction * (event.shiftKey ? 10 : 1)) / frameRate.value);
  };
  return (
    <div
      class={`loop-end ${end === 0 ? 'begin' : 'end'}`}
      style={{ left: percent(at) }}
      role="slider"
      tabIndex={0}
      aria-label={end === 0 ? 'Loop begins' : 'Loop ends'}
      aria-valuemin={0}
      aria-valuemax={duration.value}
      aria-valuenow={at}
      aria-valuetext={`${written(at)} s`}
      onKeyDown={onKeyDown}
      onPointerDown={(event) => {
        event.stopPropagation();
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) move(momentUnder(bar.current!, event));
      }}
    />
  );
}

function Loop({ bar }: { bar: Place }) {
  if (!loop.value) return null;
  const [begin, end] = loop.value;
  return (
    <>
      <div class="loop" style={{ left: percent(begin), width: percent(end - begin) }} />
      <LoopEnd end={0} bar={bar} />
      <LoopEnd end={1} bar={bar} />
    </>
  );
}

/** Scrubs with the pointer, from anywhere on the bar; with Shift held down chooses a stretch. */
function useDragging(bar: Place) {
  const stretchFrom = useRef<number | null>(null);
  const onPointerDown = (event: PointerEvent) => {
    if (event.button !== 0 || duration.value === 0) return;
    bar.current!.setPointerCapture(event.pointerId);
    playback.beginScrubbing();
    stretchFrom.current = event.shiftKey ? momentUnder(bar.current!, event) : null;
    seek(momentUnder(bar.current!, event));
  };
  const onPointerMove = (event: PointerEvent) => {
    if (!bar.current!.hasPointerCapture(event.pointerId)) return;
    const at = momentUnder(bar.current!, event);
    seek(at);
    if (stretchFrom.current !== null) playback.setLoop(stretchFrom.current, at);
  };
  return { onPointerDown, onPointerMove, onLostPointerCapture: playback.endScrubbing };
}

/** Moves the mark and tells assistive technology, without making anything again. While it plays only the mark moves. */
function useClock(bar: Place, mark: Place): void {
  useLive(() => {
    const share = duration.value > 0 ? time.value / duration.value : 0;
    mark.current!.style.transform = `translateX(${100 * share}%)`;
    if (isPlaying.value) return;
    bar.current!.setAttribute('aria-valuenow', time.value.toFixed(3));
    const frame = Math.round(time.value * frameRate.value);
    bar.current!.setAttribute('aria-valuetext', `${written(time.value)} seconds, frame ${frame}`);
  });
}

export function TimelineTrack() {
  const bar = useRef<HTMLDivElement>(null);
  const mark = useRef<HTMLDivElement>(null);
  const width = useSize(bar, 'width');
  const isEmpty = useComputed(() => duration.value === 0);
  useClock(bar, mark);
  // The loop's ends lie beside the slider, not within it: a slider has no parts of its own that can be reached.
  return (
    <div class="track">
      <div
        class="bar"
        ref={bar}
        role="slider"
        tabIndex={0}
        aria-label="Time"
        aria-valuemin={0}
        aria-valuemax={duration.value}
        aria-valuenow={time.peek()}
        aria-disabled={isEmpty.value}
        {...useDragging(bar)}
      >
        <Ticks width={width.value} />
        <Plants />
        <div class="now" ref={mark} />
      </div>
      <Loop bar={bar} />
    </div>
  );
}
