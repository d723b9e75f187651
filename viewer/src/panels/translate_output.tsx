// SPDX-License-Identifier: MIT
// What becomes of the result: saved as BVH, or its command taken to a terminal; and one step back or forth.
import { useSignal } from '@preact/signals';
import * as translating from '../translate/translating';
import { download } from '../ui/download';
import { UndoRedo } from '../ui/undo_redo';

const { canRedo, canUndo, result, settings } = translating;

async function save(): Promise<void> {
  try {
    const { name, content } = await translating.fileOf(settings.peek());
    download(name, content);
  } catch (error) {
    translating.tellProblem(error);
  }
}

export function TranslateOutput() {
  const command = useSignal('');
  const isCopied = useSignal(false);
  const copy = async () => {
    isCopied.value = false;
    try {
      command.value = (await translating.commandOf(settings.peek())).command;
    } catch (error) {
      return translating.tellProblem(error);
    }
    // Where the browser does not allow it, the command stands there to be copied by hand.
    isCopied.value = await navigator.clipboard.writeText(command.value).then(
      () => true,
      () => false,
    );
  };
  return (
    <section class="part translate-output">
      <div class="row head">
        <h2>Result</h2>
        <UndoRedo
          undo={{ keys: 'Ctrl+Z', isPossible: canUndo.value, action: translating.undo }}
          redo={{ keys: 'Ctrl+Shift+Z', isPossible: canRedo.value, action: translating.redo }}
        />
      </div>
      <div class="row">
        <button type="button" class="primary" disabled={!result.value} onClick={() => void save()}>
          Save as BVH
        </button>
        <button type="button" disabled={!result.value} onClick={() => void copy()}>
          Copy command
        </button>
      </div>
      {command.value && (
        <>
          <p class="hint" role="status">
            {isCopied.value ? 'Copied:' : 'The command that writes the same file:'}
          </p>
          <code class="translate-command">{command.value}</code>
        </>
      )}
    </section>
  );
}
