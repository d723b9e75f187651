// SPDX-License-Identifier: MIT
// Translate: a style put on a clip while it plays. The input and the result are on the stage; the result is swapped when
// it comes, time and camera stay.
import { batch, useSignalEffect } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { withoutHoles } from '../state/aligning';
import { nameOf } from '../state/names';
import { loadClip, loadedClips, source } from '../state/session';
import type { Shortcut } from '../state/shortcuts';
import { type Actor, actors, alignments, step } from '../state/stage';
import * as translating from '../translate/translating';
import { ProblemNote } from '../ui/problem_note';
import { Swatch } from '../ui/swatch';
import { useShortcuts } from '../ui/use_shortcuts';
import { TranslateControls } from './translate_controls';
import { TranslateModels } from './translate_models';
import { TranslateOutput } from './translate_output';
import './translate_panel.css';

const { inPhase, isBusy, problem, result, settings, took, truth } = translating;

const KEYS: readonly Shortcut[] = [
  { keys: 'Ctrl+z', description: 'Undo a change of the controls', group: 'Translate', action: translating.undo },
  {
    keys: ['Ctrl+Shift+z', 'Ctrl+y'],
    description: 'Redo it',
    group: 'Translate',
    action: translating.redo,
  },
  {
    keys: 's',
    description: 'In step by time or in phase',
    group: 'Translate',
    action: () => {
      inPhase.value = !inPhase.value;
    },
  },
];

/** For a recorded truth: the moments of it that belong to the input's. */
const truthMoments = new Map<string, Float32Array>();

function actorsNow(): Actor[] {
  const shown: Actor[] = [];
  const input = loadedClips.value.get(settings.value.clip);
  if (input) shown.push({ clip: input, colour: 0, title: 'input' });
  if (input && result.value) shown.push({ clip: result.value.clip, colour: 1, title: 'output' });
  const real = loadedClips.value.get(truth.value);
  if (input && real) shown.push({ clip: real, colour: 2, title: `compared: ${nameOf(truth.value)}` });
  return shown;
}

function alignmentsNow(): Map<string, Float32Array> {
  const known = new Map<string, Float32Array>();
  if (result.value?.moments) known.set(result.value.clip.id, result.value.moments);
  const real = truthMoments.get(`${settings.value.clip} ${truth.value}`);
  if (real) known.set(truth.value, real);
  return known;
}

async function alignTruth(input: string, real: string): Promise<void> {
  const key = `${input} ${real}`;
  if (real === '' || truthMoments.has(key)) return;
  try {
    truthMoments.set(key, withoutHoles((await source.value!.alignment(input, real)).moments));
    alignments.value = alignmentsNow();
  } catch (error) {
    translating.tellProblem(error);
  }
}

/** Keeps the stage as it is set here; leaves it in step as it was found. */
function useStage(): void {
  useEffect(() => {
    const before = step.peek();
    void translating.begin();
    return () => {
      step.value = before === 'alignment' ? 'time' : before;
      alignments.value = new Map();
    };
  }, []);
  useSignalEffect(() => {
    const { clip, models } = settings.value;
    if (clip !== '') loadClip(clip).catch(translating.tellProblem);
    translating.loadModels(models.map(({ id }) => id));
  });
  useSignalEffect(() => {
    const shown = actorsNow();
    const known = alignmentsNow();
    const how = inPhase.value ? 'alignment' : 'time';
    batch(() => {
      actors.value = shown;
      alignments.value = known;
      step.value = how;
    });
  });
  useSignalEffect(() => {
    if (inPhase.value) void alignTruth(settings.value.clip, truth.value);
  });
}

function StepChoice() {
  const choice = (isPhase: boolean, title: string, meaning: string) => (
    <button
      type="button"
      aria-pressed={inPhase.value === isPhase}
      title={meaning}
      onClick={() => {
        inPhase.value = isPhase;
      }}
    >
      {title}
    </button>
  );
  return (
    <fieldset>
      <legend>In step</legend>
      <div class="choice">
        {choice(true, 'In phase', 'The output shows what becomes of the moment of the input')}
        {choice(false, 'By time', 'Both show the same second')}
      </div>
    </fieldset>
  );
}

function Status() {
  if (problem.value) return <ProblemNote problem={problem.value} />;
  const notes = result.value?.clip.header.notes ?? [];
  return (
    <>
      <p class="hint translate-status" role="status">
        {isBusy.value && <progress aria-label="translating" />}
        {isBusy.value ? 'Translating; the result before stays until then.' : took.value !== null && inWords(took.value)}
      </p>
      {notes.map((note) => (
        <p class="hint" key={note.message}>
          {note.message}
        </p>
      ))}
    </>
  );
}

function inWords(milliseconds: number): string {
  const seconds = result.value?.clip.duration ?? 0;
  return `Output of ${seconds.toFixed(1)} s, ${Math.round(milliseconds)} ms after the change.`;
}

function OnStage() {
  return (
    <section class="part">
      <ul class="translate-legend">
        {actors.value.map((actor) => (
          <li key={actor.title}>
            <Swatch number={actor.colour} /> {actor.title}
          </li>
        ))}
      </ul>
      <StepChoice />
      <Status />
    </section>
  );
}

export function TranslatePanel() {
  useStage();
  useShortcuts(KEYS);
  if (translating.clipFiles.value.length === 0) {
    return <p class="part hint">Open a clip beside the model: strut view MODEL.strut CLIP.bvh</p>;
  }
  return (
    <div class="translate-panel">
      <TranslateModels />
      <OnStage />
      <TranslateControls />
      <TranslateOutput />
    </div>
  );
}
