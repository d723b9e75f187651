// SPDX-License-Identifier: MIT
// Text that stands in the view: each actor's title under its feet, and the name of the joint under the pointer. As HTML,
// so that it is crisp and can be read aloud.
import type * as THREE from 'three';
import { Vector3 } from 'three';

const place = new Vector3();

export class Label {
  readonly element = document.createElement('div');
  private readonly words = document.createElement('span');

  constructor(container: HTMLElement, className: string) {
    this.element.className = className;
    this.element.append(this.words);
    container.append(this.element);
  }

  set text(words: string) {
    if (this.words.textContent !== words) this.words.textContent = words;
  }

  /** Puts the label at the place (x, y, z) of the world, as `camera` sees it. */
  moveTo(x: number, y: number, z: number, camera: THREE.Camera, width: number, height: number): void {
    place.set(x, y, z).project(camera);
    const isSeen = place.z < 1 && Math.abs(place.x) < 1.1 && Math.abs(place.y) < 1.1;
    this.element.style.visibility = isSeen ? 'visible' : 'hidden';
    if (!isSeen) return;
    const left = ((place.x + 1) / 2) * width;
    const top = ((1 - place.y) / 2) * height;
    this.element.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
  }

  hide(): void {
    this.element.style.visibility = 'hidden';
  }

  remove(): void {
    this.element.remove();
  }
}
