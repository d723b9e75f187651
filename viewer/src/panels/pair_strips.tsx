// SPDX-License-Identifier: MIT
// Both clips of the selected pair from their first frame to their last, with the stretches that belong together between
// cut marks. Marks are dragged or moved by arrow keys; with Shift held down they go to where a foot comes down.
import { useSignal, useSignalEffect } from '@preact/signals';
import { useRef } from 'preact/hooks';
import type { Clip } from '../data/clip';
import type { PairStep } from '../pairs/in_step';
import { type Mark, nextOnset, onsetsOf } from '../pairs/marks';
import { type Range, SIDES, type SideName } from '../pairs/pair';
import { current, frameOfMark, held, moveMark, pairStep, rangeOf, showMark, shownClips } from '../pairs/showing';
import { fullNameOf, nameOf } from '../state/names';
import { frameAt, time } from '../state/playback';
import { actors } from '../state/stage';
import { ticksOf, written } from '../state/ticks';
import { Swatch } from '../ui/swatch';
import { useSize } from '../ui/use_size';

const FEET = ['left', 'right'] as const;
const FAR = 10;

/** How a clip's frames lie on its strip. */
interface Scale {
  from: number;
  to: number;
  width: number;
}

const percent = (scale: Scale, frame: number) => `${(100 * (frame - scale.from)) / (scale.to - scale.from)}%`;

function Ticks({ scale, rate }: { scale: Scale; rate: number }) {
  const { named } = ticksOf((scale.to - scale.from) / rate, rate, scale.width);
  return (
    <div class="ticks" aria-hidden="true">
      {named.map((at) => (
        <span key={at} style={{ left: percent(scale, scale.from + at * rate) }}>
          {written(scale.from / rate + at).replace(/\.?0+$/, '')} s
        </span>
      ))}
    </div>
  );
}

function Bar(props: { scale: Scale; range: Range; kind: string; title?: string }) {
  const { scale, range, kind, title } = props;
  const width = `${(100 * (range[1] - range[0])) / (scale.to - scale.from)}%`;
  return <div class={kind} title={title} style={{ left: percent(scale, range[0]), width }} />;
}

/** Where other pairs have their stretches in the same clip; each stretch once. */
function Others({ scale, clip }: { scale: Scale; clip: string }) {
  const list = current.value!;
  const stretches = new Map<string, Range>();
  for (const pair of list.pairs.value) {
    for (const side of SIDES) {
      const range = pair[side].clip === clip && pair.id !== list.selected.value ? pair[side].frames : null;
      if (range) stretches.set(range.join(), range);
    }
  }
  return (
    <>
      {[...stretches].map(([key, range]) => (
        <Bar key={key} kind="other" scale={scale} range={range} />
      ))}
    </>
  );
}

function frameUnder(strip: HTMLElement, scale: Scale, event: PointerEvent): number {
  const { left, width } = strip.getBoundingClientRect();
  return scale.from + ((event.clientX - left) / Math.max(width, 1)) * (scale.to - scale.from);
}

const LABELS: Record<Mark, string> = { begin: 'begins', end: 'ends', both: 'as a whole' };

/** What a key does to a mark at `frame`; nothing if it is none of its keys. */
function frameAfterKey(event: KeyboardEvent, frame: number, onsets: readonly number[]): number | null {
  const count = event.shiftKey ? FAR : 1;
  switch (event.key) {
    case 'ArrowLeft':
      return frame - count;
    case 'ArrowRight':
      return frame + count;
    case 'PageUp':
      return nextOnset(frame, onsets, -1);
    case 'PageDown':
      return nextOnset(frame, onsets, 1);
    default:
      return null;
  }
}

/** A mark that is dragged: either end, or the stretch between. */
function Handle(props: { side: SideName; mark: Mark; clip: Clip; scale: Scale; range: Range }) {
  const { side, mark, clip, scale, range } = props;
  const grip = useRef(0);
  const frame = frameOfMark(side, mark);
  const letGo = () => {
    held.value = null;
    current.value?.settle();
  };
  const onPointerDown = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    event.currentTarget.focus();
    grip.current = frameUnder(event.currentTarget.parentElement!, scale, event) - frame;
    held.value = { side, mark };
    showMark(mark);
  };
  const onPointerMove = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const to = frameUnder(event.currentTarget.parentElement!, scale, event) - grip.current;
    moveMark(side, mark, to, event.shiftKey);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const to = frameAfterKey(event, frameOfMark(side, mark), onsetsOf(clip.header.plants));
    if (to === null || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    moveMark(side, mark, to);
  };
  const place = mark === 'both' ? { width: `${(100 * (range[1] - range[0])) / (scale.to - scale.from)}%` } : {};
  return (
    <div
      class={`mark ${mark}`}
      data-mark={`${side} ${mark}`}
      style={{ left: percent(scale, mark === 'end' ? range[1] : range[0]), ...place }}
      role="slider"
      tabIndex={0}
      aria-label={`${side} ${LABELS[mark]}`}
      aria-valuemin={0}
      aria-valuemax={clip.numFrames}
      aria-valuenow={frame}
      aria-valuetext={`frame ${frame}, ${written(frame / clip.header.frameRate)} s`}
      title={`${side} ${LABELS[mark]}: frame ${frame}. Drag, with Shift to where a foot comes down; ← → by a frame, Page keys to the next footplant`}
      onPointerDown={onPointerDown}
      onPointerMove={onPointerMove}
      onLostPointerCapture={letGo}
      onBlur={letGo}
      onFocus={() => showMark(mark)}
      onKeyDown={onKeyDown}
    />
  );
}

