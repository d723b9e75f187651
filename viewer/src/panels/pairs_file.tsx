// SPDX-License-Identifier: MIT
// The list as a file: which one, how far a person has come with it, saving, a copy, undo.
import { useSignal } from '@preact/signals';
import type { OpenList } from '../pairs/open_list';
import { progressOf } from '../pairs/pair';
import { openList, pairFiles } from '../pairs/showing';
import { ProblemNote } from '../ui/problem_note';

function offer(toml: string, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([toml], { type: 'application/toml' }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000); // the browser has begun by then
}

function fileName(list: OpenList): string {
  return list.file.path.split('/').at(-1) ?? list.file.name;
}

function Choice({ list }: { list: OpenList }) {
  if (pairFiles.value.length < 2) return <h2 title={list.file.path}>{list.file.name}</h2>;
  return (
    <select
      aria-label="Pair list"
      value={list.file.id}
      onChange={(event) => openList(pairFiles.value.find((file) => file.id === event.currentTarget.value)!)}
    >
      {pairFiles.value.map((file) => (
        <option key={file.id} value={file.id}>
          {file.name}
        </option>
      ))}
    </select>
  );
}

function ProgressLine({ list }: { list: OpenList }) {
  const { total, accepted, rejected } = progressOf(list.pairs.value);
  const done = accepted + rejected;
  return (
    <div>
      <progress value={done} max={total} aria-label="Looked at" />
      <p class="hint number progress">
        {done} of {total} looked at
        <span title={`${accepted} accepted, ${rejected} rejected`}>
          ✓ {accepted} &ensp; ✗ {rejected}
        </span>
      </p>
    </div>
  );
}

/** What to do when the file cannot be read or saved. */
function Trouble({ list, saveCopy }: { list: OpenList; saveCopy: () => void }) {
  if (!list.problem.value) return null;
  const readAgain = () => {
    const isSure = !list.isUnsaved.value || window.confirm('Read the file again? What you changed here is given up.');
    if (isSure) void list.load();
  };
  return (
    <div class="trouble">
      <ProblemNote problem={list.problem.value} />
      <div class="row">
        {list.isLoaded.value && (
          <>
            <button type="button" onClick={() => void list.save()}>
              Try again
            </button>
            <button type="button" onClick={saveCopy}>
              Save a copy
            </button>
          </>
        )}
        <button type="button" onClick={readAgain}>
          Read the file again
        </button>
      </div>
    </div>
  );
}

export function PairsFile({ list }: { list: OpenList }) {
  const copied = useSignal<'done' | 'impossible' | null>(null);
  const saveCopy = async () => {
    const toml = await list.copy();
    if (toml !== null) offer(toml, fileName(list));
    copied.value = toml === null ? 'impossible' : 'done';
  };
  const { past, future } = list.history.value;
  const isUnsaved = list.isUnsaved.value;
  return (
    <section class="part pairs-file">
      <div class="row">
        <Choice list={list} />
        <span class={isUnsaved ? 'unsaved' : 'hint'} role="status">
          {list.isSaving.value ? 'saving…' : isUnsaved ? '● not saved' : list.isLoaded.value ? 'saved' : ''}
        </span>
      </div>
      {list.isLoaded.value && (
        <>
          <ProgressLine list={list} />
          <div class="row">
            <button
              type="button"
              class={isUnsaved ? 'primary' : ''}
              title="Write the list to its file (Ctrl+S)"
              disabled={list.isSaving.value}
              onClick={() => void list.save()}
            >
              Save
            </button>
            <button
              type="button"
              title="The list as a download. Its paths are relative to the folder of the list: put the copy there"
              onClick={saveCopy}
            >
              Save a copy
            </button>
            <span class="choice">
              <button
                type="button"
                aria-label="Undo"
                title="Undo (U)"
                disabled={past.length === 0}
                onClick={() => list.undo()}
              >
                ↶
              </button>
              <button
                type="button"
                aria-label="Redo"
                title="Redo (Shift+U)"
                disabled={future.length === 0}
                onClick={() => list.redo()}
              >
                ↷
              </button>
            </span>
          </div>
        </>
      )}
      {copied.value === 'impossible' && (
        <ProblemNote
          problem={{
            message: 'There is no copy to be had: the text of the list is made by the program.',
            hint: 'What was changed since it ended is on this page only: start strut view again and repeat it there.',
          }}
        />
      )}
      <Trouble list={list} saveCopy={() => void saveCopy()} />
    </section>
  );
}
