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

/** A figure of every clip; null for one that has not got it. */
export interface FigureRow {
  name: string;
  unit: string;
  better?: 'less' | 'more';
  cells: (FigureCell | null)[];
}

/** Numbers that read alike are alike: three digits. */
export function shown(value: number): string {
  const size = Math.abs(value);
  if (size >= 100) return value.toFixed(0);
  return value.toFixed(size >= 10 ? 1 : 2);
}

function mark({ better, cells }: FigureRow): void {
  const known = cells.filter((cell) => cell !== null && cell.figure.value !== null) as FigureCell[];
  const values = known.map(({ figure }) => figure.value!);
  const least = shown(Math.min(...values));
  const most = shown(Math.max(...values));
  if (!better || values.length < 2 || least === most) return;
  const [best, worst] = better === 'less' ? [least, most] : [most, least];
  for (const cell of known) {
    const text = shown(cell.figure.value!);
    if (text === best) cell.mark = 'best';
    else if (text === worst) cell.mark = 'worst';
  }
}

/** In the order in which the clips have them. */
export function figureRows(actors: readonly Actor[]): FigureRow[] {
  const rows = new Map<string, FigureRow>();
  actors.forEach((actor, i) => {
    for (const figure of actor.clip.header.figures) {
      const { name, unit, better } = figure;
      const row: FigureRow = rows.get(name) ?? { name, unit, cells: actors.map(() => null) };
      row.better ??= better;
      row.cells[i] = { actor, figure, mark: null };
      rows.set(name, row);
    }
  });
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
