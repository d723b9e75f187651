// SPDX-License-Identifier: MIT
// The selected pair: what it was matched by, the verdict, and what is to be doubted.
import { factsOf } from '../pairs/facts';
import type { OpenList } from '../pairs/open_list';
import { isCut, type Pair, SIDES } from '../pairs/pair';
import { rangeOf, remarks, shownClips } from '../pairs/showing';
import { fullNameOf } from '../state/names';
import { ProblemNote } from '../ui/problem_note';
import { Swatch } from '../ui/swatch';

function duration(pair: Pair, side: (typeof SIDES)[number]): string {
  const range = rangeOf(pair[side]);
  const clip = shownClips.value?.clips[side];
  return range && clip ? ((range[1] - range[0]) / clip.header.frameRate).toFixed(2) : '';
}

function Facts({ pair }: { pair: Pair }) {
  const { facts, distance, kind } = factsOf(pair.comment);
  const frames = (side: (typeof SIDES)[number]) => {
    const range = rangeOf(pair[side]);
    return range ? `${range[0]}–${range[1]}` : '';
  };
  return (
    <table>
      <thead>
        <tr>
          <th>{kind === 'other' ? '' : kind}</th>
          {SIDES.map((side, number) => (
            <th key={side} class="number" title={fullNameOf(pair[side].clip)}>
              {side} <Swatch number={number} />
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        <tr>
          <th>frames</th>
          {SIDES.map((side) => (
            <td key={side} class="number">
              {frames(side)}
            </td>
          ))}
        </tr>
        <tr>
          <th>lasts [s]</th>
          {SIDES.map((side) => (
            <td key={side} class="number">
              {duration(pair, side)}
            </td>
          ))}
        </tr>
        {facts
          .filter(({ name }) => name !== 'duration' || isCut(pair))
          .map(({ name, unit, input, output }) => (
            <tr key={name} class={isCut(pair) ? 'of-before' : ''}>
              <th>
                {isCut(pair) ? 'was: ' : ''}
                {name} [{unit === 'degrees' ? '°' : unit}]
              </th>
              <td class="number">{input}</td>
              <td class="number">{output}</td>
            </tr>
          ))}
        {distance !== null && (
          <tr class={isCut(pair) ? 'of-before' : ''}>
            <th>{isCut(pair) ? 'was: ' : ''}distance</th>
            <td class="number" colSpan={2}>
              {distance.toFixed(2)}
            </td>
          </tr>
        )}
      </tbody>
    </table>
  );
}

export function PairsDetails({ list }: { list: OpenList }) {
  const pair = list.pair.value;
  if (!pair) return null;
  return (
    <section class="part pairs-details" aria-label={`Pair ${pair.id + 1}`}>
      <div class="row verdicts">
        <b class="number">Pair {pair.id + 1}</b>
        <button
          type="button"
          title="Accept and go on (A)"
          aria-pressed={pair.verdict === 'accepted'}
          onClick={() => list.judge('accepted')}
        >
          ✓ Accept
        </button>
        <button
          type="button"
          title="Reject and go on (R)"
          aria-pressed={pair.verdict === 'rejected'}
          onClick={() => list.judge('rejected')}
        >
          ✗ Reject
        </button>
      </div>
      <Facts pair={pair} />
      {factsOf(pair.comment).kind === 'other' && pair.comment && <p class="hint comment">{pair.comment}</p>}
      {remarks.value.map((problem) => (
        <ProblemNote key={problem.message} problem={problem} />
      ))}
    </section>
  );
}
