// SPDX-License-Identifier: MIT
// Where each footplant stands on the floor: a foot's outline from heel to toe.
import type { Clip } from '../data/clip';
import type { Plant } from '../data/types';

export interface PlantMarks {
  /** [plants][4]: the foot's middle on the floor x and z, and from there half its length as x and z [m]. */
  places: Float32Array;
  /** [plants][3]: first frame, the frame after the last, and the foot (0 left, 1 right). */
  spans: Float32Array;
}

/** A foot reaches this far behind the ankle and beyond the toe joint, in parts of the way between the two. */
const HEEL = 0.4;
const TOE = 0.6;
/** The way between the two of a foot that has none, e.g. one without toes [m]. */
const WAY = 0.14;

/** Mean over the frames of `plant` of `point` over the floor [m]. */
function meanPlace(clip: Clip, plant: Plant, point: number): readonly [number, number] {
  const stride = 3 * clip.numPoints;
  let x = 0;
  let z = 0;
  for (let frame = plant.begin; frame < plant.end; ++frame) {
    x += clip.positions[frame * stride + 3 * point]!;
    z += clip.positions[frame * stride + 3 * point + 2]!;
  }
  const count = Math.max(1, plant.end - plant.begin);
  return [x / count, z / count];
}

function markOf(clip: Clip, plant: Plant, leg: { ankle: number; toe: number }): number[] {
  const [ankleX, ankleZ] = meanPlace(clip, plant, leg.ankle);
  const [toeX, toeZ] = meanPlace(clip, plant, leg.toe);
  const length = Math.hypot(toeX - ankleX, toeZ - ankleZ);
  const isKnown = length > 0.02;
  const dx = isKnown ? toeX - ankleX : 0;
  const dz = isKnown ? toeZ - ankleZ : WAY;
  const middle = (1 + TOE - HEEL) / 2;
  const half = (1 + TOE + HEEL) / 2;
  return [ankleX + middle * dx, ankleZ + middle * dz, half * dx, half * dz];
}

/** The marks of all plants of `clip`, in its own coordinates; none for a body without legs. Cost O(frames planted). */
export function plantMarks(clip: Clip): PlantMarks {
  const { legs, plants } = clip.header;
  const usable = legs ? plants.filter((plant) => legs[plant.foot] && plant.end > plant.begin) : [];
  return {
    places: Float32Array.from(usable.flatMap((plant) => markOf(clip, plant, legs![plant.foot]!))),
    spans: Float32Array.from(usable.flatMap(({ begin, end, foot }) => [begin, end, foot])),
  };
}
