// SPDX-License-Identifier: MIT
// A rater at work on one database: the item that is shown, the label that is being made, and what of it is saved. A
// label stays here until the program has said that it is stored; what failed is tried again by itself.
import { computed, signal } from '@preact/signals';
import type { Clip } from '../data/clip';
import { SourceError } from '../data/source';
import type { Problem } from '../data/types';
import { problemOf } from '../state/session';
import { type Draft, EMPTY, labelOf, missing, nudge, setValue, toggleNotPresent } from './draft';
import type { LabelServer } from './label_server';
import { Pace } from './pace';
import type { Factor, LabelProgress } from './types';

/** What is being asked of the program. */
export type Doing = 'opening' | 'saving' | 'undoing';

/** What a rater said of an item, kept for the case that it is undone. */
interface Kept {
  draft: Draft;
  comment: string;
}

/** What a rater is told of what became of a label. */
const NOTES = {
  now: null,
  before: 'That movement had its label already, as it was sent first; undo takes it back.',
  no: 'That label was not stored: the movement was labelled or taken back elsewhere.',
} as const;

/** The page tells at its top that the program is gone, and what to do. */
const WAITING: Problem = { message: 'Waiting for the program.' };

/** Until a failed question is asked again [ms]. */
const RETRY_AFTER = 2000;

export class LabelDesk {
  readonly progress = signal<LabelProgress | null>(null);
  readonly movement = signal<Clip | null>(null);
  readonly draft = signal<Draft>(EMPTY);
  readonly comment = signal('');
  readonly chosen = signal<Factor>('flow');
  readonly isPaused = signal(false);
  readonly doing = signal<Doing | null>(null);
  /** Why what is being done has not been done yet. */
  readonly problem = signal<Problem | null>(null);
  /** Something worth knowing about the last step. */
  readonly note = signal<string | null>(null);
  readonly missing = computed(() => missing(this.draft.value));
  readonly isFinished = computed(() => this.progress.value !== null && this.progress.value.next === null);
  /** Whether a label can be made now. */
  readonly isOpen = computed(() => this.movement.value !== null && !this.doing.value && !this.isPaused.value);
  readonly pace = new Pace();

  private readonly ahead = new Map<string, Promise<Clip>>();
  private readonly given = new Map<number, Kept>();
  private retry: ReturnType<typeof setTimeout> | undefined;
  private again: (() => void) | null = null;
  private since = 0;
  private isClosed = false;

  constructor(
    private readonly server: LabelServer,
    readonly rater: string,
    private readonly now: () => number = () => performance.now(),
  ) {}

  open(): Promise<void> {
    return this.attempt('opening', async () => this.show(await this.server.progress(this.rater)));
  }

  /** Nothing is asked or tried again after this. */
  close(): void {
    this.isClosed = true;
    clearTimeout(this.retry);
  }

  /** Tries at once what has failed. */
  tryAgain(): void {
    clearTimeout(this.retry);
    this.again?.();
  }

  /** Stops trying to save, so that the label can be changed. */
  changeInstead(): void {
    if (this.doing.value !== 'saving' || !this.problem.value) return;
    clearTimeout(this.retry);
    this.again = null;
    this.doing.value = null;
    this.problem.value = null;
  }

  choose(factor: Factor): void {
    if (this.isOpen.value) this.chosen.value = factor;
  }
  set(factor: Factor, value: number): void {
    this.change(factor, setValue(this.draft.value, factor, value));
  }
  nudge(factor: Factor, by: number): void {
    this.change(factor, nudge(this.draft.value, factor, by));
  }
  toggleNotPresent(factor: Factor): void {
    this.change(factor, toggleNotPresent(this.draft.value, factor));
  }

  /** Saves the label and goes on to the next item once it is stored. */
  async save(): Promise<void> {
    const at = this.progress.value;
    if (!this.isOpen.value || !at?.next) return;
    if (this.missing.value.length > 0) {
      this.chosen.value = this.missing.value[0]!;
      this.note.value = 'Rate every factor, or say that it is not present.';
      return;
    }
    const label = labelOf(this.draft.value, this.comment.value, this.rater, at.next);
    this.pace.add((this.now() - this.since) / 1000);
    this.given.set(at.done, { draft: this.draft.value, comment: this.comment.value });
    await this.attempt('saving', async () => {
      const progress = await this.server.store(label);
      await this.show(progress);
      this.note.value = NOTES[progress.stored ?? 'now'];
    });
  }

  /** Goes back to the item before, with what was said of it if that was said here. */
  async undo(): Promise<void> {
    const at = this.progress.value;
    if (this.doing.value || this.isPaused.value || !at || at.done === 0) return;
    await this.attempt('undoing', async () => {
      const progress = await this.server.undo({ rater: this.rater, done: at.done });
      await this.show(progress);
      const kept = this.given.get(progress.done);
      if (kept) {
        this.draft.value = kept.draft;
        this.comment.value = kept.comment;
      }
      this.note.value = 'The last label is taken back; label this movement again.';
    });
  }

  togglePause(): void {
    this.isPaused.value = !this.isPaused.value;
    this.since = this.now();
  }

  private change(factor: Factor, draft: Draft): void {
    if (!this.isOpen.value) return;
    this.chosen.value = factor;
    this.draft.value = draft;
    this.note.value = null;
  }

  /** Does `step` until it succeeds or the desk is closed. Every step may be repeated. */
  private async attempt(doing: Doing, step: () => Promise<void>): Promise<void> {
    if (this.isClosed) return;
    this.doing.value = doing;
    this.again = null;
    try {
      await step();
      this.doing.value = null;
      this.problem.value = null;
    } catch (error) {
      this.problem.value = error instanceof SourceError && error.isUnanswered ? WAITING : problemOf(error);
      this.again = () => void this.attempt(doing, step);
      if (!this.isClosed) this.retry = setTimeout(() => this.tryAgain(), RETRY_AFTER);
    }
  }

  private async show(progress: LabelProgress): Promise<void> {
    const movement = progress.next === null ? null : await this.load(progress.next);
    this.progress.value = progress;
    this.movement.value = movement;
    this.draft.value = EMPTY;
    this.comment.value = '';
    this.chosen.value = 'flow';
    this.note.value = null;
    this.since = this.now();
    this.prepare(progress);
  }

  /** Asks for what comes next while the rater looks at this, and forgets what was. */
  private prepare({ next, afterNext }: LabelProgress): void {
    for (const item of this.ahead.keys()) if (item !== next && item !== afterNext) this.ahead.delete(item);
    if (afterNext !== null) this.load(afterNext).catch(() => {}); // told when it is shown
  }

  private load(item: string): Promise<Clip> {
    const known = this.ahead.get(item);
    if (known) return known;
    const asked = this.server.movement(this.rater, item).catch((error: unknown) => {
      this.ahead.delete(item);
      throw error;
    });
    this.ahead.set(item, asked);
    return asked;
  }
}
