// SPDX-License-Identifier: MIT
// A movement seen from two sides at once: as it comes, facing the viewer, and turned so that it faces to the right.
import { Clip } from '../data/clip';
import type { Actor } from '../state/stage';

/** The clip turned by a quarter about the vertical: what pointed to +Z points to +X. */
export function turned(clip: Clip): Clip {
  const positions = new Float32Array(clip.positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    positions[i] = clip.positions[i + 2]!;
    positions[i + 1] = clip.positions[i + 1]!;
    positions[i + 2] = -clip.positions[i]!;
  }
  const header = { ...clip.header, id: `${clip.id}-side` };
  return new Clip({ header, arrays: { positions, slide: clip.slide } });
}

/** What is put on the stage: nothing of it tells which movement it is. */
export function viewsOf(clip: Clip, isFromTwoSides: boolean): Actor[] {
  const front: Actor = { clip, colour: 0, title: isFromTwoSides ? 'front' : 'fragment' };
  return isFromTwoSides ? [front, { clip: turned(clip), colour: 0, title: 'side' }] : [front];
}
