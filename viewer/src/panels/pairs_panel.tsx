// SPDX-License-Identifier: MIT
// Pairs: what `strut pair` proposed, one after the other: played, cut anew, accepted or rejected, and saved to the list.
import { useSignalEffect } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { current, isAnyUnsaved, keepInStep, loadShown, openList, pairFiles, putOnStage } from '../pairs/showing';
import { loop } from '../state/playback';
import type { Shortcut } from '../state/shortcuts';
import { alignments, step } from '../state/stage';
import { useShortcuts } from '../ui/use_shortcuts';
import { PairsDetails } from './pairs_details';
import { PairsFile } from './pairs_file';
import { PairsList } from './pairs_list';
import './pairs.css';

function entry(keys: string | string[], description: string, action: () => void): Shortcut {
  return { keys, description, group: 'Pairs', action };
}

const PAGE = 10;

const KEYS: readonly Shortcut[] = [
  entry(['j', 'ArrowDown'], 'Next pair', () => current.value?.go(1)),
  entry(['k', 'ArrowUp'], 'Previous pair', () => current.value?.go(-1)),
  entry('PageDown', 'Ten pairs on', () => current.value?.go(PAGE)),
  entry('PageUp', 'Ten pairs back', () => current.value?.go(-PAGE)),
  entry('a', 'Accept the pair (or take it back) and go on', () => current.value?.judge('accepted')),
  entry('r', 'Reject the pair (or take it back) and go on', () => current.value?.judge('rejected')),
  entry(['u', 'Ctrl+z'], 'Undo', () => current.value?.undo()),
  entry(['Shift+u', 'Ctrl+Shift+z', 'Ctrl+y'], 'Redo', () => current.value?.redo()),
  entry('Ctrl+s', 'Save the list', () => void current.value?.save()),
  entry('m', 'Take hold of the next cut mark; arrow keys move it', focusNextMark),
];

function focusNextMark(): void {
  const marks = [...document.querySelectorAll<HTMLElement | SVGElement>('.pair-strips [data-mark]')];
  const at = marks.indexOf(document.activeElement as HTMLElement);
  marks[(at + 1) % marks.length]?.focus();
}

/** The stage follows the selected pair, and is given back as it was. */
function useStage(): void {
  useSignalEffect(loadShown);
  useSignalEffect(putOnStage);
  useSignalEffect(keepInStep);
  useSignalEffect(() => {
    void current.value?.selected.value;
    loop.value = null;
  });
  useEffect(() => {
    const before = step.peek();
    return () => {
      step.value = before;
      alignments.value = new Map();
    };
  }, []);
}

let isWatched = false;

/** Whoever closes the page with unsaved changes is asked, whichever mode is shown. */
function watchClosing(): void {
  if (isWatched) return;
  isWatched = true;
  window.addEventListener('beforeunload', (event) => {
    if (isAnyUnsaved()) event.preventDefault();
  });
}

export function PairsPanel() {
  useShortcuts(KEYS);
  useStage();
  useEffect(watchClosing, []);
  useSignalEffect(() => {
    const first = pairFiles.value[0];
    if (current.peek() === null && first) openList(first);
  });
  const list = current.value;
  if (!list) return null;
  return (
    <div class="pairs-panel">
      <PairsFile list={list} />
      {list.isLoaded.value && (
        <>
          <PairsList list={list} />
          <PairsDetails list={list} />
        </>
      )}
    </div>
  );
}
