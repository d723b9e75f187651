// SPDX-License-Identifier: MIT
// Undo and redo: every state of the pairs that a person made, each with the pair it was about.
import type { Pair } from './pair';

interface State {
  pairs: readonly Pair[];
  /** The pair that was changed to come here; -1 for none. */
  about: number;
  /** Changes with the same name that follow each other are one step, e.g. a mark's whole way while it is dragged. */
  step: string | null;
}

export interface History {
  past: readonly State[];
  now: State;
  future: readonly State[];
}

export function begun(pairs: readonly Pair[]): History {
  return { past: [], now: { pairs, about: -1, step: null }, future: [] };
}

export function edited(history: History, pairs: readonly Pair[], about: number, step: string | null = null): History {
  const goesOn = step !== null && history.now.step === step && history.now.about === about;
  const past = goesOn ? history.past : [...history.past, history.now];
  return { past, now: { pairs, about, step }, future: [] };
}

/** Ends a step that further changes could have been part of. */
export function settled(history: History): History {
  return history.now.step === null ? history : { ...history, now: { ...history.now, step: null } };
}

/** The state before, and the pair that differs in it. */
export function undone(history: History): { history: History; about: number } | null {
  const now = history.past.at(-1);
  if (!now) return null;
  const { about } = history.now;
  return { history: { past: history.past.slice(0, -1), now, future: [history.now, ...history.future] }, about };
}

export function redone(history: History): { history: History; about: number } | null {
  const [now, ...future] = history.future;
  if (!now) return null;
  return { history: { past: [...history.past, history.now], now, future }, about: now.about };
}
