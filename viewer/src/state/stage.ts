// SPDX-License-Identifier: MIT
// What is on the stage: the clips that the mode in use shows, and how they are shown. Modes write it; scene, timeline and
// curves read it.
import { signal } from '@preact/signals';
import type { Clip } from '../data/clip';

/** A clip that is shown. */
export interface Actor {
  clip: Clip;
  /** Which of the colours and line patterns of style.css tells it from the others, from 0. */
  colour: number;
  /** What stands by it, e.g. "input" or the file's short name. */
  title: string;
  /** The frames [begin, end) that are played; the whole clip if there are none. */
  frames?: [number, number];
}

export type Layout = 'side-by-side' | 'overlaid';
export type Step = 'time' | 'frame' | 'alignment';

/** The first one sets the time that the others follow. */
export const actors = signal<Actor[]>([]);
export const layout = signal<Layout>('side-by-side');
/** What keeps the clips in step. */
export const step = signal<Step>('time');
/** By clip id: for every frame of the first actor's clip, the moment of this one [frames]. */
export const alignments = signal<ReadonlyMap<string, Float32Array>>(new Map());

export const followsRoot = signal(true);
export const showsGrid = signal(true);
export const showsPlants = signal(true);
export const showsSlide = signal(false);
/** Names of the joints whose paths are drawn. */
export const trails = signal<readonly string[]>([]);
