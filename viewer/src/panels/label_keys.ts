// SPDX-License-Identifier: MIT
// Labelling without a mouse.
import type { LabelDesk } from '../label/desk';
import type { Factor } from '../label/types';
import type { Shortcut } from '../state/shortcuts';

const GROUP = 'Label';

function focusComment(): void {
  document.querySelector<HTMLInputElement>('.label-comment')?.focus();
}

export function labelKeys(desk: LabelDesk, shown: () => readonly Factor[]): Shortcut[] {
  const when = () => desk.isOpen.value;
  const chosen = () => desk.chosen.value;
  const choose = (index: number) => {
    const factor = shown()[index];
    if (factor) desk.choose(factor);
  };
  const chooseBy = (by: number) => {
    const index = shown().indexOf(chosen()) + by;
    choose(Math.min(Math.max(index, 0), shown().length - 1));
  };
  const key = (keys: string, description: string, action: () => void): Shortcut => ({
    keys,
    description,
    group: GROUP,
    action,
    when,
  });
  return [
    key('1', 'Flow', () => choose(0)),
    key('2', 'Weight', () => choose(1)),
    key('3', 'Time', () => choose(2)),
    key('4', 'Space, if it is asked for', () => choose(3)),
    key('ArrowUp', 'The factor above', () => chooseBy(-1)),
    key('ArrowDown', 'The factor below', () => chooseBy(1)),
    key('ArrowLeft', '0.1 to the left', () => desk.nudge(chosen(), -0.1)),
    key('ArrowRight', '0.1 to the right', () => desk.nudge(chosen(), 0.1)),
    key('Shift+ArrowLeft', '0.01 to the left', () => desk.nudge(chosen(), -0.01)),
    key('Shift+ArrowRight', '0.01 to the right', () => desk.nudge(chosen(), 0.01)),
    key('0', 'Neutral', () => desk.set(chosen(), 0)),
    key('x', 'Not present', () => desk.toggleNotPresent(chosen())),
    key('c', 'Comment; Enter leaves it', focusComment),
    key('Enter', 'Save and go on', () => void desk.save()),
    { keys: 'u', description: 'Take the last label back', group: GROUP, action: () => void desk.undo() },
    { keys: 'b', description: 'A break from labelling, or go on', group: GROUP, action: () => desk.togglePause() },
  ];
}
