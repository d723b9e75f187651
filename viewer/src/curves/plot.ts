// SPDX-License-Identifier: MIT
// One chart drawn by uPlot: the lines, a grid and the value axis. What moves (the moment, the loop) lies over it in
// elements of its own, so that nothing is drawn again for it.
import 'uplot/dist/uPlot.min.css';
import uPlot from 'uplot';
import { colourOf, dashOf } from '../state/looks';
import type { Line } from './lines';

/** Room beside the lines, the same in all charts so that moments lie above each other [px]; as in curves.css. */
export const AXIS_WIDTH = 60;
export const RIGHT_EDGE = 14;
const TIME_AXIS_HEIGHT = 20;
const FONT = '12px system-ui, sans-serif';

/** A colour of style.css as a canvas takes it. */
function colour(name: string, within: HTMLElement): string {
  const probe = document.createElement('i');
  probe.style.color = name;
  within.append(probe);
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}

export interface PlotSettings {
  place: HTMLElement;
  width: number;
  height: number;
  times: readonly number[];
  lines: readonly Line[];
  hasTimeAxis: boolean;
  /** From and to on the clock [s]; asked whenever it is drawn. */
  shown: () => readonly [number, number];
  onZoom: (stretch: readonly [number, number]) => void;
}

function axes({ place, hasTimeAxis }: PlotSettings): uPlot.Axis[] {
  const text = colour('var(--soft)', place);
  const rule = { stroke: colour('var(--rule)', place), width: 1 };
  const common = { stroke: text, grid: rule, ticks: { ...rule, size: 4 }, font: FONT };
  const seconds: uPlot.Axis = hasTimeAxis
    ? { ...common, size: TIME_AXIS_HEIGHT, gap: 2 }
    : { ...common, size: 0, values: (_, splits) => splits.map(() => '') };
  return [seconds, { ...common, size: AXIS_WIDTH, space: 24 }];
}

function series({ place, lines }: PlotSettings): uPlot.Series[] {
  return lines.map(({ actor }) => {
    const dash = dashOf(actor.colour);
    return {
      stroke: colour(colourOf(actor.colour), place),
      width: 1.8,
      points: { show: false },
      ...(dash.length > 0 && { dash: [...dash] }),
    };
  });
}

function options(settings: PlotSettings): uPlot.Options {
  const { width, height, shown, onZoom } = settings;
  return {
    width,
    height,
    pxAlign: false, // slow slopes are no stairs
    padding: [6, RIGHT_EDGE, settings.hasTimeAxis ? 0 : 6, 0],
    legend: { show: false },
    cursor: {
      x: false,
      y: false,
      points: { show: false },
      drag: { x: true, y: false, setScale: false, dist: 4 },
      bind: { dblclick: () => null }, // chart.tsx listens itself
    },
    scales: { x: { time: false, range: () => [...shown()] } },
    series: [{}, ...series(settings)],
    axes: axes(settings),
    hooks: {
      setSelect: [
        (plot) => {
          if (plot.select.width < 4) return;
          const from = plot.posToVal(plot.select.left, 'x');
          onZoom([from, plot.posToVal(plot.select.left + plot.select.width, 'x')]);
          plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        },
      ],
    },
  };
}

export function makePlot(settings: PlotSettings): uPlot {
  const data = [settings.times, ...settings.lines.map((line) => line.values)] as uPlot.AlignedData;
  return new uPlot(options(settings), data, settings.place);
}
