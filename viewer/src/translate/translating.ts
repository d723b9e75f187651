// SPDX-License-Identifier: MIT
// Translating live: what a person has set, and the result that follows it. Kept while other modes are in use.
import { batch, computed, signal } from '@preact/signals';
import { Clip } from '../data/clip';
import { readContainer } from '../data/container';
import { getJson, request } from '../data/server_source';
import { SourceError } from '../data/source';
import type { ClipHeader, FileEntry, Problem } from '../data/types';
import { problemOf, session } from '../state/session';
import { bodyOf, type ControlsInfo, type Settings } from './controls';
import { changed, type History, redone, undone } from './history';
import { Latest } from './latest';

/** The answer to models/ID, as far as the page shows it. */
export interface ModelInfo {
  frame_rate: number;
  num_joints: number;
  tells_footplants: boolean;
  provenance: unknown;
}

export interface Result {
  clip: Clip;
  /** Per frame of the input the moment of the output [frames]; none where the style does not re-time. */
  moments: Float32Array | null;
}

/** From a change to its result on the stage this may take without a mark [ms]. */
const UNNOTICED = 150;

export const controls = signal<ControlsInfo | null>(null);
export const models = signal<ReadonlyMap<string, ModelInfo>>(new Map());
export const result = signal<Result | null>(null);
/** Why there is no result for what is set; the one before stays on the stage. */
export const problem = signal<Problem | null>(null);
export const isBusy = signal(false);
/** From the latest change to its result [ms]. */
export const took = signal<number | null>(null);
/** The id of a clip that is shown beside, as what the result should be; empty: none. */
export const truth = signal('');
/** Whether input and output show the same phase, or the same second. */
export const inPhase = signal(true);

const history = signal<History<Settings>>({ past: [], now: { clip: '', models: [], values: {} }, future: [] });
export const settings = computed(() => history.value.now);
export const canUndo = computed(() => history.value.past.length > 0);
export const canRedo = computed(() => history.value.future.length > 0);

const usable = (kind: FileEntry['kind']) =>
  computed(() => (session.value?.files ?? []).filter((file) => file.kind === kind && !file.problem));
export const clipFiles = usable('clip');
export const modelFiles = usable('model');

interface Question {
  settings: Settings;
  asked: number;
}

async function post(path: string, of: Settings, abort?: AbortSignal): Promise<Response> {
  const init = { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(bodyOf(of)) };
  return request(path, abort ? { ...init, signal: abort } : init);
}

async function translate({ settings }: Question, abort: AbortSignal): Promise<Result> {
  const answer = await post('translate', settings, abort);
  const container = readContainer<ClipHeader>(await answer.arrayBuffer());
  return { clip: new Clip(container), moments: container.arrays.moments ?? null };
}

let busyTimer: ReturnType<typeof setTimeout> | undefined;

function setBusy(): void {
  clearTimeout(busyTimer);
  if (!latest.isBusy) isBusy.value = false;
  else busyTimer = setTimeout(() => (isBusy.value = latest.isBusy), UNNOTICED);
}

const latest = new Latest<Question, Result>(
  translate,
  ({ asked }, answer) =>
    batch(() => {
      result.value = answer;
      problem.value = null;
      took.value = performance.now() - asked;
      queueMicrotask(setBusy);
    }),
  (_, error) =>
    batch(() => {
      problem.value = problemOf(error);
      queueMicrotask(setBusy);
    }),
);

/** Asks for the result of what is set. */
export function translateNow(): void {
  const now = settings.peek();
  if (now.clip === '' || now.models.length === 0) return;
  latest.put({ settings: now, asked: performance.now() });
  setBusy();
}

function go(to: History<Settings>): void {
  const before = history.peek().now;
  if (to.now === before) return;
  if (to.now.clip !== before.clip) {
    latest.drop(); // its motion would stand beside another input
    result.value = null;
  }
  history.value = to;
  translateNow();
}

/** Changes what is set; `what` tells which control it was, so that a drag is undone as one. */
export function change(to: Settings, what: string): void {
  go(changed(history.peek(), to, what, performance.now()));
}

export const undo = (): void => go(undone(history.peek()));
export const redo = (): void => go(redone(history.peek()));

async function loadModel(id: string): Promise<void> {
  if (models.peek().has(id)) return;
  try {
    const info = await getJson<ModelInfo>(`models/${id}`);
    models.value = new Map(models.peek()).set(id, info);
  } catch (error) {
    problem.value = problemOf(error);
  }
}

export function loadModels(ids: readonly string[]): void {
  for (const id of ids) void loadModel(id);
}

/** When translating is first looked at: the first clip and the first model, as usual. */
export async function begin(): Promise<void> {
  try {
    controls.value ??= await getJson<ControlsInfo>('translate/controls');
  } catch (error) {
    problem.value = problemOf(error);
    return;
  }
  const [clip] = clipFiles.value;
  const [model] = modelFiles.value;
  if (settings.peek().clip === '' && clip && model) {
    history.value = { past: [], now: { clip: clip.id, models: [{ id: model.id, share: 1 }], values: {} }, future: [] };
  }
  if (result.peek() === null) translateNow();
}

export interface Command {
  command: string;
  saveAs: string;
}

export async function commandOf(now: Settings): Promise<Command> {
  return (await post('translate/command', now)).json() as Promise<Command>;
}

/** The result as a file, for the browser to save: the bytes that the command writes. Throws SourceError. */
export async function fileOf(now: Settings): Promise<{ name: string; content: Blob }> {
  const [{ saveAs }, answer] = await Promise.all([commandOf(now), post('translate/bvh', now)]);
  return { name: saveAs, content: await answer.blob() };
}

/** Tells what went wrong in something a person asked for; an answer that did not come is told for the whole page. */
export function tellProblem(error: unknown): void {
  if (error instanceof SourceError && error.isUnanswered) return;
  problem.value = problemOf(error);
}
