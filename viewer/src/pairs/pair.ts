// SPDX-License-Identifier: MIT
// A pair list as the page has it, and what a person does to a pair. Nothing here is changed in place.

/** Frames [begin, end). */
export type Range = readonly [begin: number, end: number];

export interface Side {
  /** The id of a file of the session. */
  clip: string;
  /** None: the whole clip. */
  frames: Range | null;
}

export const SIDES = ['input', 'output'] as const;
export type SideName = (typeof SIDES)[number];
export type Verdict = 'none' | 'accepted' | 'rejected';

/** A pair as the program tells of it (cli/view/pair_answer.h). */
export interface ToldPair {
  input: Side;
  output: Side;
  comment: string;
  verdict: Verdict;
}

export interface ToldList {
  /** Which state of the file was read; the program saves only over that. */
  version: string;
  heading: string;
  ending: string;
  pairs: readonly ToldPair[];
}

export interface Pair extends ToldPair {
  /** Tells it from the others while the page is open; what a person calls it is this plus 1. */
  id: number;
  /** The frames it had in the file; none for a pair that a person added. */
  proposed: Record<SideName, Range | null> | null;
}

export function pairsOf(list: ToldList): Pair[] {
  return list.pairs.map((pair, id) => ({
    ...pair,
    id,
    proposed: { input: pair.input.frames, output: pair.output.frames },
  }));
}

export function withFrames(pair: Pair, side: SideName, frames: Range): Pair {
  return { ...pair, [side]: { ...pair[side], frames } };
}

export function withVerdict(pair: Pair, verdict: Verdict): Pair {
  return { ...pair, verdict };
}

export function replaced(pairs: readonly Pair[], pair: Pair): Pair[] {
  return pairs.map((other) => (other.id === pair.id ? pair : other));
}

/** A pair that a person adds to `pairs`. */
export function newPair(pairs: readonly Pair[], input: Side, output: Side): Pair {
  const id = Math.max(-1, ...pairs.map((pair) => pair.id)) + 1;
  return { id, input, output, comment: 'added by hand', verdict: 'accepted', proposed: null };
}

function isSame(a: Range | null, b: Range | null): boolean {
  return a === b || (a !== null && b !== null && a[0] === b[0] && a[1] === b[1]);
}

/** Whether a person moved its marks since the list was read. */
export function isCut(pair: Pair): boolean {
  return pair.proposed !== null && SIDES.some((side) => !isSame(pair[side].frames, pair.proposed![side]));
}

const CUT = 'cut by hand';

function inWords(frames: Range | null): string {
  return frames ? `${frames[0]} to ${frames[1]}` : 'the whole clip';
}

/** The comment that is saved: what the comment says of frames is of those that were proposed, and that is said once. */
export function savedComment(pair: Pair): string {
  if (!isCut(pair) || pair.comment.split('\n').some((line) => line.startsWith(CUT))) return pair.comment;
  const was = SIDES.map((side) => inWords(pair.proposed![side])).join(' with ');
  return `${pair.comment ? `${pair.comment}\n` : ''}${CUT}; proposed: ${was}`;
}

/** The list as the program takes it. */
export function toldList(list: Omit<ToldList, 'pairs'>, pairs: readonly Pair[]): ToldList {
  const { version, heading, ending } = list;
  const told = pairs.map((pair) => ({
    input: pair.input,
    output: pair.output,
    comment: savedComment(pair),
    verdict: pair.verdict,
  }));
  return { version, heading, ending, pairs: told };
}

export interface Progress {
  total: number;
  accepted: number;
  rejected: number;
}

export function progressOf(pairs: readonly Pair[]): Progress {
  const count = (verdict: Verdict) => pairs.filter((pair) => pair.verdict === verdict).length;
  return { total: pairs.length, accepted: count('accepted'), rejected: count('rejected') };
}
