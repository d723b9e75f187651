// SPDX-License-Identifier: MIT
// All actors as they are drawn: which there are, where they stand, and where their middle is.
import * as THREE from 'three';
import { frameAt } from '../state/playback';
import type { Actor } from '../state/stage';
import { ActorView } from './actor_view';
import { placed, placements, type Wishes } from './placement';
import { pathAt } from './root_path';
import type { Theme } from './theme';

/** How many moments are looked at to see how much room the actors take. */
const MOMENTS = 40;
/** What is farther from the middle than this is not fitted into the picture [m]. */
const FARTHEST = 7;
/** Over the highest joint there is a head [m]. */
const HEADROOM = 0.25;
/** Under the feet there is the title [m]. */
const FOOTROOM = 0.25;

function isSame(view: ActorView, actor: Actor): boolean {
  const { clip, colour, title, frames } = view.actor;
  const sameFrames = frames?.[0] === actor.frames?.[0] && frames?.[1] === actor.frames?.[1];
  return clip === actor.clip && colour === actor.colour && title === actor.title && sameFrames;
}

/** A joint that was found, and where it is in the world. */
export interface FoundJoint {
  name: string;
  x: number;
  y: number;
  z: number;
}

const scratch = new THREE.Vector3();

export class Cast {
  readonly object = new THREE.Group();
  views: ActorView[] = [];
  /** The mean of where the bodies are over the floor, smoothed. */
  readonly middle = { x: 0, z: 0 };

  /** `overlay` takes the titles. */
  constructor(private readonly overlay: HTMLElement) {}

  /** Makes views of new actors and keeps those that are there already. */
  setActors(actors: readonly Actor[]): void {
    const before = this.views;
    this.views = actors.map((actor, i) => {
      const known = before.find((view) => view.place === i && isSame(view, actor));
      return known ?? new ActorView(actor, i, this.overlay);
    });
    for (const view of before.filter((entry) => !this.views.includes(entry))) {
      this.object.remove(view.object);
      view.dispose();
    }
    for (const view of this.views) this.object.add(view.object);
  }

  place(wishes: Wishes): void {
    const places = placements(
      this.views.map(({ actor, course }) => ({ ...course, frameAt: (at: number) => frameAt(actor, at) })),
      wishes,
    );
    this.views.forEach((view, i) => {
      view.put(places[i]!);
    });
  }

  show(theme: Theme, shown: { isOverlaid: boolean; isStacked: boolean; plants: boolean; slide: boolean }): void {
    this.views.forEach((view, i) => {
      view.show(theme, { ...shown, isGhost: shown.isOverlaid && i > 0 });
    });
  }

  trail(names: readonly string[], theme: Theme): void {
    for (const view of this.views) view.trail(names, theme);
  }

  update(time: number, trailSeconds: number | null): void {
    let x = 0;
    let z = 0;
    for (const view of this.views) {
      view.update(time, trailSeconds);
      const place = view.smoothedPlace();
      x += place.x;
      z += place.z;
    }
    this.middle.x = x / Math.max(1, this.views.length);
    this.middle.z = z / Math.max(1, this.views.length);
  }

  /** How far the farthest body is from the middle [m]. */
  reach(): number {
    let farthest = 0;
    for (const view of this.views) {
      const { x, z } = view.smoothedPlace();
      farthest = Math.max(farthest, Math.hypot(x - this.middle.x, z - this.middle.z));
    }
    return farthest;
  }

  /** The joint drawn nearest to `at` (pixels from the upper left corner), within `reach` pixels. */
  pick(
    camera: THREE.Camera,
    size: readonly [number, number],
    at: readonly [number, number],
    reach: number,
  ): FoundJoint | null {
    let found: FoundJoint | null = null;
    let nearest = reach;
    for (const view of this.views) {
      const candidate = view.pick(camera, size, at, nearest);
      if (!candidate) continue;
      nearest = candidate.distance;
      scratch.fromArray(view.pose, 3 * candidate.point).applyMatrix4(view.object.matrixWorld);
      const { x, y, z } = scratch;
      found = { name: view.actor.clip.header.points[candidate.point]!.name, x, y, z };
    }
    return found;
  }

  /** Where the first actor faces at its beginning, after placing [rad]. */
  get heading(): number {
    const first = this.views[0];
    return first ? first.course.heading + first.object.rotation.y : 0;
  }

  /** Where the bodies' points are, relative to the middle [n][3], at moments of the
   *  whole clips: to where the middle is then if the camera follows it, and else to where it is now. */
  points(follows: boolean): Float32Array {
    const points: number[] = [];
    for (let k = 0; k <= MOMENTS; ++k) this.addMoment(points, k / MOMENTS, follows);
    return Float32Array.from(points.length > 0 ? points : [-1, 0, 0, 1, 0, 0, 0, 1.8, 0]);
  }

  /** Adds the points at the part `share` of each clip, but for those that are too far away. */
  private addMoment(points: number[], share: number, follows: boolean): void {
    const frames = this.views.map(({ course: { begin, end } }) =>
      Math.round(begin + share * Math.max(0, end - 1 - begin)),
    );
    const middle = follows ? this.middleAt(frames) : this.middle;
    this.views.forEach(({ actor: { clip }, object, joints }, i) => {
      const by = { x: object.position.x, z: object.position.z, yaw: object.rotation.y };
      let top = 0;
      for (const joint of joints) {
        const at = 3 * (frames[i]! * clip.numPoints + joint);
        const place = placed({ x: clip.positions[at]!, z: clip.positions[at + 2]! }, by);
        const [x, z] = [place.x - middle.x, place.z - middle.z];
        if (Math.hypot(x, z) > FARTHEST) continue;
        const y = clip.positions[at + 1]!;
        top = Math.max(top, y + HEADROOM);
        points.push(x, y, z);
      }
      const [x, , z] = points.slice(-3);
      if (top > 0) points.push(x!, top, z!, x!, -FOOTROOM, z!);
    });
  }

  private middleAt(frames: readonly number[]): { x: number; z: number } {
    const sum = { x: 0, z: 0 };
    this.views.forEach(({ course, object }, i) => {
      const place = { x: 0, z: 0 };
      pathAt(course.path, frames[i]!, place);
      const there = placed(place, { x: object.position.x, z: object.position.z, yaw: object.rotation.y });
      sum.x += there.x / this.views.length;
      sum.z += there.z / this.views.length;
    });
    return sum;
  }

  dispose(): void {
    for (const view of this.views) view.dispose();
    this.views = [];
  }
}
