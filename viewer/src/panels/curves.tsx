// SPDX-License-Identifier: MIT
// Curves of the clips on the stage, one above the other on one clock, with the footplants below and a list to choose from.
import './curves.css';
import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { Chart } from '../curves/chart';
import { drawn } from '../curves/chosen';
import { Picker } from '../curves/picker';
import { PlantStrip } from '../curves/plant_strip';
import { stretch, zoomOut } from '../curves/view';
import { actors, step } from '../state/stage';
import { written } from '../state/ticks';

/** A chart's least height, and what stands above it; as in curves.css [px]. */
const LEAST_HEIGHT = 84;
const CAPTION = 28;

/** What the time axis tells: whose time it is. What the others follow is said where that is chosen. */
function timeTitle(): string {
  const [first, ...others] = actors.value;
  return others.length === 0 || step.value === 'time' ? 'time [s]' : `time of ${first!.title} [s]`;
}

/** Light or dark, as the screen is. */
function useScheme(): string {
  const scheme = useSignal('');
  useEffect(() => {
    const query = window.matchMedia('(prefers-color-scheme: dark)');
    const note = () => {
      scheme.value = query.matches ? 'dark' : 'light';
    };
    note();
    query.addEventListener('change', note);
    return () => query.removeEventListener('change', note);
  }, [scheme]);
  return scheme.value;
}

function Charts() {
  const place = useRef<HTMLDivElement>(null);
  const size = useSignal({ width: 0, height: 0 });
  const scheme = useScheme();
  useEffect(() => {
    const watch = new ResizeObserver(() => {
      const { clientWidth: width, clientHeight: height } = place.current!;
      if (width !== size.peek().width || height !== size.peek().height) size.value = { width, height };
    });
    watch.observe(place.current!);
    return () => watch.disconnect();
  }, [size]);
  const { width, height } = size.value;
  const each = Math.max(LEAST_HEIGHT, Math.floor(height / Math.max(drawn.value.length, 1)) - CAPTION);
  const last = drawn.value.at(-1);
  return (
    <div class="charts" ref={place}>
      {width > 0 &&
        actors.value.length > 0 &&
        drawn.value.map((curve) => (
          <Chart
            key={curve.name}
            curve={curve}
            width={width}
            height={each}
            timeTitle={curve === last ? timeTitle() : undefined}
            scheme={scheme}
          />
        ))}
      {drawn.value.length === 0 && <p class="hint">Tick curves in the list to draw them here.</p>}
    </div>
  );
}

function ZoomNote() {
  if (!stretch.value) return null;
  const [from, to] = stretch.value;
  return (
    <button type="button" class="zoom-note" onClick={zoomOut} title="Show everything (or double click a chart)">
      {written(from)}–{written(to)} s, show all
    </button>
  );
}

export function Curves() {
  return (
    <div class="curves">
      <Picker />
      <div class="drawn">
        <Charts />
        <PlantStrip />
        <ZoomNote />
      </div>
    </div>
  );
}
