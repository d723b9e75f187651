// SPDX-License-Identifier: MIT
import { useEffect } from 'preact/hooks';
import { registerShortcut, type Shortcut } from '../state/shortcuts';

/** Makes the keys work while the component is on the page. `list` is read once: its actions look at signals. */
export function useShortcuts(list: readonly Shortcut[]): void {
  useEffect(() => {
    const undo = list.map(registerShortcut);
    return () => {
      for (const take of undo) take();
    };
  }, []);
}
