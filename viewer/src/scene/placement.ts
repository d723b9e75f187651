// SPDX-License-Identifier: MIT
// Where the actors stand: each clip is moved over the floor as a whole, turned about the vertical. Placing is for looking
// only; no motion is changed.
import type { Clip } from '../data/clip';
import type { Layout } from '../state/stage';
import { headingAt } from './body';
import { pathAt, rootPath } from './root_path';

/** Turn by `yaw` about +Y (from +Z towards +X), then move by (x, z). */
export interface Placement {
  x: number;
  z: number;
  yaw: number;
}

/** A way over the floor that can be placed. */
export interface Course {
  /** Positions over the floor [frames][2] [m]. */
  path: Float64Array;
  frameRate: number;
  /** The frames [begin, end) that are played. */
  begin: number;
  end: number;
  /** The frame that is shown at a moment of the clock [s]; by the course's own time if absent. */
  frameAt?: (time: number) => number;
  /** Where the body faces at the beginning [rad], from +Z towards +X. */
  heading: number;
}

export interface Wishes {
  layout: Layout;
  /** Side by side: all face the same way at the beginning. */
  facesAlike: boolean;
  /** Overlaid: all begin at one place and face the same way. */
  startsTogether: boolean;
}

/** The least room between two bodies' middles [m]. */
const ROOM = 1.25;
/** No two are put farther apart than this [m]: then they may meet, but can still be seen together. */
const FARTHEST = 5;
/** How many moments are looked at. */
const MOMENTS = 200;

export function courseOf(clip: Clip, frames: readonly [number, number]): Course {
  const [begin, end] = frames;
  const heading = headingAt(clip, begin, end);
  return { path: rootPath(clip), frameRate: clip.header.frameRate, begin, end, heading };
}

/** A place over the floor after placing. */
export function placed(at: { x: number; z: number }, by: Placement): { x: number; z: number } {
  const c = Math.cos(by.yaw);
  const s = Math.sin(by.yaw);
  return { x: by.x + c * at.x + s * at.z, z: by.z - s * at.x + c * at.z };
}

/** The placement that turns by `yaw` and brings the beginning of `course` to (x, 0). */
function startingAt(course: Course, x: number, yaw: number): Placement {
  const start = { x: 0, z: 0 };
  if (course.path.length > 0) pathAt(course.path, course.begin, start);
  const turned = placed(start, { x: 0, z: 0, yaw });
  return { x: x - turned.x, z: -turned.z, yaw };
}

/** Where a placed course is at the moment `seconds` of the clock. */
function at(course: Course, placement: Placement, seconds: number): { x: number; z: number } {
  const place = { x: 0, z: 0 };
  const own = course.frameAt?.(seconds) ?? course.begin + seconds * course.frameRate;
  const frame = Math.min(own, Math.max(course.begin, course.end - 1));
  if (course.path.length > 0) pathAt(course.path, frame, place);
  return placed(place, placement);
}

/** How far `second` has to stand to the side of `first` so that the two never come closer than ROOM [m]. */
function spacing(first: Course, second: Course, yaws: readonly [number, number]): number {
  const from = [startingAt(first, 0, yaws[0]), startingAt(second, 0, yaws[1])] as const;
  const length = (course: Course) => Math.max(0, course.end - course.begin - 1) / course.frameRate;
  const duration = Math.max(length(first), length(second));
  let needed = ROOM;
  for (let k = 0; k <= MOMENTS; ++k) {
    const a = at(first, from[0], (k / MOMENTS) * duration);
    const b = at(second, from[1], (k / MOMENTS) * duration);
    const ahead = Math.abs(b.z - a.z);
    if (ahead < ROOM) needed = Math.max(needed, Math.sqrt(ROOM * ROOM - ahead * ahead) - (b.x - a.x));
  }
  return Math.min(needed, FARTHEST);
}

/** Slots from -x to +x about 0, as close as the courses let them. */
function sideBySide(courses: readonly Course[], yaws: readonly number[]): Placement[] {
  const slots: number[] = [];
  courses.forEach((course, j) => {
    const needed = slots.map((slot, i) => slot + spacing(courses[i]!, course, [yaws[i]!, yaws[j]!]));
    slots.push(Math.max(0, ...needed));
  });
  const middle = (slots.at(-1) ?? 0) / 2;
  return courses.map((course, i) => startingAt(course, slots[i]! - middle, yaws[i]!));
}

/** Where the actors of `courses` stand, in their order. Cost O(actors^2). */
export function placements(courses: readonly Course[], wishes: Wishes): Placement[] {
  if (wishes.layout === 'side-by-side') {
    const yaws = courses.map((course) => (wishes.facesAlike ? -course.heading : 0));
    return sideBySide(courses, yaws);
  }
  if (wishes.startsTogether) return courses.map((course) => startingAt(course, 0, -course.heading));
  return courses.map(() => ({ x: 0, z: 0, yaw: 0 }));
}
