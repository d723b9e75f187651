// SPDX-License-Identifier: MIT
// The page: modes at the top, files and the mode's controls at the sides, the view in the middle, the timeline below.
import { useSignalEffect } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import type { Source } from '../data/source';
import { clips, failure, type Mode, mode, open, session } from '../state/session';
import { listenToKeys } from '../state/shortcuts';
import { actors } from '../state/stage';
import { ProblemNote } from '../ui/problem_note';
import { FileList } from './file_list';
import { LabelPanel } from './label_panel';
import { PairsPanel } from './pairs_panel';
import { Stage } from './stage';
import { Timeline } from './timeline';
import { TranslatePanel } from './translate_panel';
import './app.css';

const MODES: readonly { mode: Mode; title: string; needs: string | null }[] = [
  { mode: 'compare', title: 'Compare', needs: null },
  { mode: 'translate', title: 'Translate', needs: 'model' },
  { mode: 'pairs', title: 'Pairs', needs: 'pairs' },
  { mode: 'label', title: 'Label', needs: 'database' },
];

/** Compare: every clip is on the stage. */
function ComparePanel() {
  useSignalEffect(() => {
    actors.value = clips.value.map((clip, i) => ({ clip, colour: i, title: clip.name }));
  });
  return null;
}

function ModePanel() {
  switch (mode.value) {
    case 'compare':
      return <ComparePanel />;
    case 'translate':
      return <TranslatePanel />;
    case 'pairs':
      return <PairsPanel />;
    case 'label':
      return <LabelPanel />;
  }
}

function ModeTabs() {
  const kinds = new Set<string>(session.value?.files.map((file) => file.kind));
  const offered = MODES.filter((entry) => entry.needs === null || kinds.has(entry.needs));
  return (
    <nav class="modes">
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

export function App({ source }: { source: Source }) {
  useEffect(() => void open(source), [source]);
  useEffect(() => listenToKeys(document), []);
  return (
    <div class="page">
      <header>
        <h1>strut</h1>
        <ModeTabs />
      </header>
      {failure.value && <ProblemNote problem={failure.value} />}
      <aside class="files">
        <FileList />
      </aside>
      <Stage />
      <aside class="controls">
        <ModePanel />
      </aside>
      <Timeline />
    </div>
  );
}
