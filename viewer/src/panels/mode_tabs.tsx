// SPDX-License-Identifier: MIT
import type { FileKind } from '../data/types';
import { type Mode, mode, session } from '../state/session';

const MODES: readonly { mode: Mode; title: string; needs: FileKind | null }[] = [
  { mode: 'compare', title: 'Compare', needs: null },
  { mode: 'translate', title: 'Translate', needs: 'model' },
  { mode: 'pairs', title: 'Pairs', needs: 'pairs' },
  { mode: 'label', title: 'Label', needs: 'database' },
];

/** The modes for which there are files. A report has no program that could work, and so only the first. */
export function ModeTabs() {
  const kinds = new Set(session.value?.files.map((file) => file.kind));
  const offered = MODES.filter(({ needs }) => needs === null || kinds.has(needs));
  if (session.value?.report || offered.length < 2) return null;
  return (
    <nav class="modes choice" aria-label="What to do">
      {offered.map((entry) => (
        <button
          type="button"
          key={entry.mode}
          aria-pressed={mode.value === entry.mode}
          onClick={() => {
            mode.value = entry.mode;
          }}
        >
          {entry.title}
        </button>
      ))}
    </nav>
  );
}
