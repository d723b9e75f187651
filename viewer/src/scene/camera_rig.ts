// SPDX-License-Identifier: MIT
// The camera: a person turns it, it goes along with the actors, and it glides to a view that is asked for.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { type Direction, framing } from './framing';
import type { Turn, View } from './view_state';

/** How long a glide takes [s]. */
const GLIDE = 0.35;
const FOV = 34;
/** From where each view looks, relative to where the first actor faces. */
const DIRECTIONS: Record<Exclude<View, 'frame'>, Direction> = {
  corner: { azimuth: 0.62, elevation: 0.24 },
  front: { azimuth: 0, elevation: 0.08 },
  side: { azimuth: Math.PI / 2, elevation: 0.08 },
  top: { azimuth: 0, elevation: Math.PI / 2 - 0.01 },
};

interface Glide {
  fromTarget: THREE.Vector3;
  toTarget: THREE.Vector3;
  from: THREE.Spherical;
  to: THREE.Spherical;
  done: number;
}

function shift(place: THREE.Vector3, dx: number, dz: number): void {
  place.x += dx;
  place.z += dz;
}

export class CameraRig {
  readonly camera = new THREE.PerspectiveCamera(FOV, 1, 0.05, 150);
  readonly controls: OrbitControls;
  private readonly middle = new THREE.Vector3();
  private readonly offset = new THREE.Vector3();
  private readonly spherical = new THREE.Spherical();
  private glide: Glide | null = null;

  /** `changed` is called when a person has moved the camera. */
  constructor(element: HTMLElement, changed: () => void) {
    this.controls = new OrbitControls(this.camera, element);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.18;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 60;
    this.controls.maxPolarAngle = Math.PI * 0.497;
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => {
      this.glide = null;
    });
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  /** The middle of what is followed is at (x, z) now; camera and target move with it if `follows`. */
  follow(x: number, z: number, follows: boolean): void {
    const dx = x - this.middle.x;
    const dz = z - this.middle.z;
    this.middle.set(x, 0, z);
    if (!follows || (dx === 0 && dz === 0)) return;
    shift(this.camera.position, dx, dz);
    shift(this.controls.target, dx, dz);
    if (!this.glide) return;
    shift(this.glide.fromTarget, dx, dz);
    shift(this.glide.toTarget, dx, dz);
  }

  /** Looks at all of `points` [n][3] (relative to the middle): from where it looks now, or as `view` says when the first
   *  actor faces `heading`. Glides there if `glides`. */
  show(view: View, points: Float32Array, heading: number, glides: boolean): void {
    const from = new THREE.Spherical().setFromVector3(this.offset.copy(this.camera.position).sub(this.controls.target));
    const direction = this.directionOf(view, heading, from);
    const lens = { fov: THREE.MathUtils.degToRad(FOV), aspect: this.camera.aspect };
    const { target, distance } = framing(points, direction, lens);
    const turn = direction.azimuth - from.theta;
    const theta = from.theta + Math.atan2(Math.sin(turn), Math.cos(turn));
    const to = new THREE.Spherical(
      Math.min(distance, this.controls.maxDistance),
      Math.PI / 2 - direction.elevation,
      theta,
    );
    const toTarget = new THREE.Vector3(...target).add(this.middle);
    this.glide = { fromTarget: this.controls.target.clone(), toTarget, from, to, done: glides ? 0 : 1 };
    if (!glides) this.update(0);
  }

  private directionOf(view: View, heading: number, now: THREE.Spherical): Direction {
    if (view === 'frame') return { azimuth: now.theta, elevation: Math.PI / 2 - now.phi };
    const { azimuth, elevation } = DIRECTIONS[view];
    // From above, who faces forward faces up.
    return { azimuth: azimuth + heading + (view === 'top' ? Math.PI : 0), elevation };
  }

  /** Brings the middle back to the middle of the picture, as when following begins. */
  recentre(glides: boolean): void {
    const from = new THREE.Spherical().setFromVector3(this.offset.copy(this.camera.position).sub(this.controls.target));
    const toTarget = this.controls.target.clone().setX(this.middle.x).setZ(this.middle.z);
    const fromTarget = this.controls.target.clone();
    this.glide = { fromTarget, toTarget, from, to: from.clone(), done: glides ? 0 : 1 };
  }

  /** Turns about what is looked at, and comes nearer or goes farther; from where a glide under way leads. */
  turn({ right, up, distance }: Turn, glides: boolean): void {
    const { target, maxPolarAngle, minDistance, maxDistance } = this.controls;
    const from = new THREE.Spherical().setFromVector3(this.offset.copy(this.camera.position).sub(target));
    const goal = this.glide?.to ?? from;
    const to = new THREE.Spherical(
      THREE.MathUtils.clamp(goal.radius * distance, minDistance, maxDistance),
      THREE.MathUtils.clamp(goal.phi - up, 0.01, maxPolarAngle),
      goal.theta + right,
    );
    const toTarget = (this.glide?.toTarget ?? target).clone();
    this.glide = { fromTarget: target.clone(), toTarget, from, to, done: glides ? 0 : 1 };
  }

  /** Lets `seconds` go by; true while the camera is on its way. */
  update(seconds: number): boolean {
    if (this.glide) this.step(this.glide, seconds);
    return this.controls.update() || this.glide !== null;
  }

  private step(glide: Glide, seconds: number): void {
    glide.done = Math.min(1, glide.done + seconds / GLIDE);
    const share = glide.done * glide.done * (3 - 2 * glide.done);
    const mix = (a: number, b: number) => a + share * (b - a);
    const { from, to } = glide;
    this.spherical.set(mix(from.radius, to.radius), mix(from.phi, to.phi), mix(from.theta, to.theta)).makeSafe();
    this.controls.target.lerpVectors(glide.fromTarget, glide.toTarget, share);
    this.camera.position.setFromSpherical(this.spherical).add(this.controls.target);
    if (glide.done === 1) this.glide = null;
  }

  dispose(): void {
    this.controls.dispose();
  }
}
