// SPDX-License-Identifier: MIT
// What is wrong with the page as a whole: said once, above everything, with what can be done about it.
import { useSignal } from '@preact/signals';
import { isGone } from '../data/connection';
import { failure, reconnect } from '../state/session';

function Gone() {
  const isTrying = useSignal(false);
  const retry = async () => {
    isTrying.value = true;
    await reconnect();
    isTrying.value = false;
  };
  return (
    <div class="problem">
      <p>
        <b>The program does not answer any more.</b> What the page shows stays, and nothing that was saved is lost. If
        `strut view` has ended, start it again with the same files and open the address it prints.
      </p>
      <button type="button" disabled={isTrying.value} onClick={retry}>
        {isTrying.value ? 'Asking…' : 'Try again'}
      </button>
    </div>
  );
}

function Failure() {
  const { message, hint } = failure.value!;
  return (
    <div class="problem">
      <p>
        <b>{message}</b> {hint}
      </p>
      <button
        type="button"
        onClick={() => {
          failure.value = null;
        }}
      >
        Close
      </button>
    </div>
  );
}

export function FailureBanner() {
  return (
    <div class="failure" role="alert">
      {isGone.value && <Gone />}
      {failure.value && <Failure />}
    </div>
  );
}
