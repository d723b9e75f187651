// SPDX-License-Identifier: MIT
// One factor's slider. What is not rated yet looks so: dashed, without a thumb, and in words.
import type { LabelDesk } from '../label/desk';
import { factorInfo, inWords } from '../label/factors';
import type { Factor } from '../label/types';

/** What arrow keys do on a slider, as everywhere else on the page. */
export function stepOf(event: { key: string; shiftKey: boolean }): number | null {
  const step = event.shiftKey ? 0.01 : 0.1;
  if (event.key === 'ArrowLeft') return -step;
  return event.key === 'ArrowRight' ? step : null;
}

export function LabelFactor({ desk, factor, number }: { desk: LabelDesk; factor: Factor; number: number }) {
  const { name, poles, meaning } = factorInfo(factor);
  const said = desk.draft.value[factor];
  const isRated = typeof said === 'number';
  const words = isRated ? inWords(factor, said) : (said ?? 'not yet rated');
  return (
    <div
      class={`label-factor${isRated ? '' : ' unrated'}${said === 'not present' ? ' absent' : ''}`}
      aria-current={desk.chosen.value === factor}
      data-factor={factor}
    >
      <div class="label-factor-head">
        <span title={meaning}>
          <kbd>{number}</kbd> <strong>{name}</strong>
        </span>
        <output>{words}</output>
      </div>
      <input
        type="range"
        min={-1}
        max={1}
        step={0.01}
        value={isRated ? said : 0}
        aria-label={`${name}, from ${poles[0]} to ${poles[1]}`}
        aria-valuetext={words}
        onFocus={() => desk.choose(factor)}
        onInput={(event) => desk.set(factor, Number(event.currentTarget.value))}
        onClick={(event) => desk.set(factor, Number(event.currentTarget.value))}
        onKeyDown={(event) => {
          const step = stepOf(event);
          if (step === null) return;
          event.preventDefault();
          desk.nudge(factor, step);
        }}
      />
      <div class="label-factor-ends">
        <span>{poles[0]}</span>
        <button
          type="button"
          aria-pressed={said === 'not present'}
          aria-label={`${name}: not present`}
          onClick={(event) => {
            desk.toggleNotPresent(factor);
            if (event.detail > 0) event.currentTarget.blur(); // Enter saves again
          }}
        >
          not present
        </button>
        <span>{poles[1]}</span>
      </div>
    </div>
  );
}
