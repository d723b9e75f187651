// SPDX-License-Identifier: MIT
// What a picture costs the page, as a mean over many: told at the stage element, where tests and people can read it.

const WINDOW = 60;

export class FrameCost {
  private drawn = 0;
  private updates = 0;
  private total = 0;

  constructor(private readonly element: HTMLElement) {}

  /** A picture was drawn: putting everything in place took `update` ms, with handing it to the graphics card `all` ms. */
  add(update: number, all: number): void {
    this.drawn += 1;
    this.updates += update;
    this.total += all;
    this.element.dataset.framesDrawn = String(this.drawn);
    if (this.drawn % WINDOW !== 0) return;
    this.element.dataset.updateMs = (this.updates / WINDOW).toFixed(3);
    this.element.dataset.frameMs = (this.total / WINDOW).toFixed(3);
    this.updates = 0;
    this.total = 0;
  }
}
