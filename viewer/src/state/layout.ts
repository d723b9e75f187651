// SPDX-License-Identifier: MIT
// How the page is divided: widths of the columns, height of the drawer, and which of them are open. On a narrow screen
// the columns lie over the stage, one at a time, and begin closed.
import { signal } from '@preact/signals';
import { remembered } from './remembered';

/** Widths and heights [px]; 0: what fits the screen. */
export const filesWidth = remembered('files-width', 0);
export const controlsWidth = remembered('controls-width', 0);
export const drawerHeight = remembered('drawer-height', 0);

export const showsFiles = remembered('shows-files', true);
export const showsControls = remembered('shows-controls', true);
export const showsDrawer = remembered('shows-drawer', false);

/** Which column lies over the stage of a narrow screen. */
export const overlay = signal<'files' | 'controls' | null>(null);
/** Narrower than this columns lie over the stage [px]; as in app.css. */
export const NARROW = 900;
export const isNarrow = signal(false);

/** Follows the width of the screen until the returned function is called. */
export function watchWidth(): () => void {
  const query = window.matchMedia(`(max-width: ${NARROW}px)`);
  const note = () => {
    isNarrow.value = query.matches;
    overlay.value = null;
  };
  note();
  query.addEventListener('change', note);
  return () => query.removeEventListener('change', note);
}

export function isOpen(column: 'files' | 'controls'): boolean {
  if (isNarrow.value) return overlay.value === column;
  return (column === 'files' ? showsFiles : showsControls).value;
}

/** Opens a column or closes it. */
export function toggle(column: 'files' | 'controls'): void {
  const shows = column === 'files' ? showsFiles : showsControls;
  if (isNarrow.value) overlay.value = overlay.value === column ? null : column;
  else shows.value = !shows.value;
}
