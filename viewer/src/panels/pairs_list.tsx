// SPDX-License-Identifier: MIT
// The pairs of a list, sorted and filtered. Only rows in sight are made: a list may hold thousands.
import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { factsOf, type Kind } from '../pairs/facts';
import type { OpenList } from '../pairs/open_list';
import { EVERYTHING, type SortKey, type Wish } from '../pairs/order';
import { isCut, type Pair, type Side, type Verdict } from '../pairs/pair';
import { nameOf } from '../state/names';
import { useSize } from '../ui/use_size';
import { PairsAdd } from './pairs_add';

/** As in pairs.css [px]. */
const ROW = 44;
const SPARE_ROWS = 4;

const SORTS: readonly (readonly [SortKey, string])[] = [
  ['list', 'list order'],
  ['distance', 'by distance'],
  ['kind', 'by kind'],
  ['input', 'by input clip'],
  ['output', 'by output clip'],
];
const KINDS: readonly (Kind | 'any')[] = ['any', 'left cycle', 'right cycle', 'whole', 'other'];
const SIGNS: Record<Verdict, string> = { none: '·', accepted: '✓', rejected: '✗' };

function Filters({ list }: { list: OpenList }) {
  const wish = list.wish.value;
  const set = (more: Partial<Wish>) => {
    list.wish.value = { ...wish, ...more };
  };
  return (
    <div class="pairs-filters">
      <select
        aria-label="Order"
        value={wish.sort}
        onChange={(event) => set({ sort: event.currentTarget.value as SortKey })}
      >
        {SORTS.map(([key, title]) => (
          <option key={key} value={key}>
            {title}
          </option>
        ))}
      </select>
      <select
        aria-label="Kind"
        value={wish.kind}
        onChange={(event) => set({ kind: event.currentTarget.value as Wish['kind'] })}
      >
        {KINDS.map((kind) => (
          <option key={kind} value={kind}>
            {kind === 'any' ? 'any kind' : kind}
          </option>
        ))}
      </select>
      <input
        type="search"
        placeholder="clip"
        aria-label="Clip"
        value={wish.clip}
        onInput={(event) => set({ clip: event.currentTarget.value })}
      />
      <label>
        <input
          type="checkbox"
          checked={wish.onlyOpen}
          onChange={(event) => set({ onlyOpen: event.currentTarget.checked })}
        />
        to look at
      </label>
    </div>
  );
}

function sideInWords(side: Side): string {
  return `${nameOf(side.clip)} ${side.frames ? `${side.frames[0]}–${side.frames[1]}` : 'whole'}`;
}

function Row({ pair, list, place }: { pair: Pair; list: OpenList; place: number }) {
  const { kind, distance } = factsOf(pair.comment);
  const isSelected = pair.id === list.selected.value;
  return (
    <div
      id={`pair-${pair.id}`}
      class={`pair-row ${pair.verdict}`}
      style={{ top: `${place * ROW}px` }}
      role="option"
      aria-selected={isSelected}
      aria-label={`pair ${pair.id + 1}, ${kind}, ${pair.verdict === 'none' ? 'not looked at' : pair.verdict}`}
      tabIndex={-1}
      onPointerDown={() => {
        list.selected.value = pair.id;
      }}
    >
      <span class="sign" aria-hidden="true">
        {SIGNS[pair.verdict]}
      </span>
      <span class="what">
        <b class="number">{pair.id + 1}</b> {pair.proposed === null ? 'added' : kind !== 'other' && kind}
        {isCut(pair) && <em> cut anew</em>}
        {distance !== null && <span class="number distance">{distance.toFixed(2)}</span>}
      </span>
      <span class="clips" title={`${sideInWords(pair.input)} with ${sideInWords(pair.output)}`}>
        {sideInWords(pair.input)} → {sideInWords(pair.output)}
      </span>
    </div>
  );
}

export function PairsList({ list }: { list: OpenList }) {
  const box = useRef<HTMLDivElement>(null);
  const top = useSignal(0);
  const height = useSize(box, 'height');
  const shown = list.shown.value;
  const at = shown.findIndex((pair) => pair.id === list.selected.value);
  useEffect(() => {
    const element = box.current!;
    if (at < 0) return;
    if (at * ROW < element.scrollTop) element.scrollTop = at * ROW;
    const below = (at + 1) * ROW - element.clientHeight;
    if (below > element.scrollTop) element.scrollTop = below;
  }, [at, list]);
  // A list that has become shorter is scrolled back by the browser, which tells it only later.
  const from = Math.max(0, Math.min(top.value, shown.length * ROW - height.value));
  const first = Math.max(0, Math.floor(from / ROW) - SPARE_ROWS);
  const last = Math.ceil((from + height.value) / ROW) + SPARE_ROWS;
  return (
    <section class="part pairs-list">
      <Filters list={list} />
      <div
        class="rows"
        ref={box}
        role="listbox"
        tabIndex={0}
        aria-label="Pairs"
        aria-activedescendant={at < 0 ? undefined : `pair-${list.selected.value}`}
        onScroll={(event) => {
          top.value = event.currentTarget.scrollTop;
        }}
      >
        <div style={{ height: `${shown.length * ROW}px` }} />
        {shown.slice(first, last).map((pair, i) => (
          <Row key={pair.id} pair={pair} list={list} place={first + i} />
        ))}
      </div>
      {shown.length === 0 && (
        <p class="hint">
          No pair fits.{' '}
          <button
            type="button"
            onClick={() => {
              list.wish.value = EVERYTHING;
            }}
          >
            Show all
          </button>
        </p>
      )}
      <PairsAdd list={list} />
    </section>
  );
}
