// SPDX-License-Identifier: MIT
// The three-dimensional view: draws the stage at the moment of the clock, once per frame of the display.
import { effect } from '@preact/signals';
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { advance, frameAt, time } from '../state/playback';
import { type Actor, actors } from '../state/stage';

class Stick {
  readonly object: THREE.LineSegments;
  private readonly pose: Float32Array;
  private readonly points: Float32Array;
  constructor(private readonly actor: Actor) {
    this.pose = new Float32Array(3 * actor.clip.numPoints);
    this.points = new Float32Array(6 * actor.clip.numPoints);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.points, 3));
    this.object = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x808080 }));
    this.object.frustumCulled = false;
  }
  update(at: number): void {
    this.actor.clip.pose(frameAt(this.actor, at), this.pose);
    this.actor.clip.header.points.forEach((point, i) => {
      const from = point.parent < 0 ? i : point.parent;
      this.points.set(this.pose.subarray(3 * from, 3 * from + 3), 6 * i);
      this.points.set(this.pose.subarray(3 * i, 3 * i + 3), 6 * i + 3);
    });
    this.object.geometry.attributes.position!.needsUpdate = true;
  }
}

/** Draws into `container` until the returned function is called. */
export function startScene(container: HTMLElement): () => void {
  const renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
  container.append(renderer.domElement);
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(40, 1, 0.05, 200);
  camera.position.set(3, 2, 4);
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.target.set(0, 0.9, 0);
  scene.add(new THREE.GridHelper(20, 20));
  let sticks: Stick[] = [];
  const stopWatching = effect(() => {
    for (const stick of sticks) scene.remove(stick.object);
    sticks = actors.value.map((actor) => new Stick(actor));
    for (const stick of sticks) scene.add(stick.object);
  });
  let before = performance.now();
  const draw = (now: number) => {
    advance((now - before) / 1000);
    before = now;
    const { clientWidth: width, clientHeight: height } = container;
    renderer.setSize(width, height);
    camera.aspect = width / Math.max(height, 1);
    camera.updateProjectionMatrix();
    for (const stick of sticks) stick.update(time.peek());
    controls.update();
    renderer.render(scene, camera);
  };
  renderer.setAnimationLoop(draw);
  return () => {
    stopWatching();
    renderer.setAnimationLoop(null);
    renderer.dispose();
    renderer.domElement.remove();
  };
}
