// SPDX-License-Identifier: MIT
// Everything is labelled: how well the rater repeats, and what can be done with the labels.
import type { LabelDesk } from '../label/desk';
import { factorInfo } from '../label/factors';
import type { Consistency } from '../label/types';
import { session } from '../state/session';

function Repeats({ consistency }: { consistency: Consistency }) {
  if (consistency.repeats === 0) return <p>There were too few movements to show any of them twice.</p>;
  return (
    <>
      <p>
        {consistency.repeats} movements were shown a second time without telling. So far apart were your two ratings of
        them, on the average (of at most 2):
      </p>
      <table>
        <thead>
          <tr>
            <th>Factor</th>
            <th class="number">apart</th>
            <th class="number">rated twice</th>
          </tr>
        </thead>
        <tbody>
          {consistency.factors.map(({ factor, compared, meanDifference }) => (
            <tr key={factor}>
              <td>{factorInfo(factor).name}</td>
              <td class="number">{meanDifference.toFixed(2)}</td>
              <td class="number">{compared}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </>
  );
}

export function LabelFinished({ desk }: { desk: LabelDesk }) {
  const { done, consistency } = desk.progress.value!;
  const database = session.value?.files.find((file) => file.kind === 'database');
  return (
    <section class="part label-finished">
      <h2>Everything is labelled</h2>
      <p>All {done} labels are in the database. Thank you.</p>
      {consistency && <Repeats consistency={consistency} />}
      <p>All raters' labels as a table, and a model of them:</p>
      <pre>strut effort labels {database?.name} --export labels.csv</pre>
      <pre>strut effort learn {database?.name} -o moves.struteffort</pre>
      <p class="hint">
        <code>strut effort next {database?.name}</code> adds blends whose labels would help most; load this page again
        then.
      </p>
      <button type="button" disabled={desk.doing.value !== null || done === 0} onClick={() => void desk.undo()}>
        Undo the last label <kbd>u</kbd>
      </button>
    </section>
  );
}
