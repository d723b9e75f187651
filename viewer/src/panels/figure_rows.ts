// SPDX-License-Identifier: MIT
// The figures of the clips on the stage, put together figure by figure, and which of them is best.
import type { Figure } from '../data/types';
import { duration, frameAt } from '../state/playback';
import type { Actor } from '../state/stage';

export type Mark = 'best' | 'worst' | null;

export interface FigureCell {
  actor: Actor;
  figure: Figure;
  mark: Mark;
}

/** A figure of every clip that has it. */
export interface FigureRow {
  name: string;
  unit: string;
  better?: 'less' | 'more';
  cells: FigureCell[];
}

/** Numbers that read alike are alike: three digits. */
export function shown(value: number): string {
  const size = Math.abs(value);
  if (size >= 100) return value.toFixed(0);
  return value.toFixed(size >= 10 ? 1 : 2);
}

function mark({ better, cells }: FigureRow): void {
  const values = cells.flatMap(({ figure }) => (figure.value === null ? [] : [figure.value]));
  const [least, most] = [Math.min(...values), Math.max(...values)];
  if (!better || values.length < 2 || shown(least) === shown(most)) return;
  const [best, worst] = better === 'less' ? [least, most] : [most, least];
  for (const cell of cells) {
    if (cell.figure.value === null) continue;
    if (shown(cell.figure.value) === shown(best)) cell.mark = 'best';
    else if (shown(cell.figure.value) === shown(worst)) cell.mark = 'worst';
  }
}

/** In the order in which the clips have them. */
export function figureRows(actors: readonly Actor[]): FigureRow[] {
  const rows = new Map<string, FigureRow>();
  for (const actor of actors) {
    for (const figure of actor.clip.header.figures) {
      const { name, unit, better } = figure;
      const row = rows.get(name) ?? { name, unit, better, cells: [] };
      row.cells.push({ actor, figure, mark: null });
      row.better ??= better;
      rows.set(name, row);
    }
  }
  for (const row of rows.values()) mark(row);
  return [...rows.values()];
}

/** When `actor` shows `frame`, however the clips are kept in step [s]. */
export function momentOf(actor: Actor, frame: number): number {
  let [low, high] = [0, duration.value];
  for (let round = 0; round < 50; ++round) {
    const middle = (low + high) / 2;
    if (frameAt(actor, middle) < frame) low = middle;
    else high = middle;
  }
  return high;
}
