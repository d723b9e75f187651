// SPDX-License-Identifier: MIT
// The edge of a part of the page that can be dragged, or moved by arrow keys; a double click gives it back to the page.
import type { Signal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import './splitter.css';

interface Props {
  /** The size it sets [px]; 0: what fits the screen. */
  size: Signal<number>;
  /** On which side of the part it lies; the part grows when it is dragged there. */
  side: 'left' | 'right' | 'top';
  label: string;
  least: number;
}

const KEY_STEP = 24;
/** The part's largest share of the screen. */
const MOST = 0.6;

/** Which key moves it away from the part, and which back. */
const KEYS = {
  left: ['ArrowLeft', 'ArrowRight'],
  right: ['ArrowRight', 'ArrowLeft'],
  top: ['ArrowUp', 'ArrowDown'],
} as const;

export function Splitter({ size, side, label, least }: Props) {
  const handle = useRef<HTMLDivElement>(null);
  const isAcross = side === 'top';
  const part = () => handle.current!.parentElement!.getBoundingClientRect();
  const set = (to: number) => {
    const most = MOST * (isAcross ? window.innerHeight : window.innerWidth);
    size.value = Math.round(Math.min(Math.max(to, least), most));
  };
  const onPointerMove = (event: PointerEvent) => {
    if (!handle.current!.hasPointerCapture(event.pointerId)) return;
    const { left, right, bottom } = part();
    set(isAcross ? bottom - event.clientY : side === 'right' ? event.clientX - left : right - event.clientX);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const direction = KEYS[side].indexOf(event.key as never);
    if (direction < 0) return;
    event.preventDefault();
    set((isAcross ? part().height : part().width) + (direction === 0 ? KEY_STEP : -KEY_STEP));
  };
  return (
    // biome-ignore lint/a11y/useSemanticElements: a rule cannot be moved
    <div
      ref={handle}
      class={`splitter ${side}`}
      role="separator"
      tabIndex={0}
      aria-label={label}
      aria-orientation={isAcross ? 'horizontal' : 'vertical'}
      aria-valuenow={size.value}
      title={`${label}: drag; double click to reset`}
      onPointerDown={(event) => handle.current!.setPointerCapture(event.pointerId)}
      onPointerMove={onPointerMove}
      onKeyDown={onKeyDown}
      onDblClick={() => {
        size.value = 0;
      }}
    />
  );
}
