// SPDX-License-Identifier: MIT
// The pointer over the view: where it rests, and clicks that are not the beginning of turning the camera.

/** A pointer that moved farther than this while it was down turned the camera [pixels]. */
const STILL = 4;

export interface PointerListener {
  /** It is at (x, y) from the view's upper left corner; null: it has left, or turns the camera. */
  moved(at: readonly [number, number] | null): void;
  clicked(at: readonly [number, number]): void;
}

/** Listens until the returned function is called. */
export function watchPointer(element: HTMLElement, listener: PointerListener): () => void {
  let down: readonly [number, number] | null = null;
  const stop = new AbortController();
  const on = (
    type: 'pointermove' | 'pointerdown' | 'pointerup' | 'pointerleave',
    then: (event: PointerEvent) => void,
  ) => element.addEventListener(type, then, { signal: stop.signal });
  on('pointermove', (event) => listener.moved(event.buttons ? null : [event.offsetX, event.offsetY]));
  on('pointerleave', () => listener.moved(null));
  on('pointerdown', (event) => {
    down = event.button === 0 ? [event.offsetX, event.offsetY] : null;
  });
  on('pointerup', (event) => {
    const isClick = down && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) <= STILL;
    if (isClick) listener.clicked([event.offsetX, event.offsetY]);
    down = null;
  });
  return () => stop.abort();
}
