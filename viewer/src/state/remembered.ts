// SPDX-License-Identifier: MIT
// How a person left the page, kept by the browser for the next time where it may (a report opened from disk may not, and
// another port counts as another place).
import { effect, type Signal, signal } from '@preact/signals';

function read(key: string): unknown {
  try {
    return JSON.parse(localStorage.getItem(key) ?? 'null');
  } catch {
    return null;
  }
}

function write(key: string, value: unknown): void {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    // It is not kept then; nothing depends on it.
  }
}

/** A value that is `initial` the first time, and then what it was when the page was last open. */
export function remembered(name: string, initial: number): Signal<number>;
export function remembered(name: string, initial: boolean): Signal<boolean>;
export function remembered(name: string, initial: number | boolean): Signal<number> | Signal<boolean> {
  const key = `strut.${name}`;
  const kept = read(key);
  const value = signal(typeof kept === typeof initial ? kept : initial);
  let isFirst = true;
  effect(() => {
    const now = value.value;
    if (!isFirst) write(key, now);
    isFirst = false;
  });
  return value as Signal<number> | Signal<boolean>;
}
