// SPDX-License-Identifier: MIT
import { isPlaying, seek } from '../state/playback';
import { actors } from '../state/stage';
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

function Cell(cell: FigureCell) {
  const { actor, figure, mark } = cell;
  return (
    <tr>
      <th scope="row" class={`clip clip-${actor.colour % 6}`}>
        {actor.title}
      </th>
      <td>
        {figure.value === null ? '–' : shown(figure.value)}
        {mark && <span class={mark}> {MARKS[mark]}</span>}
        <ExtremeLink {...cell} />
        {figure.note && <p class="note">{figure.note}</p>}
      </td>
    </tr>
  );
}

function Row({ name, unit, better, cells }: FigureRow) {
  return (
    <tbody>
      <tr>
        <th scope="rowgroup" colSpan={2}>
          {name}
          {unit && ` [${unit}]`}
          {better && cells.length > 1 && <span class="better"> {better} is better</span>}
        </th>
      </tr>
      {cells.map((cell) => (
        <Cell key={cell.actor.clip.id} {...cell} />
      ))}
    </tbody>
  );
}

/** What was measured of the clips on the stage, figure by figure. */
export function Figures() {
  const rows = figureRows(actors.value);
  if (rows.length === 0) return null;
  return (
    <section class="figures">
      <h2>Figures</h2>
      <table>
        {rows.map((row) => (
          <Row key={row.name} {...row} />
        ))}
      </table>
    </section>
  );
}
