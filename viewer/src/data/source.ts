// SPDX-License-Identifier: MIT
// Where a page's clips come from: the program that serves it, or the file it is (a report).
import type { Clip } from './clip';
import type { AlignmentHeader, Problem, SessionInfo } from './types';

/** An alignment: for every frame of the reference, the moment of the clip that belongs to it, in frames. */
export interface Alignment extends AlignmentHeader {
  moments: Float32Array;
}

export interface Source {
  session(): Promise<SessionInfo>;
  /** The clip of the file `id`. Throws SourceError. */
  clip(id: string): Promise<Clip>;
  /** A curve of a clip by its name (CurveInfo): a value per frame. */
  curve(clip: string, name: string): Promise<Float32Array>;
  alignment(reference: string, clip: string): Promise<Alignment>;
}

/** What the program refused, in its own words. */
export class SourceError extends Error {
  readonly problem: Problem;
  /** It did not answer at all: not the question's fault. */
  readonly isUnanswered: boolean;
  constructor(problem: Problem, isUnanswered = false) {
    super(problem.message);
    this.problem = problem;
    this.isUnanswered = isUnanswered;
  }
}
