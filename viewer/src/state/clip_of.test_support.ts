// SPDX-License-Identifier: MIT
// For tests: a clip of one point that does not move.
import { Clip } from '../data/clip';

export function clipOf(id: string, numFrames: number, frameRate: number): Clip {
  const header = { id, name: id, frameRate, numFrames, points: [], pelvis: 0, plants: [], figures: [], curves: [] };
  return new Clip({ header: { ...header, notes: [] }, arrays: {} });
}
