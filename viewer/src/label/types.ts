// SPDX-License-Identifier: MIT
// What the page and the program tell each other about labels (cli/view/label_answer.h), in JSON.
import type { Problem } from '../data/types';

export type Factor = 'flow' | 'weight' | 'time' | 'space';

/** Where a rater stands. Items have names that tell nothing of what they are. */
export interface LabelProgress {
  rater: string;
  /** Labels given, and how many there will be. */
  done: number;
  total: number;
  /** The item to be labelled now, and the one after it; none: everything is labelled. */
  next: string | null;
  afterNext: string | null;
  notes: Problem[];
  /** How well the rater repeats; only once everything is labelled. */
  consistency?: Consistency;
  /** What became of a label: stored, there before, or not stored because another item is asked for by now. */
  stored?: 'now' | 'before' | 'no';
}

export interface Consistency {
  /** How many items were shown again. */
  repeats: number;
  factors: { factor: Factor; compared: number; meanDifference: number }[];
}

export interface LabelSaid {
  rater: string;
  item: string;
  /** -1 to 1; null where the factor is left out. */
  rating: Record<Factor, number | null>;
  notPresent: Factor[];
  comment: string;
}

/** Asks for the rater's label number `done` - 1 to be taken back. */
export interface UndoSaid {
  rater: string;
  done: number;
}
