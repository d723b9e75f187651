// SPDX-License-Identifier: MIT
// Compare: clips beside each other or over each other, kept in step by time, by frame, or by which moments belong together.
import { useEffect, useRef } from 'preact/hooks';
import { isGone } from '../data/connection';
import { type Aligning, alignings, alignWithFirst, stopAligning } from '../state/aligning';
import { comparedActors } from '../state/compare';
import { frameAt, time } from '../state/playback';
import type { Shortcut } from '../state/shortcuts';
import { type Actor, actors, type Step, step } from '../state/stage';
import { FileName } from '../ui/file_name';
import { ProblemNote } from '../ui/problem_note';
import { Swatch } from '../ui/swatch';
import { useLive } from '../ui/use_live';
import { useShortcuts } from '../ui/use_shortcuts';
import { Figures } from './figures';
import { ReportNotes } from './report_notes';
import './compare_panel.css';

const STEPS: readonly { step: Step; title: string; meaning: string }[] = [
  { step: 'time', title: 'Time', meaning: 'All show the same second.' },
  { step: 'frame', title: 'Frame', meaning: 'All show the same frame, whatever their rates.' },
  { step: 'alignment', title: 'Alignment', meaning: 'The others show what belongs to the moment of the reference.' },
];

const KEYS: readonly Shortcut[] = [
  {
    keys: 's',
    description: 'In step by time, by frame, by alignment, in turn',
    group: 'Compare',
    action: () => {
      const next = STEPS.findIndex((entry) => entry.step === step.value) + 1;
      step.value = STEPS[next % STEPS.length]!.step;
    },
  },
];

function StepChoice() {
  return (
    <section class="part">
      <h2 id="step-title">In step by</h2>
      {/* biome-ignore lint/a11y/useSemanticElements: a fieldset's legend does not lie in a grid */}
      <div class="choice" role="group" aria-labelledby="step-title">
        {STEPS.map((entry) => (
          <button
            type="button"
            key={entry.step}
            aria-pressed={step.value === entry.step}
            title={entry.meaning}
            onClick={() => {
              step.value = entry.step;
            }}
          >
            {entry.title}
          </button>
        ))}
      </div>
      <p class="hint">{STEPS.find((entry) => entry.step === step.value)!.meaning}</p>
    </section>
  );
}

/** The frame of a clip that is shown now, written straight into the page. */
function FrameShown({ actor }: { actor: Actor }) {
  const place = useRef<HTMLElement>(null);
  useLive(() => {
    const frame = frameAt(actor, time.value);
    const seconds = frame / actor.clip.header.frameRate;
    place.current!.textContent = `#${Math.round(frame)}, ${seconds.toFixed(2)} s`;
  });
  return <span class="number" ref={place} />;
}

/** What became of aligning a clip, in words. */
function AligningNote({ aligning }: { aligning: Aligning | undefined }) {
  if (!aligning) return null;
  if (aligning.state === 'waiting') return <p class="hint">Aligning it with the reference…</p>;
  if (aligning.state === 'unanswered') return <p class="hint">Not aligned yet: it goes by time instead.</p>;
  if (aligning.state === 'refused') {
    return (
      <>
        <ProblemNote problem={aligning.problem} />
        <p class="hint">It goes by time instead.</p>
      </>
    );
  }
  return (
    <>
      <p class="hint">Aligned by {aligning.alignment.method}.</p>
      {aligning.alignment.warnings.map((warning) => (
        <ProblemNote key={warning.message} problem={warning} />
      ))}
    </>
  );
}

function Shown({ actor, isReference }: { actor: Actor; isReference: boolean }) {
  return (
    <li>
      <p class="shown">
        <Swatch number={actor.colour} />
        <span class="title" title={actor.clip.name}>
          <FileName name={actor.title} />
        </span>
        <FrameShown key={actor.clip.id} actor={actor} />
      </p>
      {isReference ? (
        <p class="hint">the reference: its clock is the timeline's</p>
      ) : (
        step.value === 'alignment' && <AligningNote aligning={alignings.value.get(actor.clip.id)} />
      )}
    </li>
  );
}

function OnStage() {
  return (
    <section class="part">
      <h2>On the stage</h2>
      {actors.value.length === 0 && <p class="hint">No clip is on the stage: choose one in the list of files.</p>}
      <ul class="on-stage">
        {actors.value.map((actor, i) => (
          <Shown key={actor.clip.id} actor={actor} isReference={i === 0 && actors.value.length > 1} />
        ))}
      </ul>
    </section>
  );
}

/** Puts what was chosen on the stage, and in step. */
function useStage(): void {
  useLive(() => {
    actors.value = comparedActors.value;
  });
  useLive(() => {
    // Once the program answers again, it is asked again for what it did not answer.
    if (step.value === 'alignment' && !isGone.value) void alignWithFirst(comparedActors.value);
    else if (step.value !== 'alignment') stopAligning();
  });
  useEffect(() => stopAligning, []);
}

export function ComparePanel() {
  useStage();
  useShortcuts(KEYS);
  return (
    <div class="compare-panel">
      <ReportNotes />
      <OnStage />
      {actors.value.length > 1 && <StepChoice />}
      <Figures />
    </div>
  );
}
