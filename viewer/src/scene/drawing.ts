// SPDX-License-Identifier: MIT
// How much is drawn now: what a person chose, or what the times between pictures ask for. Lasts as long as the page.
import { computed, signal } from '@preact/signals';
import { DRAWING_LEVELS, type DrawingLevel, LevelChooser, LIGHTEST } from './drawing_level';

export type DrawingChoice = 'automatic' | 'full' | 'light';
export const DRAWING_CHOICES: readonly DrawingChoice[] = ['automatic', 'full', 'light'];

export const drawingChoice = signal<DrawingChoice>('automatic');

// On a screen with one pixel per CSS pixel, fewer make no difference.
const chooser = new LevelChooser(globalThis.devicePixelRatio > 1 ? 1 : 2);
const measured = signal(0);

/** Index into DRAWING_LEVELS. */
export const drawingLevel = computed(() => {
  if (drawingChoice.value === 'automatic') return measured.value;
  return drawingChoice.value === 'light' ? LIGHTEST : 0;
});

export const drawing = computed<DrawingLevel>(() => DRAWING_LEVELS[drawingLevel.value]!);

/** While playing, a picture came `ms` after the one before; null: playing has begun. */
export function notePicture(ms: number | null): void {
  if (drawingChoice.peek() !== 'automatic') return;
  if (ms === null) chooser.restart();
  else measured.value = chooser.add(ms);
}
