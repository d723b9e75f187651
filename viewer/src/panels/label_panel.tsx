// SPDX-License-Identifier: MIT
// Labelling Effort: who labels, which database, then one movement after the other.
import { useEffect, useMemo, useState } from 'preact/hooks';
import { LabelDesk } from '../label/desk';
import { labelServer } from '../label/label_server';
import { problems, session } from '../state/session';
import { actors } from '../state/stage';
import { ProblemNote } from '../ui/problem_note';
import { LabelWork } from './label_work';
import './label_panel.css';

/** The name that was typed, for this tab of the browser alone: in another one somebody else may label. */
const RATER = 'strut.rater';

function raterOfTab(): string {
  try {
    return sessionStorage.getItem(RATER) ?? '';
  } catch {
    return '';
  }
}

function keepRater(name: string): void {
  try {
    sessionStorage.setItem(RATER, name);
  } catch {
    // It is asked for again then.
  }
}

function RaterForm({ onName }: { onName: (name: string) => void }) {
  const [name, setName] = useState('');
  return (
    <form
      class="part"
      onSubmit={(event) => {
        event.preventDefault();
        if (name.trim() !== '') onName(name.trim());
      }}
    >
      <h2>Who labels?</h2>
      <label>
        Your name
        <input
          class="label-name"
          value={name}
          autocomplete="off"
          onInput={(event) => setName(event.currentTarget.value)}
          ref={(input) => input?.focus()}
        />
      </label>
      <p class="hint">
        Your labels are kept under this name. Use the same one next time and you go on where you stopped. You do not see
        what others say, and they do not see what you say.
      </p>
      <button type="submit" class="primary" disabled={name.trim() === ''}>
        Start labelling
      </button>
    </form>
  );
}

function Desk({ database, rater }: { database: string; rater: string }) {
  const desk = useMemo(() => new LabelDesk(labelServer(database), rater), [database, rater]);
  useEffect(() => {
    void desk.open();
    return () => desk.close();
  }, [desk]);
  return <LabelWork desk={desk} />;
}

export function LabelPanel() {
  const databases = session.value?.files.filter((file) => file.kind === 'database') ?? [];
  const [chosen, setChosen] = useState(0);
  const [typed, setTyped] = useState(raterOfTab);
  useEffect(() => {
    actors.value = []; // nothing of another mode is to be seen here
  }, []);
  const database = databases[chosen];
  if (!database) return null;
  const rater = session.value?.rater ?? typed;
  const change = (name: string) => {
    keepRater(name);
    setTyped(name);
  };
  return (
    <div class="label-panel">
      {databases.length > 1 && (
        <label class="part">
          Database
          <select value={chosen} onChange={(event) => setChosen(Number(event.currentTarget.value))}>
            {databases.map((file, i) => (
              <option key={file.id} value={i}>
                {file.name}
              </option>
            ))}
          </select>
        </label>
      )}
      {problems.value.has(database.id) ? (
        <ProblemNote problem={problems.value.get(database.id)!} />
      ) : rater === '' ? (
        <RaterForm onName={change} />
      ) : (
        <>
          <p class="part label-rater">
            <span>
              Rater <strong>{rater}</strong>
            </span>
            {session.value?.rater === undefined && (
              <button type="button" class="plain" onClick={() => change('')}>
                Change
              </button>
            )}
          </p>
          <Desk key={`${database.id} ${rater}`} database={database.id} rater={rater} />
        </>
      )}
    </div>
  );
}
