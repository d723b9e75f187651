// SPDX-License-Identifier: MIT
// A chart of one curve: what it is, each clip's value at the moment, and the lines. Hovering shows that moment on the
// stage.
import { effect, useComputed, useSignalEffect } from '@preact/signals';
import type { RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type uPlot from 'uplot';
import type { CurveInfo } from '../data/types';
import { loop, time } from '../state/playback';
import { Icon } from '../ui/icon';
import { Swatch } from '../ui/swatch';
import { ownerOf } from './catalogue';
import { choose } from './chosen';
import { hover, keep, leave } from './hovering';
import { type Line, linesOf } from './lines';
import { times } from './on_clock';
import { makePlot } from './plot';
import { shown, zoomOut, zoomTo } from './view';

/** A press that moved less than this is a click [px]. */
const CLICK = 4;

interface Props {
  curve: CurveInfo;
  width: number;
  height: number;
  /** Set for the chart that has the time axis. */
  timeTitle: string | undefined;
  /** Changes with light and dark, since colours are drawn into the picture. */
  scheme: string;
}

/** A number with as many digits as can be read off a chart. */
function written(value: number): string {
  const size = Math.abs(value);
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

function Legend({ lines, unit }: { lines: readonly Line[]; unit: string }) {
  const list = useRef<HTMLUListElement>(null);
  // The values follow the clock without making the list again.
  useEffect(() => {
    const places = list.current!.querySelectorAll('output');
    const say = (line: Line, at: number) => {
      const value = line.at(at);
      return line.lack ?? (value === null ? '–' : `${written(value)} ${unit}`);
    };
    return effect(() => {
      const now = time.value;
      places.forEach((place, i) => {
        place.textContent = say(lines[i]!, now);
      });
    });
  }, [lines, unit]);
  return (
    <ul class="legend" ref={list}>
      {lines.map(({ actor }) => (
        <li key={actor.clip.id} title={actor.clip.name}>
          <Swatch number={actor.colour} />
          <span class="clip">{actor.title}</span>
          <output aria-live="off" />
        </li>
      ))}
    </ul>
  );
}

/** What lies over the lines and moves: the moment, and the stretch that is played over and over. */
function useOverlay(plot: RefObject<uPlot | null>, over: RefObject<HTMLDivElement | null>): () => void {
  const place = () => {
    const [now, looped] = over.current!.children as unknown as [HTMLElement, HTMLElement];
    const chart = plot.current;
    if (!chart) return;
    const x = (at: number) => chart.valToPos(at, 'x');
    const isInside = x(time.value) >= -0.5 && x(time.value) <= chart.over.clientWidth + 0.5;
    now.style.transform = `translateX(${x(time.value)}px)`;
    now.hidden = !isInside;
    looped.hidden = loop.value === null;
    if (!loop.value) return;
    const [from, to] = loop.value.map((at) => Math.min(Math.max(x(at), 0), chart.over.clientWidth));
    looped.style.left = `${from}px`;
    looped.style.width = `${to! - from!}px`;
  };
  useSignalEffect(place);
  return place;
}

/** Hover, click and leave, on the part of the chart that has the lines. */
function listen(chart: uPlot): void {
  let pressed = 0;
  const moment = (event: PointerEvent) => chart.posToVal(event.clientX - chart.over.getBoundingClientRect().left, 'x');
  chart.over.addEventListener('pointermove', (event) => {
    if (event.buttons === 0) hover(moment(event));
  });
  chart.over.addEventListener('pointerleave', leave);
  chart.over.addEventListener('dblclick', zoomOut);
  chart.over.addEventListener('pointerdown', (event) => {
    pressed = event.clientX;
  });
  chart.over.addEventListener('pointerup', (event) => {
    if (event.button === 0 && Math.abs(event.clientX - pressed) < CLICK) keep(moment(event));
  });
}

function Plot({ lines, ...props }: Omit<Props, 'curve'> & { lines: readonly Line[] }) {
  const place = useRef<HTMLDivElement>(null);
  const over = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const placeOverlay = useOverlay(plot, over);
  const { width, height, scheme } = props;
  const hasTimeAxis = props.timeTitle !== undefined;
  useEffect(() => {
    const view = { shown, onZoom: zoomTo };
    const chart = makePlot({ place: place.current!, width, height, times: times.peek(), lines, hasTimeAxis, ...view });
    plot.current = chart;
    chart.over.append(over.current!);
    listen(chart);
    // Sizes are known after uPlot's own turn.
    queueMicrotask(placeOverlay);
    return () => {
      place.current?.append(over.current!);
      plot.current = null;
      chart.destroy();
    };
  }, [lines, width, height, hasTimeAxis, scheme]);
  useSignalEffect(() => {
    const [min, max] = shown();
    plot.current?.setScale('x', { min, max });
    queueMicrotask(placeOverlay);
  });
  return (
    <div class="plot" ref={place}>
      <div class="over" ref={over}>
        <i class="moment" />
        <i class="looped" />
      </div>
    </div>
  );
}

export function Chart(props: Props) {
  const { curve } = props;
  const owner = ownerOf(curve);
  const lines = useComputed(() => linesOf(curve)).value;
  const title = `${owner}: ${curve.label}${curve.unit && ` [${curve.unit}]`}`;
  return (
    <figure class="chart" aria-label={title}>
      <figcaption>
        <strong>{title}</strong>
        <Legend lines={lines} unit={curve.unit} />
        {props.timeTitle && <span class="time-title">{props.timeTitle} →</span>}
        <button type="button" class="plain" aria-label={`Take away ${title}`} onClick={() => choose(curve, false)}>
          <Icon name="close" />
        </button>
      </figcaption>
      <Plot {...props} lines={lines} />
    </figure>
  );
}
