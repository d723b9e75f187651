// SPDX-License-Identifier: MIT
// When the feet of every clip on the stage stand: the left foot's bars filled, the right foot's outlined, below the charts
// and on their clock.
import { useComputed } from '@preact/signals';
import { type Actor, actors } from '../state/stage';
import { Swatch } from '../ui/swatch';
import { plantsOnClock } from './on_clock';
import { shown } from './view';

const FEET = ['left', 'right'] as const;

function Bars({ actor, foot }: { actor: Actor; foot: 0 | 1 }) {
  const path = useComputed(() =>
    plantsOnClock(actor, foot)
      .map(([from, to]) => `M${from} .08H${Math.max(to, from + 0.01)}V.92H${from}z`)
      .join(''),
  ).value;
  const [begin, end] = shown();
  const side = FEET[foot];
  return (
    <div class={`bars ${side}`}>
      <b title={`${side} foot`}>{side === 'left' ? 'L' : 'R'}</b>
      <svg
        role="img"
        aria-label={`When the ${side} foot of ${actor.title} stands`}
        viewBox={`${begin} 0 ${end - begin} 1`}
        preserveAspectRatio="none"
      >
        <path d={path} vector-effect="non-scaling-stroke" />
      </svg>
    </div>
  );
}

export function PlantStrip() {
  const withFeet = actors.value.filter((actor) => actor.clip.header.plants.length > 0);
  if (withFeet.length === 0) return null;
  return (
    <section class="plant-strip" aria-label="Footplants">
      {withFeet.map((actor) => (
        <div key={actor.clip.id} class="clip-plants" title={`Footplants of ${actor.title}`}>
          <Swatch number={actor.colour} />
          <Bars actor={actor} foot={0} />
          <Bars actor={actor} foot={1} />
        </div>
      ))}
    </section>
  );
}
