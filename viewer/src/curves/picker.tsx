// SPDX-License-Identifier: MIT
// The curves that can be chosen, by joint; words narrow the list down.
import { useSignal } from '@preact/signals';
import type { CurveInfo } from '../data/types';
import { type Group, groupsOf, search } from './catalogue';
import { choose, isDrawn, offered } from './chosen';

function Entry({ curve }: { curve: CurveInfo }) {
  return (
    <label>
      <input
        type="checkbox"
        checked={isDrawn(curve)}
        onChange={(event) => choose(curve, event.currentTarget.checked)}
        data-curve={curve.name}
      />
      {curve.label}
      {curve.unit && <small> {curve.unit}</small>}
    </label>
  );
}

function Entries({ group, isSought }: { group: Group; isSought: boolean }) {
  const isOpen = useSignal(group.key === 'body' || group.key === 'alignment' || group.curves.some(isDrawn));
  const shows = isSought || isOpen.value;
  return (
    <details
      open={shows}
      onToggle={(event) => {
        if (!isSought) isOpen.value = event.currentTarget.open;
      }}
    >
      <summary>{group.title}</summary>
      {shows && group.curves.map((curve) => <Entry key={curve.name} curve={curve} />)}
    </details>
  );
}

export function Picker() {
  const text = useSignal('');
  const found = search(groupsOf(offered.value), text.value);
  return (
    <div class="picker">
      <input
        type="search"
        placeholder="Find, e.g. leg rotation"
        aria-label="Find curves"
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
        }}
      />
      <fieldset class="scrolled" aria-label="Curves to draw">
        {found.map((group) => (
          <Entries key={group.key} group={group} isSought={text.value.trim() !== ''} />
        ))}
        {found.length === 0 && (
          <p class="hint">{offered.value.length === 0 ? 'No clip has curves.' : 'Nothing fits.'}</p>
        )}
      </fieldset>
    </div>
  );
}
