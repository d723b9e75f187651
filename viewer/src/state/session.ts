// SPDX-License-Identifier: MIT
// The files that were opened and what became of them.
import { computed, signal } from '@preact/signals';
import type { Clip } from '../data/clip';
import { type Source, SourceError } from '../data/source';
import type { FileEntry, FileKind, Problem, SessionInfo } from '../data/types';

export type Mode = 'compare' | 'translate' | 'pairs' | 'label';

export const session = signal<SessionInfo | null>(null);
/** Where everything comes from; set once, before anything is asked for. */
export const source = signal<Source | null>(null);
/** By file id: what is wrong with it. */
export const problems = signal<ReadonlyMap<string, Problem>>(new Map());
/** What is wrong with the page as a whole; shown until it is closed. */
export const failure = signal<Problem | null>(null);
export const mode = signal<Mode>('compare');
/** By file id: every clip that has come, whoever asked for it. */
export const loadedClips = signal<ReadonlyMap<string, Clip>>(new Map());

const OTHER_FILES: Problem = {
  message: 'The program answers again, with other files than this page shows.',
  hint: 'Load the page again to see them.',
};

/** So many clips are asked for at once: reading one and sending another take turns. */
const AT_ONCE = 3;

const loading = new Map<string, Promise<Clip>>();

/** The clips named on the command line that can be read. */
export const namedClips = computed<readonly FileEntry[]>(() =>
  (session.value?.files ?? []).filter((file) => file.kind === 'clip' && !file.listedBy && !file.problem),
);

/** The clips that were named, as far as they have come, in the order of the files; those of pair lists are loaded when
 *  they are needed. */
export const clips = computed<readonly Clip[]>(() =>
  namedClips.value.flatMap((file) => loadedClips.value.get(file.id) ?? []),
);

/** How many of the named clips are still to come. */
export const numLoading = computed(
  () => namedClips.value.filter(({ id }) => !loadedClips.value.has(id) && !problems.value.has(id)).length,
);

export function problemOf(error: unknown): Problem {
  if (error instanceof SourceError) return error.problem;
  return { message: error instanceof Error ? error.message : String(error) };
}

function setProblem(id: string, problem: Problem): void {
  problems.value = new Map(problems.peek()).set(id, problem);
}

function keep(id: string, clip: Clip): Clip {
  loadedClips.value = new Map(loadedClips.peek()).set(id, clip);
  return clip;
}

/** The clip of the file `id`, asked for once. Throws SourceError; what is wrong stands in `problems` then too. */
export function loadClip(id: string): Promise<Clip> {
  const known = loading.get(id);
  if (known) return known;
  const ask = async () => {
    try {
      return keep(id, await source.value!.clip(id));
    } catch (error) {
      if (error instanceof SourceError && error.isUnanswered) loading.delete(id);
      else setProblem(id, problemOf(error));
      throw error;
    }
  };
  const clip = ask();
  loading.set(id, clip);
  return clip;
}

async function loadNamed(): Promise<void> {
  const waiting = namedClips.peek().map((file) => file.id);
  const work = async () => {
    for (let id = waiting.shift(); id !== undefined; id = waiting.shift()) {
      await loadClip(id).catch(() => {}); // told beside the file, or for the page as a whole
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, work));
}

/** The mode in which a page begins: what its files are for. A rater came to label. */
export function firstMode({ files, rater }: SessionInfo): Mode {
  const count = (kind: FileKind) => files.filter((file) => file.kind === kind && !file.listedBy).length;
  const numClips = count('clip');
  if (count('database') > 0 && (rater !== undefined || numClips === 0)) return 'label';
  if (count('pairs') > 0 && numClips === 0) return 'pairs';
  return count('model') > 0 && numClips === 1 ? 'translate' : 'compare';
}

/** Opens the session and the clips that were named. */
export async function open(from: Source): Promise<void> {
  source.value = from;
  let info: SessionInfo;
  try {
    info = await from.session();
  } catch (error) {
    if (!(error instanceof SourceError && error.isUnanswered)) failure.value = problemOf(error);
    return;
  }
  problems.value = new Map(info.files.flatMap((file) => (file.problem ? [[file.id, file.problem]] : [])));
  session.value = info;
  mode.value = firstMode(info);
  await loadNamed();
}

function areSameFiles(one: SessionInfo, other: SessionInfo): boolean {
  const key = (info: SessionInfo) => info.files.map((file) => `${file.id} ${file.path}`).join('\n');
  return key(one) === key(other);
}

/** Asks a program that was gone again, and for what did not come meanwhile. What the page shows stays as it is. */
export async function reconnect(): Promise<void> {
  const before = session.peek();
  if (before === null) return open(source.value!);
  try {
    const now = await source.value!.session();
    if (!areSameFiles(before, now)) failure.value = OTHER_FILES;
    else await loadNamed();
  } catch (error) {
    if (!(error instanceof SourceError && error.isUnanswered)) failure.value = problemOf(error);
  }
}
