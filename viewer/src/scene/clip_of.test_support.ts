// SPDX-License-Identifier: MIT
// Small clips for the tests of the view: a body of a few points that walks as it is told.
import { Clip } from '../data/clip';
import type { ClipHeader, PointInfo } from '../data/types';

/** A carrier, a pelvis, a spine and a head, hips, knees, ankles and toes. Facing +Z, left is +X. */
export const POINTS: readonly (PointInfo & { at: readonly [number, number, number] })[] = [
  { name: 'Carrier', parent: -1, side: 'centre', isTip: false, at: [0, 0, 0] },
  { name: 'Pelvis', parent: 0, side: 'centre', isTip: false, at: [0, 1, 0] },
  { name: 'Chest', parent: 1, side: 'centre', isTip: false, at: [0, 1.4, 0] },
  { name: 'Head', parent: 2, side: 'centre', isTip: false, at: [0, 1.5, 0] },
  { name: 'LeftHip', parent: 1, side: 'left', isTip: false, at: [0.1, 0.95, 0] },
  { name: 'LeftKnee', parent: 4, side: 'left', isTip: false, at: [0.1, 0.5, 0] },
  { name: 'LeftAnkle', parent: 5, side: 'left', isTip: false, at: [0.1, 0.1, 0] },
  { name: 'LeftToe', parent: 6, side: 'left', isTip: false, at: [0.1, 0.02, 0.15] },
  { name: 'RightHip', parent: 1, side: 'right', isTip: false, at: [-0.1, 0.95, 0] },
  { name: 'RightKnee', parent: 8, side: 'right', isTip: false, at: [-0.1, 0.5, 0] },
  { name: 'RightAnkle', parent: 9, side: 'right', isTip: false, at: [-0.1, 0.1, 0] },
  { name: 'RightToe', parent: 10, side: 'right', isTip: false, at: [-0.1, 0.02, 0.15] },
  { name: 'Head tip', parent: 3, side: 'centre', isTip: true, at: [0, 1.5, 0] },
];
export const LEFT_ANKLE = 6;
export const LEFT_TOE = 7;

export interface Walk {
  frames: number;
  frameRate?: number;
  /** Where it begins [m], where it faces [rad from +Z towards +X] and how fast it goes there [m/s]. */
  start?: readonly [number, number];
  heading?: number;
  speed?: number;
  header?: Partial<ClipHeader>;
  slide?: Float32Array;
}

/** A clip of a body that glides ahead without moving a joint. */
export function clipOf({ frames, frameRate = 30, start = [0, 0], heading = 0, speed = 0, header, slide }: Walk): Clip {
  const positions = new Float32Array(3 * POINTS.length * frames);
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  for (let frame = 0; frame < frames; ++frame) {
    const way = (speed * frame) / frameRate;
    POINTS.forEach(({ at: [x, y, z] }, i) => {
      const place = [start[0] + c * x + s * (z + way), y, start[1] - s * x + c * (z + way)];
      positions.set(place, 3 * (frame * POINTS.length + i));
    });
  }
  const legs = [
    { hip: 4, knee: 5, ankle: LEFT_ANKLE, toe: LEFT_TOE },
    { hip: 8, knee: 9, ankle: 10, toe: 11 },
  ];
  const whole: ClipHeader = {
    id: 'c',
    name: 'clip',
    frameRate,
    numFrames: frames,
    points: [...POINTS],
    pelvis: 1,
    legs,
    plants: [],
    figures: [],
    curves: [],
    notes: [],
    ...header,
  };
  return new Clip({ header: whole, arrays: slide ? { positions, slide } : { positions } });
}
