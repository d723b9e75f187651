// SPDX-License-Identifier: MIT
// The pair lists of the session, the one that is shown, and its selected pair on the stage.
import { batch, computed, signal } from '@preact/signals';
import type { Clip } from '../data/clip';
import type { FileEntry, Problem } from '../data/types';
import { nameOf } from '../state/names';
import * as playback from '../state/playback';
import { loadClip, loadedClips, problemOf, session } from '../state/session';
import * as stage from '../state/stage';
import { alongWhole, evenly, type PairStep } from './in_step';
import { FEWEST_FRAMES, type Mark, moved, onsetsOf, placeOf, snapped } from './marks';
import { alignmentOf, OpenList } from './open_list';
import { type Pair, type Range, SIDES, type Side, type SideName, withFrames } from './pair';

/** Marks snap to where a foot comes down within this [s]. */
const SNAP_REACH = 0.25;

const lists = new Map<string, OpenList>();
export const current = signal<OpenList | null>(null);
export const pairStep = signal<PairStep>('alignment');
/** The mark that is held: what the stage shows meanwhile. */
export const held = signal<{ side: SideName; mark: Mark } | null>(null);
/** What the program says of the selected pair's alignment. */
export const remarks = signal<readonly Problem[]>([]);

export const pairFiles = computed<readonly FileEntry[]>(() =>
  (session.value?.files ?? []).filter((file) => file.kind === 'pairs'),
);

/** Shows a list; it is read when it is shown for the first time. */
export function openList(file: FileEntry): void {
  let list = lists.get(file.id);
  if (!list) {
    list = new OpenList(file, nameOf);
    lists.set(file.id, list);
    void list.load();
  }
  current.value = list;
}

export function isAnyUnsaved(): boolean {
  return [...lists.values()].some((list) => list.isUnsaved.value);
}

/** The frames of a side; the whole clip where the list names none. None while the clip has not come. */
export function rangeOf(side: Side): Range | null {
  const clip = loadedClips.value.get(side.clip);
  return side.frames ?? (clip ? [0, clip.numFrames] : null);
}

/** Both clips of the selected pair, once they have come. */
export const shownClips = computed<{ pair: Pair; clips: Record<SideName, Clip> } | null>(() => {
  const pair = current.value?.pair.value;
  const input = pair && loadedClips.value.get(pair.input.clip);
  const output = pair && loadedClips.value.get(pair.output.clip);
  return input && output ? { pair, clips: { input, output } } : null;
});

/** Asks for the clips of the selected pair; what is wrong with them is a remark. */
export function loadShown(): void {
  const pair = current.value?.pair.value;
  if (!pair) return;
  for (const side of SIDES) {
    loadClip(pair[side].clip).catch((error: unknown) => {
      if (current.value?.pair.value === pair) remarks.value = [problemOf(error)];
    });
  }
}

/** Puts the selected pair on the stage, the input first. */
export function putOnStage(): void {
  const shown = shownClips.value;
  if (!shown) {
    stage.actors.value = [];
    return;
  }
  const { pair, clips } = shown;
  stage.actors.value = SIDES.map((side, colour) => {
    const [begin, end] = rangeOf(pair[side])!;
    const last = clips[side].numFrames; // a list may name frames that the clip does not have
    const frames: [number, number] = [Math.min(begin, Math.max(0, last - 1)), Math.min(end, last)];
    return { clip: clips[side], colour, title: `${side}: ${nameOf(pair[side].clip)}`, frames };
  });
}

function showMoments(clip: string, moments: Float32Array): void {
  stage.step.value = 'alignment';
  stage.alignments.value = new Map([[clip, moments]]);
}

/** Keeps both sides in step as a person wants it; evenly while a mark is held and until the alignment has come.
 *  Returns what gives up waiting for it. */
export function keepInStep(): () => void {
  const shown = shownClips.value;
  const list = current.value;
  const step = pairStep.value;
  const isHeld = held.value !== null;
  const given = new AbortController();
  if (!shown || !list) return () => {};
  const { pair, clips } = shown;
  const input = rangeOf(pair.input)!;
  batch(() => {
    remarks.value = [];
    if (step === 'time' && !isHeld) stage.step.value = 'time';
    else showMoments(pair.output.clip, evenly(input, rangeOf(pair.output)!, clips.input.numFrames));
  });
  if (!isHeld) void align(list, pair, input[0], clips.input.numFrames, given.signal);
  return () => given.abort();
}

/** Asks for the alignment, in every step: what is to be doubted of the pair is said whatever keeps it in step. */
async function align(list: OpenList, pair: Pair, begin: number, numFrames: number, given: AbortSignal): Promise<void> {
  try {
    const { moments, warnings } = await alignmentOf(list.file, pair, given);
    if (given.aborted) return;
    remarks.value = warnings;
    if (pairStep.peek() === 'alignment') showMoments(pair.output.clip, alongWhole(moments, begin, numFrames));
  } catch (error) {
    if (!given.aborted) remarks.value = [problemOf(error)];
  }
}

/** Moves a mark of the selected pair to a frame; `snaps`: to where a foot comes down, if that is near. */
export function moveMark(side: SideName, mark: Mark, to: number, snaps = false): void {
  const shown = shownClips.value;
  const list = current.value;
  if (!shown || !list) return;
  const clip = shown.clips[side];
  const range = rangeOf(shown.pair[side])!;
  const { frameRate, plants } = clip.header;
  const frame = snaps ? snapped(to, onsetsOf(plants), SNAP_REACH * frameRate) : to;
  const next = moved(range, mark, frame, Math.max(clip.numFrames, FEWEST_FRAMES));
  if (next[0] !== range[0] || next[1] !== range[1]) {
    list.replace(withFrames(shown.pair, side, next), `${side} ${mark}`);
  }
  showMark(mark);
}

/** Shows the frame under a mark: both sides stand at their beginning or at their end. */
export function showMark(mark: Mark): void {
  playback.isPlaying.value = false;
  playback.seek(mark === 'end' ? playback.duration.value : 0);
}

export function frameOfMark(side: SideName, mark: Mark): number {
  const range = current.value?.pair.value && rangeOf(current.value.pair.value[side]);
  return range ? placeOf(range, mark) : 0;
}
