// SPDX-License-Identifier: MIT
// Which moments of the clips on the stage belong to those of the reference: asked of the program when the clips are to be
// kept in step by it, once for every two clips.
import { signal } from '@preact/signals';
import type { Alignment } from '../data/source';
import { SourceError } from '../data/source';
import type { Problem } from '../data/types';
import { problemOf, source } from './session';
import { type Actor, alignments } from './stage';

/** What became of aligning a clip with the reference. */
export type Aligning =
  | { state: 'waiting' }
  | { state: 'done'; alignment: Alignment }
  | { state: 'refused'; problem: Problem };

/** By clip id, for the clips on the stage other than the reference. */
export const alignings = signal<ReadonlyMap<string, Aligning>>(new Map());

const asked = new Map<string, Promise<Aligning>>();
/** Tells apart what was asked for last from what comes too late. */
let latest = 0;

/** Fills what has no moment with what lies between its neighbours; what comes before all, or after, with the nearest. */
export function withoutHoles(moments: Float32Array): Float32Array {
  const known = [...moments.keys()].filter((i) => Number.isFinite(moments[i]));
  if (known.length === moments.length || known.length === 0) return known.length === 0 ? new Float32Array() : moments;
  const filled = moments.slice();
  filled.fill(moments[known[0]!]!, 0, known[0]);
  filled.fill(moments[known.at(-1)!]!, known.at(-1)! + 1);
  for (let k = 1; k < known.length; ++k) {
    const from = known[k - 1]!;
    const to = known[k]!;
    for (let i = from + 1; i < to; ++i) {
      filled[i] = moments[from]! + ((i - from) / (to - from)) * (moments[to]! - moments[from]!);
    }
  }
  return filled;
}

async function ask(reference: string, clip: string): Promise<Aligning> {
  try {
    return { state: 'done', alignment: await source.value!.alignment(reference, clip) };
  } catch (error) {
    if (error instanceof SourceError && error.isUnanswered) asked.delete(`${reference} ${clip}`);
    return { state: 'refused', problem: problemOf(error) };
  }
}

function askOnce(reference: string, clip: string): Promise<Aligning> {
  const key = `${reference} ${clip}`;
  const answer = asked.get(key) ?? ask(reference, clip);
  asked.set(key, answer);
  return answer;
}

/** Shows what is known, to the person and to the clock. */
function tell(known: ReadonlyMap<string, Aligning>): void {
  alignings.value = known;
  alignments.value = new Map(
    [...known].flatMap(([id, aligning]) =>
      aligning.state === 'done' ? [[id, withoutHoles(aligning.alignment.moments)] as const] : [],
    ),
  );
}

/** Aligns all with the first. What comes after the stage has changed again is kept for later, not shown. */
export async function alignWithFirst([first, ...others]: readonly Actor[]): Promise<void> {
  const mine = ++latest;
  const ids = others.map((actor) => actor.clip.id);
  const waiting = (id: string): readonly [string, Aligning] => [id, { state: 'waiting' }];
  let known: ReadonlyMap<string, Aligning> = new Map(ids.map(waiting));
  tell(known);
  for (const id of ids) {
    const aligning = await askOnce(first!.clip.id, id);
    if (mine !== latest) return;
    known = new Map(known).set(id, aligning);
    tell(known);
  }
}

/** Forgets which moments belong to which, e.g. because clips are in step by something else. */
export function stopAligning(): void {
  ++latest;
  tell(new Map());
}
