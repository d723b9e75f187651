// SPDX-License-Identifier: MIT
import { colourOf, dashOf } from '../state/looks';
import { isPlaying, seek } from '../state/playback';
import { type Actor, actors } from '../state/stage';
import { type FigureCell, type FigureRow, figureRows, type Mark, momentOf, shown } from './figure_rows';
import './figures.css';

const MARKS: Record<NonNullable<Mark>, string> = { best: '✓ best', worst: '✗ worst' };

/** Where the figure is at its most extreme; goes there. */
function ExtremeLink({ actor, figure }: FigureCell) {
  const { extreme } = figure;
  if (!extreme) return null;
  const go = () => {
    isPlaying.value = false;
    seek(momentOf(actor, extreme.frame));
  };
  return (
    <button type="button" class="place" onClick={go} title={`Show frame ${extreme.frame} of ${actor.title}`}>
      {extreme.what} {shown(extreme.value)} {extreme.unit}
      {extreme.joint && `, ${extreme.joint}`}, {extreme.time.toFixed(2)} s
    </button>
  );
}

function Cell({ cell }: { cell: FigureCell | null }) {
  if (!cell) return <td>–</td>;
  const { figure, mark } = cell;
  return (
    <td>
      {figure.value === null ? '–' : shown(figure.value)}
      {mark && <span class={mark}> {MARKS[mark]}</span>}
      {figure.note && <span class="note"> {figure.note}</span>}
      <ExtremeLink {...cell} />
    </td>
  );
}

function Row({ name, unit, better, cells }: FigureRow) {
  return (
    <tr>
      <th scope="row">
        {name}
        {unit && ` [${unit}]`}
        {better && cells.length > 1 && <span class="note"> {better} is better</span>}
      </th>
      {cells.map((cell, i) => (
        <Cell key={actors.value[i]!.clip.id} cell={cell} />
      ))}
    </tr>
  );
}

function ClipHeading({ actor }: { actor: Actor }) {
  const line = { stroke: colourOf(actor.colour), 'stroke-dasharray': dashOf(actor.colour).join(' ') };
  return (
    <th scope="col">
      <svg class="line" width="28" height="8" aria-hidden="true">
        <line x1="0" y1="4" x2="28" y2="4" stroke-width="3" {...line} />
      </svg>
      {actor.title}
    </th>
  );
}

/** What was measured of the clips on the stage: a row per figure, a column per clip. */
export function Figures() {
  const rows = figureRows(actors.value);
  if (rows.length === 0) return null;
  return (
    <section class="figures" aria-label="Figures">
      <table>
        <thead>
          <tr>
            <th scope="col">Figure</th>
            {actors.value.map((actor) => (
              <ClipHeading key={actor.clip.id} actor={actor} />
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <Row key={row.name} {...row} />
          ))}
        </tbody>
      </table>
    </section>
  );
}