/** Where the clock stands in the clip. */
function Now({ scale, number }: { scale: Scale; number: number }) {
  const mark = useRef<HTMLDivElement>(null);
  useSignalEffect(() => {
    const actor = actors.value[number];
    if (actor && mark.current) mark.current.style.left = percent(scale, frameAt(actor, time.value));
  });
  return <div class="now" ref={mark} aria-hidden="true" />;
}

function Strip({ side, clip, range, isNear }: { side: SideName; clip: Clip; range: Range; isNear: boolean }) {
  const box = useRef<HTMLDivElement>(null);
  const width = useSize(box, 'width');
  const number = SIDES.indexOf(side);
  const around = range[1] - range[0];
  // While a mark is held the strip stays where it is.
  const near = useRef<Range>([0, 0]);
  if (held.value === null) near.current = [Math.max(0, range[0] - around), Math.min(clip.numFrames, range[1] + around)];
  const [from, to] = isNear ? near.current : [0, Math.max(1, clip.numFrames)];
  const scale: Scale = { from, to, width: width.value };
  return (
    <div class="strip">
      <span class="name" title={fullNameOf(clip.id)}>
        <Swatch number={number} /> <b>{side}</b> {nameOf(clip.id)}
      </span>
      <div class="track" ref={box} style={{ '--own': `var(--clip-${number})` }}>
        <Ticks scale={scale} rate={clip.header.frameRate} />
        {clip.header.plants.map((plant) => (
          <Bar
            key={`${plant.foot} ${plant.begin}`}
            kind={`plant ${FEET[plant.foot]}`}
            scale={scale}
            range={[plant.begin, plant.end]}
          />
        ))}
        <Others scale={scale} clip={clip.id} />
        <Now key={`${from} ${to} ${clip.id}`} scale={scale} number={number} />
        <Handle side={side} mark="both" clip={clip} scale={scale} range={range} />
        <Handle side={side} mark="begin" clip={clip} scale={scale} range={range} />
        <Handle side={side} mark="end" clip={clip} scale={scale} range={range} />
      </div>
      <output class="number">
        {range[0]}–{range[1]}
      </output>
    </div>
  );
}

const STEPS: readonly { step: PairStep; title: string; meaning: string }[] = [
  { step: 'alignment', title: 'Alignment', meaning: 'The output shows the phase of the input' },
  { step: 'progress', title: 'Progress', meaning: 'Both begin and end together' },
  { step: 'time', title: 'Time', meaning: 'Both run at their own speed' },
];

function StepChoice() {
  return (
    <fieldset class="row">
      <legend class="visually-hidden">In step by</legend>
      <span aria-hidden="true">In step by</span>
      <div class="choice">
        {STEPS.map(({ step, title, meaning }) => (
          <button
            key={step}
            type="button"
            title={meaning}
            aria-pressed={pairStep.value === step}
            onClick={() => {
              pairStep.value = step;
            }}
          >
            {title}
          </button>
        ))}
      </div>
    </fieldset>
  );
}

export function PairStrips() {
  const isNear = useSignal(false);
  const shown = shownClips.value;
  if (!shown) return <section class="pair-strips" aria-label="Cut marks" />;
  return (
    <section class={`pair-strips ${shown.pair.verdict}`} aria-label="Cut marks">
      <div class="row">
        <StepChoice />
        <button
          type="button"
          aria-pressed={isNear.value}
          title="Strips of the stretch and its surroundings, or of the whole clip"
          onClick={() => {
            isNear.value = !isNear.value;
          }}
        >
          Near
        </button>
        <span class="hint">
          Drag marks, or <kbd>M</kbd> and <kbd>←</kbd> <kbd>→</kbd>; <kbd>Shift</kbd> drags to footplants
        </span>
      </div>
      {SIDES.map((side) => (
        <Strip
          key={side}
          side={side}
          clip={shown.clips[side]}
          range={rangeOf(shown.pair[side])!}
          isNear={isNear.value}
        />
      ))}
    </section>
  );
}
