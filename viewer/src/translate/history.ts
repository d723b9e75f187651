// SPDX-License-Identifier: MIT
// Undo and redo: every value there was. What is changed by the same hand in one go (a slider that is dragged) is one step.

export interface History<Value> {
  past: readonly Value[];
  now: Value;
  future: readonly Value[];
  /** What was changed last, and when [ms]: further changes of it soon after are the same step. */
  last?: { what: string; at: number };
}

/** Changes of one thing that follow each other within this time are one step [ms]. */
const ONE_GO = 800;
const MOST = 200;

export function changed<Value>(history: History<Value>, now: Value, what: string, at: number): History<Value> {
  const { last } = history;
  const isSame = last !== undefined && last.what === what && at - last.at < ONE_GO && history.future.length === 0;
  const past = isSame ? history.past : [...history.past, history.now].slice(-MOST);
  return { past, now, future: [], last: { what, at } };
}

export function undone<Value>(history: History<Value>): History<Value> {
  const before = history.past.at(-1);
  if (before === undefined) return history;
  return { past: history.past.slice(0, -1), now: before, future: [history.now, ...history.future] };
}

export function redone<Value>(history: History<Value>): History<Value> {
  const [next, ...future] = history.future;
  if (next === undefined) return history;
  return { past: [...history.past, history.now], now: next, future };
}
