// SPDX-License-Identifier: MIT
// Which joints leave trails, and how long these are.
import { useRef } from 'preact/hooks';
import type { Side } from '../data/types';
import { bodyPoints } from '../scene/body';
import { type TrailLength, trailLength } from '../scene/view_state';
import { actors, trails } from '../state/stage';

const LENGTHS: readonly { length: TrailLength; title: string }[] = [
  { length: null, title: 'the whole clip' },
  { length: 10, title: 'the last 10 s' },
  { length: 3, title: 'the last 3 s' },
  { length: 1, title: 'the last second' },
];

const COLUMNS: readonly { side: Side; title: string }[] = [
  { side: 'left', title: 'Left' },
  { side: 'centre', title: 'Trunk' },
  { side: 'right', title: 'Right' },
];

/** The joints of all clips by their names, each once. */
function joints(): Map<string, Side> {
  const found = new Map<string, Side>();
  for (const { clip } of actors.value) {
    for (const i of bodyPoints(clip.header)) {
      const { name, side, isTip } = clip.header.points[i]!;
      if (!isTip && !found.has(name)) found.set(name, side);
    }
  }
  return found;
}

function choose(name: string, isChosen: boolean): void {
  const others = trails.value.filter((entry) => entry !== name);
  trails.value = isChosen ? [...others, name] : others;
}

function LengthChoice() {
  return (
    <label>
      Show{' '}
      <select
        value={String(trailLength.value)}
        onChange={(event) => {
          trailLength.value = LENGTHS[event.currentTarget.selectedIndex]!.length;
        }}
      >
        {LENGTHS.map(({ length, title }) => (
          <option key={title} value={String(length)}>
            {title}
          </option>
        ))}
      </select>
    </label>
  );
}

function JointColumns() {
  const all = [...joints()];
  return (
    <div class="joint-columns">
      {COLUMNS.map(({ side, title }) => (
        <fieldset key={side} class={`joint-side ${side}`}>
          <legend>{title}</legend>
          {all
            .filter(([, own]) => own === side)
            .map(([name]) => (
              <label key={name}>
                <input
                  type="checkbox"
                  checked={trails.value.includes(name)}
                  onChange={(event) => choose(name, event.currentTarget.checked)}
                />
                {name}
              </label>
            ))}
        </fieldset>
      ))}
    </div>
  );
}

export function JointPicker() {
  const details = useRef<HTMLDetailsElement>(null);
  const count = trails.value.length;
  const close = (event: KeyboardEvent) => {
    if (event.key !== 'Escape' || !details.current?.open) return;
    event.stopPropagation();
    details.current.open = false;
    details.current.querySelector('summary')?.focus();
  };
  return (
    <details class="joint-picker" ref={details} onKeyDown={close}>
      <summary title="The paths of joints" class={count > 0 ? 'is-on' : ''}>
        Trails{count > 0 && ` (${count})`}
      </summary>
      <div class="joint-panel">
        <div class="joint-head">
          <LengthChoice />
          <button
            type="button"
            disabled={count === 0}
            onClick={() => {
              trails.value = [];
            }}
          >
            None
          </button>
        </div>
        <p>A click on a joint in the picture does the same.</p>
        <JointColumns />
      </div>
    </details>
  );
}
