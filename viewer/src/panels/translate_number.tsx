// SPDX-License-Identifier: MIT
// A control that is a number: a slider, the number to type, and a button that makes it as usual again (a double click on
// the slider does too).
import type { NumberInfo } from '../translate/controls';
import { positionOf, valueAt } from '../translate/scale';
import { wordsOf } from '../translate/words';

interface Props {
  info: NumberInfo;
  value: number;
  change: (value: number) => void;
}

/** What was typed, kept within the range; nothing for what is no number. */
function typed(text: string, { least, greatest }: NumberInfo): number | null {
  const value = text.trim() === '' ? Number.NaN : Number(text);
  return Number.isFinite(value) ? Math.min(Math.max(value, least), greatest) : null;
}

export function TranslateNumber({ info, value, change }: Props) {
  const { title, hint, unit } = wordsOf(info.name);
  const label = unit ? `${title} [${unit}]` : title;
  const reset = () => change(info.usual);
  return (
    <div class="translate-number" title={hint}>
      <span class="title">{label}</span>
      <input
        type="range"
        min={0}
        max={1}
        step={0.01 / (info.greatest > 10 ? 1 : info.greatest - info.least)}
        value={positionOf(value, info)}
        aria-label={label}
        aria-valuetext={String(value)}
        onInput={(event) => change(valueAt(Number(event.currentTarget.value), info))}
        onDblClick={reset}
      />
      <input
        class="number"
        inputMode="decimal"
        value={value}
        aria-label={`${label}, number`}
        onChange={(event) => {
          const wanted = typed(event.currentTarget.value, info);
          if (wanted === null) event.currentTarget.value = String(value);
          else change(wanted);
        }}
      />
      <button
        type="button"
        class="plain reset"
        disabled={value === info.usual}
        aria-label={`${title}: ${info.usual} as usual`}
        title={`${info.usual} as usual`}
        onClick={reset}
      >
        ↺
      </button>
    </div>
  );
}
