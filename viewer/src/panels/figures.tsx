// SPDX-License-Identifier: MIT
import type { Extreme, Figure } from '../data/types';
import { isPlaying, seek } from '../state/playback';
import { actors } from '../state/stage';
import { FileName } from '../ui/file_name';
import { Swatch } from '../ui/swatch';
import { type FigureCell, type FigureRow, figureRows, type Mark, momentOf, shown } from './figure_rows';
import './figures.css';

const MARKS: Record<NonNullable<Mark>, string> = { best: '✓ best', worst: '✗ worst' };

/** Numbers and their units stay in one line. The figure itself is not said twice. */
function told(figure: Figure, { what, value, unit, joint, time }: Extreme): string {
  const size = value === figure.value ? '' : ` ${shown(value)}\u00a0${unit},`;
  return `${what}${size}${joint ? ` ${joint},` : ''} ${time.toFixed(2)}\u00a0s`;
}

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
      {told(figure, extreme)}
    </button>
  );
}

function Cell(cell: FigureCell) {
  const { actor, figure, mark } = cell;
  return (
    <tr>
      <th scope="row" title={actor.clip.name}>
        <Swatch number={actor.colour} />{' '}
        <span class="clip">
          <FileName name={actor.title} />
        </span>
      </th>
      <td>
        <strong>{figure.value === null ? '–' : shown(figure.value)}</strong>
        {mark && <span class={mark}> {MARKS[mark]}</span>}
        {figure.note && <span class="note"> {figure.note}</span>}
        <ExtremeLink {...cell} />
      </td>
    </tr>
  );
}

function Row({ name, unit, better, cells }: FigureRow) {
  const known = cells.filter((cell) => cell !== null);
  return (
    <tbody>
      <tr>
        <th scope="rowgroup" colSpan={2}>
          {name}
          {unit && ` [${unit}]`}
          {better && known.length > 1 && <span class="note"> {better} is better</span>}
        </th>
      </tr>
      {known.map((cell) => (
        <Cell key={cell.actor.clip.id} {...cell} />
      ))}
    </tbody>
  );
}

/** What was measured of the clips on the stage, figure by figure, so that any number of clips fits a narrow column. */
export function Figures() {
  const rows = figureRows(actors.value);
  if (rows.length === 0) return null;
  return (
    <section class="part figures" aria-label="Figures">
      <h2>Figures</h2>
      <table>
        {rows.map((row) => (
          <Row key={row.name} {...row} />
        ))}
      </table>
    </section>
  );
}
