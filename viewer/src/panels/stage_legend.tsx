// SPDX-License-Identifier: MIT
// What the signs on the stage mean: left and right, the grid, and the scale of footskate.
import { drawing } from '../scene/drawing';
import { FASTEST, LARGEST, SMALLEST, slideGradient } from '../scene/slide_scale';
import { actors, showsGrid, showsSlide } from '../state/stage';

const TICKS = [0, 5, 10, 20] as const;

/** A left bone is round and plain, a right one angular with bands. */
function SideKey() {
  return (
    <p>
      <svg class="bone" viewBox="0 0 44 14" aria-hidden="true">
        <ellipse cx="22" cy="7" rx="21" ry="5.5" fill="var(--left)" />
      </svg>
      left
      <svg class="bone" viewBox="0 0 44 14" aria-hidden="true">
        <path d="M1 7 11 1 43 5.5V8.5L11 13Z" fill="var(--right)" />
        <path d="M18 2.2 22 2.8V11.2L18 11.8ZM27 3.4 31 4V10L27 10.6Z" fill="#0009" />
      </svg>
      right
    </p>
  );
}

function SlideKey() {
  const isMeasured = actors.value.some(({ clip }) => clip.slide.length > 0);
  if (!isMeasured) return <p>Footskate was not measured in these clips.</p>;
  const largest = 9;
  return (
    <figure class="slide-key" aria-label="Scale of footskate">
      <figcaption>Feet that stand slide by (cm/s)</figcaption>
      <div class="slide-bar" style={{ background: slideGradient() }} />
      <div class="slide-ticks">
        {TICKS.map((tick) => {
          const share = tick / (100 * FASTEST);
          const size = 2 * largest * (SMALLEST / LARGEST + share * (1 - SMALLEST / LARGEST));
          return (
            <span key={tick} style={{ left: `${100 * share}%` }}>
              <i style={{ width: `${size}px`, height: `${size}px` }} />
              {tick}
              {tick === TICKS.at(-1) && '+'}
            </span>
          );
        })}
      </div>
    </figure>
  );
}

export function StageLegend() {
  if (actors.value.length === 0) return null;
  return (
    <div class="stage-legend">
      {showsSlide.value && <SlideKey />}
      <SideKey />
      {showsGrid.value && <p>{drawing.value.fineGrid ? 'Grid 1 m, fine lines 10 cm' : 'Grid 1 m'}</p>}
    </div>
  );
}
