// SPDX-License-Identifier: MIT
// Which curves a person wants to see, and the numbers they are drawn from.
import { computed, effect, signal } from '@preact/signals';
import type { Clip } from '../data/clip';
import type { CurveInfo, Problem } from '../data/types';
import { problemOf, source } from '../state/session';
import { actors, step } from '../state/stage';
import { ALIGNMENT_CURVES, counterpart } from './catalogue';

const KEY = 'strut.curves';
const AT_FIRST: readonly CurveInfo[] = [
  ...ALIGNMENT_CURVES,
  { name: 'body/speed', joint: '', label: 'speed over the ground', unit: 'm/s' },
];

function kept(): readonly CurveInfo[] {
  try {
    const found: unknown = JSON.parse(sessionStorage.getItem(KEY) ?? 'null');
    return Array.isArray(found) ? (found as CurveInfo[]) : AT_FIRST;
  } catch {
    return AT_FIRST;
  }
}

/** Those a person chose, also of joints that the clips on the stage lack. */
const wanted = signal(kept());
effect(() => {
  try {
    sessionStorage.setItem(KEY, JSON.stringify(wanted.value));
  } catch {
    // It is not kept then; nothing depends on it.
  }
});

/** All that can be chosen now: the curves of the first clip that has any, and of the alignment if there is one. */
export const offered = computed<readonly CurveInfo[]>(() => {
  const ofClip = actors.value.find((actor) => actor.clip.header.curves.length > 0)?.clip.header.curves ?? [];
  const isAligned = step.value === 'alignment' && actors.value.length > 1;
  return isAligned ? [...ALIGNMENT_CURVES, ...ofClip] : ofClip;
});

/** What is drawn: of what a person chose, what there is. */
export const drawn = computed<readonly CurveInfo[]>(() =>
  wanted.value.flatMap((curve) => counterpart(curve, offered.value) ?? []),
);

export function isDrawn(curve: CurveInfo): boolean {
  return drawn.value.some((other) => other.name === curve.name);
}

/** Draws a curve, below the others, or takes it away. */
export function choose(curve: CurveInfo, isOn: boolean): void {
  const others = wanted.value.filter((other) => counterpart(other, offered.value)?.name !== curve.name);
  wanted.value = isOn ? [...others, curve] : others;
}

/** What became of asking for a curve. */
export type Asked =
  | { state: 'waiting' }
  | { state: 'done'; values: Float32Array }
  | { state: 'refused'; problem: Problem };

const answers = new WeakMap<Clip, Map<string, { value: Asked }>>();

/** The curve `name` of a clip, asked for once; tells whoever reads it when it has come. */
export function curveOf(clip: Clip, name: string): Asked {
  const ofClip = answers.get(clip) ?? new Map<string, { value: Asked }>();
  answers.set(clip, ofClip);
  let answer = ofClip.get(name);
  if (!answer) {
    const told = signal<Asked>({ state: 'waiting' });
    answer = told;
    ofClip.set(name, told);
    source.value!.curve(clip.id, name).then(
      (values) => {
        told.value = { state: 'done', values };
      },
      (error: unknown) => {
        ofClip.delete(name);
        told.value = { state: 'refused', problem: problemOf(error) };
      },
    );
  }
  return answer.value;
}
