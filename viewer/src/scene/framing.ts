// SPDX-License-Identifier: MIT
// Where the camera has to be to see everything.

/** A direction from the target to the camera: `azimuth` from +Z towards +X, `elevation` over the floor [rad]. */
export interface Direction {
  azimuth: number;
  elevation: number;
}

export interface Lens {
  /** The angle of view from top to bottom [rad]. */
  fov: number;
  /** Width by height. */
  aspect: number;
}

export interface Framing {
  target: [number, number, number];
  /** From the target to the camera [m]. */
  distance: number;
}

/** The part of the picture's height and width that is filled. */
const FILLED = { across: 0.86, up: 0.74 };
const NEAREST = 1.5;

type Vector = readonly [number, number, number];

/** The unit vectors of a camera that looks from `direction`: to its right, upwards, and back to it. */
export function cameraAxes({ azimuth, elevation }: Direction): readonly [Vector, Vector, Vector] {
  const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
  return [
    [ca, 0, -sa],
    [-sa * se, ce, -ca * se],
    [sa * ce, se, ca * ce],
  ];
}

function dot(axis: Vector, points: ArrayLike<number>, at: number): number {
  return axis[0] * points[at]! + axis[1] * points[at + 1]! + axis[2] * points[at + 2]!;
}

/** How near along its axis the camera may come to see all of `points` between the lines of slope `tangent` on both sides
 *  of it, and where it then has to be across. */
function narrowest(
  points: ArrayLike<number>,
  across: Vector,
  back: Vector,
  tangent: number,
): readonly [number, number] {
  let high = -Infinity;
  let low = -Infinity;
  for (let at = 0; at < points.length; at += 3) {
    const a = dot(across, points, at);
    const b = dot(back, points, at);
    high = Math.max(high, a / tangent + b);
    low = Math.max(low, -a / tangent + b);
  }
  return [(high + low) / 2, ((high - low) / 2) * tangent];
}

/** The framing in which a camera looking from `direction` sees all of `points` [n][3], as near as can be. */
export function framing(points: ArrayLike<number>, direction: Direction, { fov, aspect }: Lens): Framing {
  const [right, up, back] = cameraAxes(direction);
  const tangent = Math.tan(fov / 2);
  const [nearX, x] = narrowest(points, right, back, tangent * aspect * FILLED.across);
  const [nearY, y] = narrowest(points, up, back, tangent * FILLED.up);
  let sum = 0;
  for (let at = 0; at < points.length; at += 3) sum += dot(back, points, at);
  const depth = sum / (points.length / 3);
  const target = [0, 1, 2].map((i) => x * right[i]! + y * up[i]! + depth * back[i]!) as [number, number, number];
  return { target, distance: Math.max(NEAREST, Math.max(nearX, nearY) - depth) };
}
