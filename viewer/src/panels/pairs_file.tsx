// SPDX-License-Identifier: MIT
// The list as a file: which one, how far a person has come with it, saving, a copy, undo.
import { useSignal } from '@preact/signals';
import type { OpenList } from '../pairs/open_list';
import { progressOf } from '../pairs/pair';
import { openList, pairFiles } from '../pairs/showing';
import { download } from '../ui/download';
import { ProblemNote } from '../ui/problem_note';
import { UndoRedo } from '../ui/undo_redo';

const START_AGAIN = 'Start strut view again on the same files and open the address it prints; ';
/** What a copy lacks that was made while the program does not answer: it is the program that writes the text. */
const LACKS = {
  last: {
    message: 'The copy lacks what was changed last: the program ended before it had written that down.',
    hint: `${START_AGAIN}what the copy lacks has to be done again there.`,
  },
  everything: {
    message: 'No copy can be made: the text of the list is written by the program, which does not answer.',
    hint: `${START_AGAIN}what is not saved here has to be done again there.`,
  },
};

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
  const lacks = useSignal<keyof typeof LACKS | null>(null);
  const saveCopy = async () => {
    const copy = await list.copy();
    if (copy) download(fileName(list), new Blob([copy.toml], { type: 'application/toml' }));
    lacks.value = copy === null ? 'everything' : copy.isWhole ? null : 'last';
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
            <UndoRedo
              undo={{ keys: 'U', isPossible: past.length > 0, action: () => list.undo() }}
              redo={{ keys: 'Shift+U', isPossible: future.length > 0, action: () => list.redo() }}
            />
          </div>
        </>
      )}
      {lacks.value && <ProblemNote problem={LACKS[lacks.value]} />}
      <Trouble list={list} saveCopy={() => void saveCopy()} />
    </section>
  );
}
