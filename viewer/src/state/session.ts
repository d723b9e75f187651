// SPDX-License-Identifier: MIT
// The files that were opened and what became of them.
import { signal } from '@preact/signals';
import type { Clip } from '../data/clip';
import { type Source, SourceError } from '../data/source';
import type { Problem, SessionInfo } from '../data/types';

export type Mode = 'compare' | 'translate' | 'pairs' | 'label';

export const session = signal<SessionInfo | null>(null);
/** Where everything comes from; set once, before anything is asked for. */
export const source = signal<Source | null>(null);
/** The clips that were named, as far as they have come; those of pair lists are loaded when they are needed. */
export const clips = signal<readonly Clip[]>([]);
/** By file id: what is wrong with it. */
export const problems = signal<ReadonlyMap<string, Problem>>(new Map());
/** What is wrong with the page as a whole; shown until it is closed. */
export const failure = signal<Problem | null>(null);
export const mode = signal<Mode>('compare');

const loading = new Map<string, Promise<Clip>>();

export function problemOf(error: unknown): Problem {
  if (error instanceof SourceError) return error.problem;
  return { message: error instanceof Error ? error.message : String(error) };
}

/** The clip of the file `id`, asked for once. Throws SourceError; what is wrong stands in `problems` then too. */
export function loadClip(id: string): Promise<Clip> {
  const known = loading.get(id);
  if (known) return known;
  const clip = source.value!.clip(id).catch((error: unknown) => {
    problems.value = new Map(problems.value).set(id, problemOf(error));
    throw error;
  });
  loading.set(id, clip);
  return clip;
}

/** Opens the session and the clips that were named. */
export async function open(from: Source): Promise<void> {
  source.value = from;
  try {
    session.value = await from.session();
  } catch (error) {
    failure.value = problemOf(error);
    return;
  }
  for (const file of session.value.files) {
    if (file.problem) problems.value = new Map(problems.value).set(file.id, file.problem);
    if (file.problem || file.kind !== 'clip' || file.listedBy !== undefined) continue;
    try {
      clips.value = [...clips.value, await loadClip(file.id)];
    } catch {
      // told beside the file
    }
  }
}
