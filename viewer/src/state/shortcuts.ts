// SPDX-License-Identifier: MIT
// The page's keys. Parts register theirs while they are on the page; the list under `?` shows what is registered, so that
// it cannot tell of a key that does nothing.
import { signal } from '@preact/signals';

export interface Shortcut {
  /** One or several ways to press it: a key by its name in KeyboardEvent.key ("Space" for a blank), with "Ctrl+" (or the
   *  command key), "Alt+" and "Shift+" before it, in this order. Signs such as "?" are written without "Shift+". */
  keys: string | readonly string[];
  /** What it does, e.g. "Play or pause". */
  description: string;
  /** Under which heading it is listed, e.g. "Playback". */
  group: string;
  action: () => void;
  /** Whether it works now; always if absent. */
  when?: () => boolean;
}

/** What is asked of a KeyboardEvent. */
export interface KeyPress {
  key: string;
  ctrlKey: boolean;
  altKey: boolean;
  metaKey: boolean;
  shiftKey: boolean;
  defaultPrevented: boolean;
  target: unknown;
  preventDefault(): void;
}

/** In the order in which they were registered. */
export const shortcuts = signal<readonly Shortcut[]>([]);

/** Makes the keys work until the returned function is called. Of several with the same keys the latest counts. */
export function registerShortcut(shortcut: Shortcut): () => void {
  shortcuts.value = [...shortcuts.peek(), shortcut];
  return () => {
    shortcuts.value = shortcuts.peek().filter((entry) => entry !== shortcut);
  };
}

export function keysOf(shortcut: Shortcut): readonly string[] {
  return typeof shortcut.keys === 'string' ? [shortcut.keys] : shortcut.keys;
}

/** How a key press is written in Shortcut.keys. */
export function nameOf(press: KeyPress): string {
  const key = press.key === ' ' ? 'Space' : press.key.length === 1 ? press.key.toLowerCase() : press.key;
  const isSign = key.length === 1 && key.toUpperCase() === key;
  const shift = press.shiftKey && !isSign ? 'Shift+' : '';
  return `${press.ctrlKey || press.metaKey ? 'Ctrl+' : ''}${press.altKey ? 'Alt+' : ''}${shift}${key}`;
}

/** How keys are written in Shortcut.keys, whatever the case of a letter. */
function normal(keys: string): string {
  return keys.replace(/[^+]$/, (letter) => letter.toLowerCase());
}

/** What a control does with keys itself, by what it is. */
const OWN_KEYS: readonly (readonly [selector: string, keys: RegExp])[] = [
  ['textarea, select, [contenteditable], dialog *, dialog', /./],
  ['input:not([type=checkbox], [type=radio], [type=range], [type=button], [type=color])', /./],
  ['input[type=range], input[type=radio]', /^(Shift\+)?(Arrow|Home|End|Page)/],
  [
    'button, a, summary, input[type=checkbox], input[type=radio], input[type=button], input[type=color]',
    /^(Space|Enter)$/,
  ],
];

function isTakenBy(target: unknown, name: string): boolean {
  const matches = (target as { matches?: (selector: string) => boolean } | null)?.matches?.bind(target);
  return matches !== undefined && OWN_KEYS.some(([selector, keys]) => keys.test(name) && matches(selector));
}

/** Does what is registered for a key press, unless a control has its own use for it or text is being typed. */
export function handleKey(press: KeyPress): void {
  const name = nameOf(press);
  if (press.defaultPrevented || isTakenBy(press.target, name)) return;
  const fits = (shortcut: Shortcut) => keysOf(shortcut).some((keys) => normal(keys) === name);
  const found = shortcuts
    .peek()
    .filter((shortcut) => fits(shortcut) && (shortcut.when?.() ?? true))
    .at(-1);
  if (!found) return;
  press.preventDefault();
  found.action();
}

/** Listens to the keys of the page until the returned function is called. */
export function listenToKeys(page: Pick<Document, 'addEventListener' | 'removeEventListener'>): () => void {
  page.addEventListener('keydown', handleKey);
  return () => page.removeEventListener('keydown', handleKey);
}
