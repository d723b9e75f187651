// SPDX-License-Identifier: MIT
// What one chart draws: a line per clip on the stage, and what the clip's value is at any moment.
import type { CurveInfo } from '../data/types';
import { frameAt } from '../state/playback';
import { type Actor, actors } from '../state/stage';
import { counterpart } from './catalogue';
import { curveOf } from './chosen';
import { endOf, followsAlignment, momentOf, onClock, slopeAt, times, type Values, valueAt } from './on_clock';

export interface Line {
  actor: Actor;
  values: Values;
  /** At a moment of the clock; null where there is none. */
  at: (time: number) => number | null;
  /** Why there is nothing to draw. */
  lack?: string;
}

function without(actor: Actor, lack: string): Line {
  return { actor, values: times.value.map(() => null), at: () => null, lack };
}

function ownLine(curve: CurveInfo, actor: Actor): Line {
  const same = counterpart(curve, actor.clip.header.curves);
  if (!same) return without(actor, 'has no such curve');
  const asked = curveOf(actor.clip, same.name);
  if (asked.state === 'waiting') return without(actor, '…');
  if (asked.state === 'refused') return without(actor, asked.problem.message);
  const at = (time: number) => (time > endOf(actor) + 1e-6 ? null : valueAt(asked.values, frameAt(actor, time)));
  return { actor, values: onClock(asked.values, actor), at };
}

function alignmentLine(curve: CurveInfo, actor: Actor): Line {
  if (!followsAlignment(actor)) return without(actor, 'is not aligned');
  const read = curve.name === 'alignment/moment' ? momentOf : slopeAt;
  const at = (time: number) => read(actor, time);
  return { actor, values: times.value.map(at), at };
}

/** The lines of `curve` for all clips on the stage, with a value at each of `times`. Reads signals. */
export function linesOf(curve: CurveInfo): Line[] {
  const isOfAlignment = curve.name.startsWith('alignment/');
  return actors.value.map((actor) => (isOfAlignment ? alignmentLine : ownLine)(curve, actor));
}
