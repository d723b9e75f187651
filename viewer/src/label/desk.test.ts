// SPDX-License-Identifier: MIT
// The desk against a program that answers, refuses, loses answers and comes back.
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { SourceError } from '../data/source';
import { clipOf } from '../state/clip_of.test_support';
import { LabelDesk } from './desk';
import type { LabelServer } from './label_server';
import type { LabelProgress, LabelSaid } from './types';

const TOTAL = 3;

/** A program that keeps labels of items "0", "1", "2". */
class Program implements LabelServer {
  readonly labels: LabelSaid[] = [];
  readonly asked: string[] = [];
  isGone = false;
  losesAnswers = false;

  private answer(stored?: LabelProgress['stored']): LabelProgress {
    const name = (i: number) => (i < TOTAL ? String(i) : null);
    const done = this.labels.length;
    const answer = { rater: 'ada', done, total: TOTAL, next: name(done), afterNext: name(done + 1), notes: [] };
    return stored ? { ...answer, stored } : answer;
  }
  private check(): void {
    if (this.isGone) throw new SourceError({ message: 'gone' });
  }
  async progress() {
    this.check();
    return this.answer();
  }
  async movement(_: string, item: string) {
    this.check();
    this.asked.push(item);
    return clipOf(item, 2, 30);
  }
  async store(label: LabelSaid) {
    this.check();
    const isKnown = this.labels.some(({ item }) => item === label.item);
    if (!isKnown) this.labels.push(label);
    if (this.losesAnswers) throw new SourceError({ message: 'lost' });
    return this.answer(isKnown ? 'before' : 'now');
  }
  async undo({ done }: { done: number }) {
    this.check();
    if (this.labels.length === done) this.labels.pop();
    return this.answer();
  }
}

let program: Program;
let desk: LabelDesk;

beforeEach(async () => {
  vi.useFakeTimers();
  program = new Program();
  desk = new LabelDesk(program, 'ada', () => 0);
  await desk.open();
});
afterEach(() => {
  desk.close();
  vi.useRealTimers();
});

function rate(value: number): void {
  for (const factor of ['flow', 'weight', 'time'] as const) desk.set(factor, value);
}

describe('LabelDesk', () => {
  it('shows the first item with nothing rated', () => {
    expect(desk.movement.value?.id).toBe('0');
    expect(desk.missing.value).toEqual(['flow', 'weight', 'time']);
  });

  it('saves nothing while a factor lacks a word, and goes to it', async () => {
    desk.set('flow', 0.5);
    await desk.save();
    expect(program.labels).toEqual([]);
    expect(desk.chosen.value).toBe('weight');
    expect(desk.note.value).not.toBeNull();
  });

  it('goes on once the label is stored, with a clean label', async () => {
    rate(0.5);
    desk.comment.value = 'odd';
    await desk.save();
    expect(program.labels[0]).toMatchObject({ item: '0', rating: { flow: 0.5, space: null }, comment: 'odd' });
    expect(desk.movement.value?.id).toBe('1');
    expect(desk.draft.value.flow).toBeNull();
    expect(desk.comment.value).toBe('');
  });

  it('asks for the item after next ahead, and for none twice', async () => {
    expect(program.asked).toEqual(['0', '1']);
    rate(0);
    await desk.save();
    expect(program.asked).toEqual(['0', '1', '2']);
  });

  it('keeps the label while the program is gone and saves it when it is back', async () => {
    rate(-0.5);
    program.isGone = true;
    await desk.save();
    expect(desk.problem.value?.message).toBe('gone');
    expect(desk.draft.value.flow).toBe(-0.5);
    expect(desk.movement.value?.id).toBe('0');
    desk.set('flow', 1); // not while it waits
    expect(desk.draft.value.flow).toBe(-0.5);
    await vi.advanceTimersByTimeAsync(5000);
    expect(desk.doing.value).toBe('saving');
    program.isGone = false;
    await vi.advanceTimersByTimeAsync(5000);
    expect(program.labels).toHaveLength(1);
    expect(desk.problem.value).toBeNull();
    expect(desk.movement.value?.id).toBe('1');
  });

  it('stores once where the answer was lost', async () => {
    rate(0.1);
    program.losesAnswers = true;
    await desk.save();
    program.losesAnswers = false;
    await vi.advanceTimersByTimeAsync(5000);
    expect(program.labels).toHaveLength(1);
    expect(desk.movement.value?.id).toBe('1');
  });

  it('lets a label that cannot be saved be changed', async () => {
    rate(0.1);
    program.isGone = true;
    await desk.save();
    desk.changeInstead();
    desk.set('flow', 0.7);
    program.isGone = false;
    await vi.advanceTimersByTimeAsync(5000);
    expect(program.labels).toHaveLength(0);
    await desk.save();
    expect(program.labels[0]?.rating.flow).toBe(0.7);
  });

  it('goes back to the item before with what was said of it', async () => {
    rate(0.3);
    desk.comment.value = 'odd';
    await desk.save();
    await desk.undo();
    expect(program.labels).toEqual([]);
    expect(desk.movement.value?.id).toBe('0');
    expect(desk.draft.value.flow).toBe(0.3);
    expect(desk.comment.value).toBe('odd');
    await desk.undo(); // nothing is left to take back
    expect(desk.movement.value?.id).toBe('0');
  });

  it('changes and saves nothing during a break', async () => {
    rate(0.3);
    desk.togglePause();
    desk.set('flow', 1);
    await desk.save();
    expect(desk.draft.value.flow).toBe(0.3);
    expect(program.labels).toEqual([]);
    desk.togglePause();
    await desk.save();
    expect(program.labels).toHaveLength(1);
  });

  it('is finished when nothing is left', async () => {
    for (let i = 0; i < TOTAL; ++i) {
      rate(0);
      await desk.save();
    }
    expect(desk.isFinished.value).toBe(true);
    expect(desk.movement.value).toBeNull();
    await desk.undo();
    expect(desk.isFinished.value).toBe(false);
  });
});
