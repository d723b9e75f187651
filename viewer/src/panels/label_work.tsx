// SPDX-License-Identifier: MIT
// One movement and its label: progress, sliders, comment, keys; and what is shown when everything is labelled.
import { type Signal, useSignalEffect } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import type { LabelDesk } from '../label/desk';
import { factorsShown } from '../label/draft';
import { FACTORS } from '../label/factors';
import { spanInWords } from '../label/pace';
import { viewsOf } from '../label/views';
import { facesAlike, look } from '../scene/view_state';
import { isPlaying, loop, play, time } from '../state/playback';
import { remembered } from '../state/remembered';
import { actors, layout } from '../state/stage';
import { ProblemNote } from '../ui/problem_note';
import { useShortcuts } from '../ui/use_shortcuts';
import { LabelFactor } from './label_factor';
import { LabelFinished } from './label_finished';
import { labelKeys } from './label_keys';

const asksSpace = remembered('label.space', false);
const showsTwoSides = remembered('label.sides', true);

function Progress({ desk }: { desk: LabelDesk }) {
  const { done, total } = desk.progress.value!;
  const left = desk.pace.estimate(total - done);
  return (
    <div class="part label-progress">
      <progress value={done} max={Math.max(total, 1)} aria-label="labels given" />
      <div class="row">
        <output>
          {done} of {total}
          {left !== null && total > done && ` · about ${spanInWords(left)} left`}
        </output>
        <button type="button" aria-pressed={desk.isPaused.value} onClick={() => desk.togglePause()}>
          {desk.isPaused.value ? 'Go on' : 'Break'} <kbd>b</kbd>
        </button>
      </div>
    </div>
  );
}

/** What went wrong, and that the label is still here. */
function Trouble({ desk }: { desk: LabelDesk }) {
  if (!desk.problem.value) return null;
  const isSaving = desk.doing.value === 'saving';
  return (
    <div class="part label-trouble">
      <ProblemNote problem={desk.problem.value} />
      {isSaving && (
        <p>
          This one label is not saved yet; it is sent again as long as this page is open. If `strut view` has ended,
          start it again and give it there: everything before it is saved.
        </p>
      )}
      <div class="row">
        <button type="button" onClick={() => desk.tryAgain()}>
          Try now
        </button>
        {isSaving && (
          <button type="button" onClick={() => desk.changeInstead()}>
            Change the label
          </button>
        )}
      </div>
    </div>
  );
}

function Comment({ desk }: { desk: LabelDesk }) {
  return (
    <label class="part">
      <span>
        Comment <kbd>c</kbd>
      </span>
      <input
        class="label-comment"
        value={desk.comment.value}
        disabled={!desk.isOpen.value}
        autocomplete="off"
        placeholder="if there is something to say"
        onInput={(event) => {
          desk.comment.value = event.currentTarget.value;
        }}
        onKeyDown={(event) => {
          if (event.key !== 'Enter' && event.key !== 'Escape') return;
          event.preventDefault();
          event.currentTarget.blur();
        }}
      />
    </label>
  );
}

function Actions({ desk }: { desk: LabelDesk }) {
  return (
    <div class="part">
      <div class="row">
        <button type="button" class="primary" disabled={!desk.isOpen.value} onClick={() => void desk.save()}>
          {desk.doing.value === 'saving' ? 'Saving' : 'Save, next'} <kbd>Enter</kbd>
        </button>
        <button
          type="button"
          disabled={desk.doing.value !== null || desk.isPaused.value || desk.progress.value!.done === 0}
          onClick={() => void desk.undo()}
        >
          Undo <kbd>u</kbd>
        </button>
      </div>
      <p class="label-note" role="status">
        {desk.note.value ?? ''}
      </p>
    </div>
  );
}

function Switch({ on, title }: { on: Signal<boolean>; title: string }) {
  return (
    <label>
      <input
        type="checkbox"
        checked={on.value}
        onChange={(event) => {
          on.value = event.currentTarget.checked;
        }}
      />
      {title}
    </label>
  );
}

function Help() {
  return (
    <div class="part label-help">
      <p class="hint">
        <kbd>1</kbd>–<kbd>{asksSpace.value ? 4 : 3}</kbd> factor · <kbd>←</kbd> <kbd>→</kbd> by 0.1, with{' '}
        <kbd>Shift</kbd> by 0.01 · <kbd>0</kbd> neutral · <kbd>x</kbd> not present · <kbd>Space</kbd> play
      </p>
      <details>
        <summary>What the factors mean</summary>
        <dl>
          {FACTORS.map(({ factor, name, meaning }) => (
            <div key={factor}>
              <dt>{name}</dt>
              <dd>{meaning}</dd>
            </div>
          ))}
        </dl>
        <p>
          0 is neutral: the factor shows, and leans to neither end. Not present: this movement has nothing of it. Go by
          the whole movement, and by how it is done rather than by what is done.
        </p>
      </details>
      <Switch on={asksSpace} title="Ask for Space, too" />
      <Switch on={showsTwoSides} title="Show the front and the side" />
    </div>
  );
}

/** Puts the movement on the stage, over and over, and takes it away again in the end. */
function useStage(desk: LabelDesk): void {
  useSignalEffect(() => {
    const movement = desk.movement.value;
    actors.value = movement ? viewsOf(movement, showsTwoSides.value) : [];
  });
  useSignalEffect(() => {
    if (desk.movement.value === null) {
      isPlaying.value = false;
      return;
    }
    loop.value = null;
    time.value = 0;
    look('front');
    play();
  });
  useSignalEffect(() => {
    if (desk.isPaused.value) isPlaying.value = false;
    else play();
  });
  useEffect(() => {
    const before = { facesAlike: facesAlike.peek(), layout: layout.peek() };
    facesAlike.value = false; // one of the two is turned
    layout.value = 'side-by-side';
    return () => {
      facesAlike.value = before.facesAlike;
      layout.value = before.layout;
      actors.value = [];
    };
  }, []);
}

/** Leaving the page asks first while a label waits to be saved. */
function useWarning(desk: LabelDesk): void {
  useEffect(() => {
    const warn = (event: BeforeUnloadEvent) => {
      if (desk.doing.peek() === 'saving') event.preventDefault();
    };
    window.addEventListener('beforeunload', warn);
    return () => window.removeEventListener('beforeunload', warn);
  }, [desk]);
}

export function LabelWork({ desk }: { desk: LabelDesk }) {
  useStage(desk);
  useWarning(desk);
  useShortcuts(labelKeys(desk, () => factorsShown(asksSpace.value)));
  const progress = desk.progress.value;
  if (!progress) return desk.problem.value ? <Trouble desk={desk} /> : <p class="part hint">Opening the database.</p>;
  return (
    <>
      <Progress desk={desk} />
      {progress.notes.map((note) => (
        <ProblemNote key={note.message} problem={note} />
      ))}
      <Trouble desk={desk} />
      {desk.isFinished.value ? (
        <LabelFinished desk={desk} />
      ) : (
        <>
          <fieldset class="part label-factors" disabled={!desk.isOpen.value}>
            <legend class="visually-hidden">Effort of this movement</legend>
            {factorsShown(asksSpace.value).map((factor, i) => (
              <LabelFactor key={factor} desk={desk} factor={factor} number={i + 1} />
            ))}
          </fieldset>
          <Comment desk={desk} />
          <Actions desk={desk} />
          <Help />
        </>
      )}
    </>
  );
}
