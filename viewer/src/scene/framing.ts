// SPDX-License-Identifier: MIT
// How far the camera has to be to see everything.

/** A box about what is to be seen, relative to a middle on the floor [m]. */
export interface Extent {
  min: [number, number, number];
  max: [number, number, number];
}

/** A box that holds nothing yet. */
export function noExtent(): Extent {
  return { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
}

export function include(extent: Extent, x: number, y: number, z: number): void {
  [x, y, z].forEach((value, axis) => {
    if (value < extent.min[axis]!) extent.min[axis] = value;
    if (value > extent.max[axis]!) extent.max[axis] = value;
  });
}

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

/** The unit vectors of a camera that looks from `direction`: to its right, upwards, and back to it. */
export function cameraAxes({ azimuth, elevation }: Direction): readonly [number, number, number][] {
  const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
  return [
    [ca, 0, -sa],
    [-sa * se, ce, -ca * se],
    [sa * ce, se, ca * ce],
  ];
}

/** The distance at which a camera looking from `direction` at the middle of `extent` sees all of it, with a margin. */
export function fittingDistance(extent: Extent, direction: Direction, { fov, aspect }: Lens): number {
  const axes = cameraAxes(direction);
  const up = Math.tan(fov / 2) * 0.8;
  const half = extent.max.map((max, i) => (max - extent.min[i]!) / 2);
  let needed = 0.5;
  for (let corner = 0; corner < 8; ++corner) {
    const at = half.map((h, axis) => (corner & (1 << axis) ? h : -h));
    const [right, above, back] = axes.map((axis) => axis.reduce((sum, a, i) => sum + a * at[i]!, 0));
    needed = Math.max(needed, Math.abs(right!) / (up * aspect) + back!, Math.abs(above!) / up + back!);
  }
  return needed;
}
