// SPDX-License-Identifier: MIT
// The keys of the page as they are now, by group, in a dialog.
import { useEffect, useRef } from 'preact/hooks';
import { keysOf, type Shortcut, shortcuts } from '../state/shortcuts';
import './shortcut_list.css';

const SIGNS: Readonly<Record<string, string>> = {
  ArrowLeft: '←',
  ArrowRight: '→',
  ArrowUp: '↑',
  ArrowDown: '↓',
  Escape: 'Esc',
};

function groupsOf(all: readonly Shortcut[]): Map<string, Shortcut[]> {
  const groups = new Map<string, Shortcut[]>();
  for (const shortcut of all) groups.set(shortcut.group, [...(groups.get(shortcut.group) ?? []), shortcut]);
  return groups;
}

/** A key press as its keys are labelled, e.g. "Shift+ArrowLeft". */
function Keys({ keys }: { keys: string }) {
  const parts = keys.split(/\+(?!$)/);
  return (
    <>
      {parts.map((part) => (
        <kbd key={part}>{SIGNS[part] ?? (part.length === 1 ? part.toUpperCase() : part)}</kbd>
      ))}
    </>
  );
}

function Row({ shortcut }: { shortcut: Shortcut }) {
  return (
    <tr>
      <td>
        {keysOf(shortcut).map((keys, i) => (
          <span key={keys}>
            {i > 0 && ' or '}
            <Keys keys={keys} />
          </span>
        ))}
      </td>
      <td>{shortcut.description}</td>
    </tr>
  );
}

/** Open for as long as it is on the page. */
export function ShortcutList({ close }: { close: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current!.showModal(), []);
  return (
    <dialog class="shortcut-list" ref={dialog} aria-labelledby="shortcut-list-title" onClose={close}>
      <form method="dialog">
        <h2 id="shortcut-list-title">Keyboard shortcuts</h2>
        <button type="submit">Close</button>
      </form>
      <div class="groups">
        {[...groupsOf(shortcuts.value)].map(([group, members]) => (
          <section key={group}>
            <h3>{group}</h3>
            <table>
              <tbody>
                {members.map((shortcut) => (
                  <Row key={keysOf(shortcut).join()} shortcut={shortcut} />
                ))}
              </tbody>
            </table>
          </section>
        ))}
      </div>
      <p class="hint">While a slider or a list has the focus, arrow keys move that.</p>
    </dialog>
  );
}
