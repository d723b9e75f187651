// SPDX-License-Identifier: MIT
// A new pair of two clips of the session; its stretches are cut on the strips like those of any other.
import { useSignal } from '@preact/signals';
import type { OpenList } from '../pairs/open_list';
import { rangeOf } from '../pairs/showing';
import { nameOf } from '../state/names';
import { loadClip, session } from '../state/session';

function ClipChoice(props: { label: string; value: string; set: (id: string) => void }) {
  const files = (session.value?.files ?? []).filter((file) => file.kind === 'clip' && !file.problem);
  return (
    <label>
      {props.label}
      <select value={props.value} onChange={(event) => props.set(event.currentTarget.value)}>
        {files.map((file) => (
          <option key={file.id} value={file.id}>
            {nameOf(file.id)}
          </option>
        ))}
      </select>
    </label>
  );
}

export function PairsAdd({ list }: { list: OpenList }) {
  const like = list.pair.value;
  const input = useSignal('');
  const output = useSignal('');
  const inputId = input.value || (like?.input.clip ?? '');
  const outputId = output.value || (like?.output.clip ?? '');
  const add = async () => {
    // Marks can be dragged once it is known how long the clips are.
    await Promise.all([loadClip(inputId), loadClip(outputId)]);
    const side = (clip: string) => ({ clip, frames: rangeOf({ clip, frames: null }) });
    list.add(side(inputId), side(outputId));
    input.value = '';
    output.value = '';
  };
  return (
    <details class="pairs-add">
      <summary>Add a pair</summary>
      <ClipChoice
        label="Input"
        value={inputId}
        set={(id) => {
          input.value = id;
        }}
      />
      <ClipChoice
        label="Output"
        value={outputId}
        set={(id) => {
          output.value = id;
        }}
      />
      <button type="button" disabled={!inputId || !outputId} onClick={() => void add().catch(() => {})}>
        Add, then cut it below the stage
      </button>
    </details>
  );
}
