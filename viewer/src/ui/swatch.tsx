// SPDX-License-Identifier: MIT
import { colourOf, dashOf } from '../state/looks';

/** The colour and line pattern of a clip (Actor.colour); an empty place for a clip that is not shown. */
export function Swatch({ number }: { number: number | undefined }) {
  return (
    <svg class="swatch" viewBox="0 0 26 8" width="26" height="8" aria-hidden="true">
      {number !== undefined && (
        <line
          x1="0"
          x2="26"
          y1="4"
          y2="4"
          stroke={colourOf(number)}
          stroke-width="4"
          stroke-dasharray={dashOf(number).join(' ')}
        />
      )}
    </svg>
  );
}
