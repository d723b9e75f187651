// SPDX-License-Identifier: MIT
// What the program and the page tell each other, in JSON. Units: metres, seconds, degrees; Y is up. Frames count from 0.

/** What is wrong, in the program's own words: with file, line and column where there are some. */
export interface Problem {
  message: string;
  hint?: string;
}

export type FileKind = 'clip' | 'model' | 'pairs' | 'database';

/** A file named on the command line (or by a pair list that was). */
export interface FileEntry {
  id: string;
  kind: FileKind;
  /** The file's name, as short as tells it apart from the others. */
  name: string;
  path: string;
  /** The id of the pair list that names this clip; absent for files named on the command line. */
  listedBy?: string;
  /** Set if the file cannot be used. */
  problem?: Problem;
}

/** What a report says beside its clips. */
export interface ReportInfo {
  title: string;
  /** Paragraphs. */
  notes: string[];
  /** What the file does not hold, in sentences. */
  leftOut: string[];
}

export interface SessionInfo {
  version: string;
  files: FileEntry[];
  /** Set if the page is a report. */
  report?: ReportInfo;
  /** Who labels, if the command line says so. */
  rater?: string;
}

export type Side = 'left' | 'right' | 'centre';

/** A point that is drawn: a joint, or the tip of one. */
export interface PointInfo {
  name: string;
  /** Index of the point it hangs on, -1 for the root; always less than its own. */
  parent: number;
  side: Side;
  isTip: boolean;
}

/** A stretch in which a foot stands: frames [begin, end). */
export interface Plant {
  foot: 0 | 1;
  begin: number;
  end: number;
}

/** Where in a clip a figure is at its most extreme. */
export interface Extreme {
  /** "highest", "longest step", ... */
  what: string;
  value: number;
  unit: string;
  joint?: string;
  frame: number;
  /** After the first frame [s]. */
  time: number;
}

export interface Figure {
  name: string;
  /** None: the note says why. */
  value: number | null;
  unit: string;
  /** What is better, where that can be said. */
  better?: 'less' | 'more';
  note?: string;
  extreme?: Extreme;
}

/** A curve that can be asked for: see Source.curve. */
export interface CurveInfo {
  /** e.g. "LeftKnee/rotation/x", "LeftKnee/speed", "body/jerk". */
  name: string;
  joint: string;
  label: string;
  unit: string;
}

export interface ClipHeader {
  id: string;
  name: string;
  frameRate: number;
  numFrames: number;
  points: PointInfo[];
  /** Index of the pelvis: what hangs above it only carries the body about and is not drawn. */
  pelvis: number;
  /** Points of hip, knee, ankle and toe of the left and the right leg; absent for a body without. */
  legs?: { hip: number; knee: number; ankle: number; toe: number }[];
  plants: Plant[];
  figures: Figure[];
  curves: CurveInfo[];
  /** What reading the file had to say. */
  notes: Problem[];
}

/** Moments of one clip that belong to the frames of another. */
export interface AlignmentHeader {
  reference: string;
  clip: string;
  method: string;
  warnings: Problem[];
}
