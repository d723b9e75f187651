// SPDX-License-Identifier: MIT
// All that is drawn of one actor, in its clip's coordinates under one placement.
import * as THREE from 'three';
import { colourOf } from '../state/looks';
import { frameAt, frameRange } from '../state/playback';
import type { Actor } from '../state/stage';
import { bodyPoints, leftward, sidePoints } from './body';
import { Figure } from './figure';
import { PlantView, SlideView } from './floor_marks';
import { Label } from './labels';
import { type Nearest, nearestPoint } from './picking';
import { type Course, courseOf, type Placement } from './placement';
import { Ring } from './ring';
import { pathAt } from './root_path';
import type { Theme } from './theme';
import { Trail } from './trail';

/** How the actor is shown. */
export interface Shown {
  isGhost: boolean;
  /** Titles stand under each other, as the bodies stand at one place. */
  isStacked: boolean;
  plants: boolean;
  slide: boolean;
}

const projection = new THREE.Matrix4();

export class ActorView {
  readonly object = new THREE.Group();
  readonly course: Course;
  /** The pose that is drawn [points][3], in the clip's coordinates. */
  readonly pose: Float32Array;
  frame = 0;
  private readonly figure: Figure;
  private readonly ring: Ring;
  private readonly label: Label;
  readonly joints: readonly number[];
  private readonly trails = new Map<string, Trail>();
  private plants: PlantView | null = null;
  private slide: SlideView | null = null;
  private readonly middle = { x: 0, z: 0 };
  private readonly sides: ReturnType<typeof sidePoints>;
  private readonly left = { x: 0, z: 0 };

  constructor(
    readonly actor: Actor,
    readonly place: number,
    overlay: HTMLElement,
  ) {
    const { clip, colour } = actor;
    this.pose = new Float32Array(3 * clip.numPoints);
    this.course = courseOf(clip, frameRange(actor));
    this.joints = bodyPoints(clip.header).filter((i) => !clip.header.points[i]!.isTip);
    this.sides = sidePoints(clip.header);
    this.figure = new Figure(clip);
    this.ring = new Ring(colour);
    this.label = new Label(overlay, 'actor-label');
    this.label.text = actor.title;
    this.label.element.style.setProperty('--clip', colourOf(colour));
    this.object.add(this.figure.object, this.ring.object);
  }

  put({ x, z, yaw }: Placement): void {
    this.object.position.set(x, 0, z);
    this.object.rotation.y = yaw;
    this.object.updateMatrixWorld();
  }

  /** Makes what is to be seen and was not made yet, and colours everything. */
  show(theme: Theme, { isGhost, isStacked, plants, slide }: Shown): void {
    const { clip, colour } = this.actor;
    if (plants && !this.plants) {
      this.plants = new PlantView(clip);
      this.object.add(this.plants.object);
    }
    if (slide && !this.slide) {
      this.slide = new SlideView(clip);
      this.object.add(this.slide.object);
    }
    this.label.element.style.setProperty('--row', String(isStacked ? this.place : 0));
    const own = theme.clips[colour % theme.clips.length]!;
    this.figure.paint(theme, own, isGhost);
    this.ring.paint(own);
    this.plants?.paint(theme);
    this.slide?.paint(theme);
    if (this.plants) this.plants.object.visible = plants;
    if (this.slide) this.slide.object.visible = slide;
    for (const trail of this.trails.values()) trail.paint(own, theme.page);
  }

  /** Draws the trails of the joints with these names, and no others. */
  trail(names: readonly string[], theme: Theme): void {
    const { clip, colour } = this.actor;
    for (const [name, trail] of this.trails) {
      if (names.includes(name)) continue;
      this.object.remove(trail.object);
      trail.dispose();
      this.trails.delete(name);
    }
    for (const name of names) {
      const point = clip.header.points.findIndex((entry) => entry.name === name);
      if (point < 0 || this.trails.has(name)) continue;
      const trail = new Trail(clip, point, frameRange(this.actor), colour);
      trail.paint(theme.clips[colour % theme.clips.length]!, theme.page);
      this.trails.set(name, trail);
      this.object.add(trail.object);
    }
  }

  /** Shows the moment `time` of the clock. */
  update(time: number, trailSeconds: number | null): void {
    this.frame = frameAt(this.actor, time);
    this.actor.clip.pose(this.frame, this.pose);
    this.figure.update(this.pose);
    leftward(this.pose, 0, this.sides, this.left);
    this.ring.update(this.pose, this.actor.clip.header.pelvis, Math.atan2(-this.left.z, this.left.x));
    this.plants?.update(this.frame);
    this.slide?.update(this.frame);
    for (const trail of this.trails.values()) trail.update(this.pose, this.frame, trailSeconds);
  }

  updateLabel(camera: THREE.Camera, width: number, height: number): void {
    const { x, z } = this.ring.object.position;
    const c = this.object.matrixWorld.elements;
    this.label.moveTo(c[0]! * x + c[8]! * z + c[12]!, 0, c[2]! * x + c[10]! * z + c[14]!, camera, width, height);
  }

  /** Where the body is over the floor now, smoothed, after placing. */
  smoothedPlace(): { x: number; z: number } {
    pathAt(this.course.path, this.frame, this.middle);
    const c = this.object.matrixWorld.elements;
    const { x, z } = this.middle;
    this.middle.x = c[0]! * x + c[8]! * z + c[12]!;
    this.middle.z = c[2]! * x + c[10]! * z + c[14]!;
    return this.middle;
  }

  /** The joint that is drawn nearest to the pointer. */
  pick(
    camera: THREE.Camera,
    size: readonly [number, number],
    at: readonly [number, number],
    reach: number,
  ): Nearest | null {
    projection.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(this.object.matrixWorld);
    return nearestPoint(this.pose, this.joints, projection.elements, size, at, reach);
  }

  dispose(): void {
    this.label.remove();
    for (const part of [this.figure, this.ring, this.plants, this.slide, ...this.trails.values()]) part?.dispose();
  }
}
