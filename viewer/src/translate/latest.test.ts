// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { Latest } from './latest';

function told() {
  const waiting: {
    question: number;
    done: (answer: string) => void;
    fail: (error: Error) => void;
    signal: AbortSignal;
  }[] = [];
  const answers: string[] = [];
  const failures: string[] = [];
  const latest = new Latest<number, string>(
    (question, signal) => new Promise((done, fail) => waiting.push({ question, done, fail, signal })),
    (_, answer) => answers.push(answer),
    (_, error) => failures.push((error as Error).message),
  );
  return { latest, waiting, answers, failures };
}
const turn = () => new Promise((done) => setTimeout(done, 0));

describe('Latest', () => {
  it('has one question on its way and skips all but the newest of the rest', async () => {
    const { latest, waiting, answers } = told();
    for (const question of [1, 2, 3, 4]) latest.put(question);
    expect(waiting.map(({ question }) => question)).toEqual([1]);
    waiting[0]!.done('one');
    await turn();
    expect(waiting.map(({ question }) => question)).toEqual([1, 4]);
    waiting[1]!.done('four');
    await turn();
    expect(answers).toEqual(['one', 'four']);
    expect(latest.isBusy).toBe(false);
  });

  it('goes on after a refusal', async () => {
    const { latest, waiting, answers, failures } = told();
    latest.put(1);
    latest.put(2);
    waiting[0]!.fail(new Error('no'));
    await turn();
    waiting[1]!.done('two');
    await turn();
    expect(failures).toEqual(['no']);
    expect(answers).toEqual(['two']);
  });

  it('forgets what was dropped, and asks anew', async () => {
    const { latest, waiting, answers } = told();
    latest.put(1);
    latest.put(2);
    latest.drop();
    expect(waiting[0]!.signal.aborted).toBe(true);
    latest.put(3);
    waiting[0]!.done('one');
    await turn();
    waiting[1]!.done('three');
    await turn();
    expect(waiting.map(({ question }) => question)).toEqual([1, 3]);
    expect(answers).toEqual(['three']);
  });
});
