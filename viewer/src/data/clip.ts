// SPDX-License-Identifier: MIT
// A clip as the page has it: what the program sent of it, and where its points are at any moment.
import type { Container } from './container';
import type { ClipHeader } from './types';

export class Clip {
  readonly id: string;
  readonly name: string;
  readonly header: ClipHeader;
  /** World positions [frames][points][3] in metres. */
  readonly positions: Float32Array;
  /** Speed of each foot's slower end over the ground [frames][2] in m/s while it stands, no number otherwise. */
  readonly slide: Float32Array;

  constructor({ header, arrays }: Container<ClipHeader>) {
    this.header = header;
    this.id = header.id;
    this.name = header.name;
    this.positions = arrays.positions ?? new Float32Array();
    this.slide = arrays.slide ?? new Float32Array();
  }

  get numPoints(): number {
    return this.header.points.length;
  }
  get numFrames(): number {
    return this.header.numFrames;
  }
  /** From the first frame to the last, in seconds. */
  get duration(): number {
    return Math.max(0, this.numFrames - 1) / this.header.frameRate;
  }

  /** All points at `frame` (a fraction lies between two frames; outside, the nearest) into `out` [points][3]. */
  pose(frame: number, out: Float32Array): Float32Array {
    const stride = 3 * this.numPoints;
    const last = this.numFrames - 1;
    const at = Math.min(Math.max(frame, 0), last);
    const first = Math.min(Math.floor(at), last);
    const second = Math.min(first + 1, last);
    const share = at - first;
    const a = first * stride;
    const b = second * stride;
    for (let i = 0; i < stride; ++i) {
      const from = this.positions[a + i]!;
      out[i] = from + share * (this.positions[b + i]! - from);
    }
    return out;
  }
}
