// SPDX-License-Identifier: MIT
// The page: modes at the top, files and the mode's controls at the sides, the view in the middle, the timeline and a
// drawer of curves below.
import { useSignal, useSignalEffect } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect } from 'preact/hooks';
import type { Source } from '../data/source';
import { titleOf } from '../state/file_groups';
import * as layout from '../state/layout';
import { mode, open, session } from '../state/session';
import { listenToKeys, type Shortcut } from '../state/shortcuts';
import { Icon, type IconName } from '../ui/icon';
import { Splitter } from '../ui/splitter';
import { useShortcuts } from '../ui/use_shortcuts';
import { ComparePanel } from './compare_panel';
import { Curves } from './curves';
import { FailureBanner } from './failure_banner';
import { FileList } from './file_list';
import { LabelPanel } from './label_panel';
import { ModeTabs } from './mode_tabs';
import { PairStrips } from './pair_strips';
import { PairsPanel } from './pairs_panel';
import { ShortcutList } from './shortcut_list';
import { Stage } from './stage';
import { Timeline } from './timeline';
import { TranslatePanel } from './translate_panel';
import './app.css';

const PANELS = { compare: ComparePanel, translate: TranslatePanel, pairs: PairsPanel, label: LabelPanel };

function toggleDrawer(): void {
  layout.showsDrawer.value = !layout.showsDrawer.value;
}

function Toggle(props: { icon: IconName; label: string; keys: string; isOn: boolean; action: () => void }) {
  return (
    <button
      type="button"
      class="toggle"
      aria-pressed={props.isOn}
      aria-label={props.label}
      title={`${props.label} (${props.keys})`}
      onClick={props.action}
    >
      <Icon name={props.icon} />
    </button>
  );
}

function Header({ showShortcuts }: { showShortcuts: () => void }) {
  const isLabelling = mode.value === 'label';
  return (
    <header>
      <h1>strut</h1>
      <ModeTabs />
      <span class="space" />
      {!isLabelling && (
        <>
          <Toggle
            icon="left"
            label="Files"
            keys="["
            isOn={layout.isOpen('files')}
            action={() => layout.toggle('files')}
          />
          <Toggle icon="bottom" label="Curves" keys="C" isOn={layout.showsDrawer.value} action={toggleDrawer} />
        </>
      )}
      <Toggle
        icon="right"
        label="Controls"
        keys="]"
        isOn={layout.isOpen('controls')}
        action={() => layout.toggle('controls')}
      />
      <button type="button" aria-label="Keyboard shortcuts" title="Keyboard shortcuts (?)" onClick={showShortcuts}>
        ?
      </button>
    </header>
  );
}

function Column({ name, children }: { name: 'files' | 'controls'; children: ComponentChildren }) {
  const isFiles = name === 'files';
  const label = isFiles ? 'Files' : 'Controls';
  // Closed it stays on the page, since the mode's panel also keeps the stage up to date.
  return (
    <aside class={name} aria-label={label} hidden={!layout.isOpen(name)}>
      <div class="scrolled">{children}</div>
      <Splitter
        size={isFiles ? layout.filesWidth : layout.controlsWidth}
        side={isFiles ? 'right' : 'left'}
        label={`Width of ${label.toLowerCase()}`}
        least={160}
      />
    </aside>
  );
}

function Drawer() {
  return (
    <section class="drawer" aria-label="Curves">
      <Splitter size={layout.drawerHeight} side="top" label="Height of the curves" least={100} />
      <Curves />
    </section>
  );
}

/** Sizes that a person gave, for app.css. */
function sizes(): Record<string, string> {
  const given: readonly (readonly [string, number])[] = [
    ['--files-width', layout.filesWidth.value],
    ['--controls-width', layout.controlsWidth.value],
    ['--drawer-height', layout.drawerHeight.value],
  ];
  return Object.fromEntries(given.flatMap(([name, size]) => (size > 0 ? [[name, `${size}px`]] : [])));
}

/** Keys of the page, and what follows the session and the screen. */
function usePage(showShortcuts: () => void): void {
  const entry = (keys: string, description: string, action: () => void): Shortcut => {
    return { keys, description, group: 'Page', action };
  };
  useShortcuts([
    entry('?', 'Keyboard shortcuts', showShortcuts),
    entry('[', 'Files, or more room', () => layout.toggle('files')),
    entry(']', 'Controls, or more room', () => layout.toggle('controls')),
    entry('c', 'Curves, or more room', toggleDrawer),
  ]);
  useEffect(() => listenToKeys(document), []);
  useEffect(layout.watchWidth, []);
  useSignalEffect(() => {
    document.title = session.value?.report?.title ?? titleOf(session.value?.files ?? []);
  });
}

export function App({ source }: { source: Source }) {
  const showsShortcuts = useSignal(false);
  const showShortcuts = () => {
    showsShortcuts.value = true;
  };
  usePage(showShortcuts);
  useEffect(() => void open(source), [source]);
  const Panel = PANELS[mode.value];
  const isLabelling = mode.value === 'label';
  return (
    <div class="page" style={sizes()}>
      <Header showShortcuts={showShortcuts} />
      <FailureBanner />
      {!isLabelling && (
        <Column name="files">
          <FileList />
        </Column>
      )}
      <Stage />
      {mode.value === 'pairs' && <PairStrips />}
      <Column name="controls">
        <Panel />
      </Column>
      <Timeline />
      {layout.showsDrawer.value && !isLabelling && <Drawer />}
      {showsShortcuts.value && (
        <ShortcutList
          close={() => {
            showsShortcuts.value = false;
          }}
        />
      )}
    </div>
  );
}
