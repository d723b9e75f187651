// SPDX-License-Identifier: MIT
// One step back and one forth, as a pair of buttons.
interface Step {
  /** The keys that do the same, for the tooltip. */
  keys: string;
  isPossible: boolean;
  action: () => void;
}

function StepButton({ name, sign, step }: { name: string; sign: string; step: Step }) {
  return (
    <button
      type="button"
      aria-label={name}
      title={`${name} (${step.keys})`}
      disabled={!step.isPossible}
      onClick={step.action}
    >
      {sign}
    </button>
  );
}

export function UndoRedo({ undo, redo }: { undo: Step; redo: Step }) {
  return (
    <span class="choice">
      <StepButton name="Undo" sign="↶" step={undo} />
      <StepButton name="Redo" sign="↷" step={redo} />
    </span>
  );
}
