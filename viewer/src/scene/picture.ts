// SPDX-License-Identifier: MIT
// The canvas and what draws on it. Antialiasing is chosen when a canvas is made: another choice makes another canvas.
import * as THREE from 'three';
import type { DrawingLevel } from './drawing_level';

export interface PictureListener {
  /** The graphics driver took the picture away. */
  lost(): void;
  restored(): void;
}

function makeRenderer(antialias: boolean): THREE.WebGLRenderer {
  const renderer = new THREE.WebGLRenderer({ antialias, alpha: true });
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;
  return renderer;
}

export class Picture {
  private renderer: THREE.WebGLRenderer;
  private stop = new AbortController();
  private antialias = true;
  private pixels = 1;
  private size: readonly [number, number] = [1, 1];

  /** Draws within `container`; throws where WebGL 2 is missing. */
  constructor(
    container: HTMLElement,
    private readonly listener: PictureListener,
  ) {
    this.renderer = makeRenderer(true);
    this.listen();
    container.prepend(this.renderer.domElement);
  }

  private listen(): void {
    const canvas = this.renderer.domElement;
    const { signal } = this.stop;
    const onLost = (event: Event) => {
      event.preventDefault();
      this.listener.lost();
    };
    const onRestored = () => {
      this.renderer.shadowMap.needsUpdate = true;
      this.listener.restored();
    };
    canvas.addEventListener('webglcontextlost', onLost, { signal });
    canvas.addEventListener('webglcontextrestored', onRestored, { signal });
  }

  /** Draws as the level says from now on. */
  draws({ antialias, pixels }: DrawingLevel): void {
    if (antialias !== this.antialias) this.replace(antialias);
    this.pixels = pixels;
    this.resize(...this.size);
  }

  /** Another canvas in the place of this one; if there is none to be had, this one stays. */
  private replace(antialias: boolean): void {
    this.antialias = antialias;
    let next: THREE.WebGLRenderer;
    try {
      next = makeRenderer(antialias);
    } catch {
      return;
    }
    this.end();
    this.renderer.domElement.replaceWith(next.domElement);
    this.renderer = next;
    this.stop = new AbortController();
    this.listen();
  }

  /** In CSS pixels. Leaves the canvas blank. */
  resize(width: number, height: number): void {
    this.size = [width, height];
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, this.pixels));
    this.renderer.setSize(width, height);
  }

  /** Bodies have moved: their shadows are drawn anew with the next picture. */
  moveShadows(): void {
    this.renderer.shadowMap.needsUpdate = true;
  }

  draw(scene: THREE.Scene, camera: THREE.Camera): void {
    if (!this.renderer.getContext().isContextLost()) this.renderer.render(scene, camera);
  }

  /** Gives the context back at once: a browser has only a few. */
  private end(): void {
    this.stop.abort();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  dispose(): void {
    this.end();
    this.renderer.domElement.remove();
  }
}
