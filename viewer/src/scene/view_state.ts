// SPDX-License-Identifier: MIT
// How the stage is looked at: what only the three-dimensional view and its toolbar know of.
import { signal } from '@preact/signals';
import type { Problem } from '../data/types';

export type View = 'frame' | 'corner' | 'front' | 'side' | 'top';
/** How much of its path a joint's trail shows [s]; null: all of it. */
export type TrailLength = 1 | 3 | 10 | null;

/** Side by side: all face the same way at the beginning. */
export const facesAlike = signal(true);
/** Overlaid: all begin at one place, facing the same way. */
export const startsTogether = signal(false);
export const trailLength = signal<TrailLength>(null);
/** The joint under the pointer. */
export const hoveredJoint = signal<string | null>(null);
/** What was asked of the camera last; a new object each time. */
export const wantedView = signal<{ view: View } | null>(null);
/** A turn of the camera: to the right and upwards [rad], and its distance times `distance`. */
export interface Turn {
  right: number;
  up: number;
  distance: number;
}
/** How the camera was asked to turn last; a new object each time. */
export const wantedTurn = signal<Turn | null>(null);
/** Why there is no picture now. */
export const viewProblem = signal<Problem | null>(null);

export function look(view: View): void {
  wantedView.value = { view };
}

export function turn(by: Partial<Turn>): void {
  wantedTurn.value = { right: 0, up: 0, distance: 1, ...by };
}
