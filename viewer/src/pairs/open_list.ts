// SPDX-License-Identifier: MIT
// A pair list that is open: what a person made of it, whether that is saved, and what the program said. It lives as long
// as the page does, whichever mode is shown.
import { computed, signal } from '@preact/signals';
import { getJson, request, sendJson } from '../data/server_source';
import { SourceError } from '../data/source';
import type { FileEntry, Problem } from '../data/types';
import { problemOf } from '../state/session';
import { begun, edited, type History, redone, settled, undone } from './history';
import { EVERYTHING, neighbour, ordered, type Wish } from './order';
import {
  newPair,
  type Pair,
  pairsOf,
  replaced,
  type Side,
  type ToldList,
  toldList,
  type Verdict,
  withVerdict,
} from './pair';

/** After the last change, before its text is asked for [ms]. */
const CALM = 400;

export class OpenList {
  readonly history = signal<History>(begun([]));
  readonly selected = signal(0);
  readonly wish = signal<Wish>(EVERYTHING);
  readonly isSaving = signal(false);
  readonly isLoaded = signal(false);
  /** What went wrong last, and stays until it goes right. */
  readonly problem = signal<Problem | null>(null);
  /** The pairs as they are on disk. */
  private readonly saved = signal<readonly Pair[]>([]);
  /** The list as text, so that a copy can be had when the program is gone. */
  readonly text = signal<{ pairs: readonly Pair[]; toml: string } | null>(null);
  private told: Omit<ToldList, 'pairs'> = { version: '', heading: '', ending: '' };
  private timer: ReturnType<typeof setTimeout> | undefined;

  readonly pairs = computed(() => this.history.value.now.pairs);
  readonly isUnsaved = computed(() => this.pairs.value !== this.saved.value);
  readonly pair = computed(() => this.pairs.value.find((pair) => pair.id === this.selected.value) ?? null);
  readonly shown = computed(() => ordered(this.pairs.value, this.wish.value, this.nameOf));

  constructor(
    readonly file: FileEntry,
    readonly nameOf: (clip: string) => string,
  ) {}

  /** Reads the file, which gives up what was changed here. */
  async load(): Promise<void> {
    try {
      const list = await getJson<ToldList>(`pairs/${this.file.id}`);
      this.told = list;
      const pairs = pairsOf(list);
      this.saved.value = pairs;
      this.history.value = begun(pairs);
      this.selected.value = (pairs.find((pair) => pair.verdict === 'none') ?? pairs[0])?.id ?? 0;
      this.problem.value = null;
      this.isLoaded.value = true;
    } catch (error) {
      this.problem.value = problemOf(error);
    }
  }

  /** Writes the file. */
  async save(): Promise<void> {
    if (this.isSaving.value) return;
    this.isSaving.value = true;
    const pairs = this.pairs.value;
    try {
      const answer = await sendJson('PUT', `pairs/${this.file.id}`, toldList(this.told, pairs));
      this.told = { ...this.told, version: ((await answer.json()) as { version: string }).version };
      this.saved.value = pairs;
      this.problem.value = null;
    } catch (error) {
      this.problem.value = problemOf(error);
    } finally {
      this.isSaving.value = false;
    }
  }

  /** The list as it would be saved. Without the program: as it was last asked for, which may lack the last changes. */
  async copy(): Promise<{ toml: string; isWhole: boolean } | null> {
    await this.refreshText();
    const text = this.text.value;
    return text && { toml: text.toml, isWhole: text.pairs === this.pairs.value };
  }

  private async refreshText(): Promise<void> {
    const pairs = this.pairs.value;
    if (this.text.value?.pairs === pairs) return;
    try {
      const answer = await sendJson('POST', `pairs/${this.file.id}/text`, toldList(this.told, pairs));
      const toml = await answer.text();
      if (this.pairs.value === pairs) this.text.value = { pairs, toml };
    } catch (error) {
      // What is refused is said when a person saves; a program that is gone has to be told of at once.
      if (error instanceof SourceError && error.isUnanswered) this.problem.value = error.problem;
    }
  }

  private change(history: History): void {
    this.history.value = history;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.refreshText(), CALM);
  }

  /** Puts `pair` in the place of the one with its id. Changes of one `step` are undone together. */
  replace(pair: Pair, step: string | null = null): void {
    this.change(edited(this.history.value, replaced(this.pairs.value, pair), pair.id, step));
  }

  /** Ends a step. */
  settle(): void {
    this.history.value = settled(this.history.value);
  }

  /** Gives the selected pair a verdict, or takes the same one back, and goes on to the next. */
  judge(verdict: Verdict): void {
    const pair = this.pair.value;
    if (!pair) return;
    const next = neighbour(this.shown.value, pair.id, 1);
    const isTakenBack = pair.verdict === verdict;
    this.replace(withVerdict(pair, isTakenBack ? 'none' : verdict));
    if (!isTakenBack) this.selected.value = next;
  }

  add(input: Side, output: Side): void {
    const pair = newPair(this.pairs.value, input, output);
    this.change(edited(this.history.value, [...this.pairs.value, pair], pair.id));
    this.selected.value = pair.id;
  }

  undo(): void {
    this.turn(undone(this.history.value));
  }
  redo(): void {
    this.turn(redone(this.history.value));
  }
  private turn(to: { history: History; about: number } | null): void {
    if (!to) return;
    this.change(to.history);
    const isThere = to.history.now.pairs.some((pair) => pair.id === to.about);
    this.selected.value = isThere ? to.about : (to.history.now.pairs.at(-1)?.id ?? 0);
  }

  /** Selects the pair `count` places further down. */
  go(count: number): void {
    this.selected.value = neighbour(this.shown.value, this.selected.value, count);
  }
}

export interface PairAlignment {
  /** Frames of the output clip, one for each frame of the input's stretch. */
  moments: number[];
  warnings: Problem[];
}

/** How the pair's output runs along its input. Throws SourceError. */
export async function alignmentOf(list: FileEntry, pair: Pair, signal: AbortSignal): Promise<PairAlignment> {
  const answer = await request(`pairs/${list.id}/alignment`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ input: pair.input, output: pair.output }),
    signal,
  });
  return (await answer.json()) as PairAlignment;
}
