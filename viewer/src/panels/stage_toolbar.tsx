// SPDX-License-Identifier: MIT
// The stage's toolbar: how the clips stand to each other, what is drawn, and from where one looks.
import type { Signal } from '@preact/signals';
import { facesAlike, look, startsTogether, turn, type View } from '../scene/view_state';
import { mode } from '../state/session';
import type { Shortcut } from '../state/shortcuts';
import { actors, followsRoot, layout, showsGrid, showsPlants, showsSlide } from '../state/stage';
import { useShortcuts } from '../ui/use_shortcuts';
import { JointPicker } from './joint_picker';

interface Switch {
  title: string;
  hint: string;
  letter: string;
  on: Signal<boolean>;
}

const SWITCHES: readonly Switch[] = [
  { title: 'Follow', hint: 'The camera goes along with the bodies', letter: 'f', on: followsRoot },
  { title: 'Grid', hint: 'Lines on the floor: 1 m, fine ones 10 cm', letter: 'g', on: showsGrid },
  { title: 'Plants', hint: 'Where the feet stand', letter: 'p', on: showsPlants },
  { title: 'Skate', hint: 'How fast feet slide that should stand', letter: 'h', on: showsSlide },
];

const VIEWS: readonly { view: View; title: string; hint: string; letter: string }[] = [
  { view: 'frame', title: 'Frame all', hint: 'See everybody', letter: 'v' },
  { view: 'front', title: 'Front', hint: 'Look from the front', letter: '7' },
  { view: 'side', title: 'Side', hint: 'Look from the side', letter: '8' },
  { view: 'top', title: 'Top', hint: 'Look from above', letter: '9' },
  { view: 'corner', title: 'Corner', hint: 'Look from a corner', letter: '6' },
];

/** How far a key turns the camera [rad], and how much nearer it brings it. */
const TURN = Math.PI / 12;
const NEARER = 0.8;

const MOVES: readonly Shortcut[] = [
  { keys: ',', description: 'Turn the camera to the left', group: 'View', action: () => turn({ right: -TURN }) },
  { keys: '.', description: 'Turn the camera to the right', group: 'View', action: () => turn({ right: TURN }) },
  { keys: 'Shift+ArrowUp', description: 'Look from higher', group: 'View', action: () => turn({ up: TURN / 2 }) },
  { keys: 'Shift+ArrowDown', description: 'Look from lower', group: 'View', action: () => turn({ up: -TURN / 2 }) },
  { keys: 'z', description: 'Nearer', group: 'View', action: () => turn({ distance: NEARER }) },
  { keys: 'Shift+z', description: 'Farther', group: 'View', action: () => turn({ distance: 1 / NEARER }) },
];

const flip = (on: Signal<boolean>) => {
  on.value = !on.value;
};

/** What is labelled is one movement, seen from two sides at most: its layout is its own. */
function hasLayouts(): boolean {
  return mode.value !== 'label';
}

function changeLayout(): void {
  layout.value = layout.value === 'overlaid' ? 'side-by-side' : 'overlaid';
}

const SHORTCUTS: readonly Shortcut[] = [
  { keys: 'l', description: 'Side by side or overlaid', group: 'View', action: changeLayout, when: hasLayouts },
  {
    keys: 'e',
    description: 'Begin alike: same heading, or one place',
    group: 'View',
    action: () => flip(alike()),
    when: hasLayouts,
  },
  ...SWITCHES.map(({ hint, letter, on }) => ({
    keys: letter,
    description: hint,
    group: 'View',
    action: () => flip(on),
  })),
  ...VIEWS.map(({ view, hint, letter }) => ({
    keys: letter,
    description: hint,
    group: 'View',
    action: () => look(view),
  })),
  ...MOVES,
];

/** What makes the clips begin alike in the layout in use. */
function alike(): Signal<boolean> {
  return layout.value === 'overlaid' ? startsTogether : facesAlike;
}

function Toggle({ title, hint, letter, on }: Switch) {
  return (
    <button type="button" aria-pressed={on.value} title={`${hint} (${letter.toUpperCase()})`} onClick={() => flip(on)}>
      {title}
    </button>
  );
}

function LayoutChoice() {
  const choice = (value: 'side-by-side' | 'overlaid', title: string) => (
    <button
      type="button"
      aria-pressed={layout.value === value}
      title={`${title} (L)`}
      onClick={() => {
        layout.value = value;
      }}
    >
      {title}
    </button>
  );
  const isOverlaid = layout.value === 'overlaid';
  return (
    <fieldset disabled={actors.value.length < 2}>
      <legend class="visually-hidden">How the clips stand to each other</legend>
      {choice('side-by-side', 'Side by side')}
      {choice('overlaid', 'Overlaid')}
      <Toggle
        title={isOverlaid ? 'From one place' : 'Same heading'}
        hint={isOverlaid ? 'All begin at one place, facing the same way' : 'All face the same way at the beginning'}
        letter="e"
        on={alike()}
      />
    </fieldset>
  );
}

export function StageToolbar() {
  useShortcuts(SHORTCUTS);
  return (
    <div class="stage-toolbar" role="toolbar" aria-label="View">
      {hasLayouts() && <LayoutChoice />}
      <fieldset>
        <legend class="visually-hidden">What is drawn</legend>
        {SWITCHES.map((entry) => (
          <Toggle {...entry} key={entry.letter} />
        ))}
        <JointPicker />
      </fieldset>
      <fieldset>
        <legend class="visually-hidden">From where one looks</legend>
        {VIEWS.map(({ view, title, hint, letter }) => (
          <button type="button" key={view} title={`${hint} (${letter.toUpperCase()})`} onClick={() => look(view)}>
            {title}
          </button>
        ))}
      </fieldset>
    </div>
  );
}
