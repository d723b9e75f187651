// SPDX-License-Identifier: MIT
// The shapes of bones: along +Y from 0 to 1, radius 1, thickest near the upper end. Left is round and plain, right is
// angular with dark bands, the trunk has six sides: told apart without colour.
import * as THREE from 'three';
import type { Side } from '../data/types';

/** Where along a bone (0..1) it is how thick (0..1). */
const ROUND: readonly (readonly [at: number, radius: number])[] = [
  [0, 0.0],
  [0.03, 0.44],
  [0.12, 0.85],
  [0.24, 1],
  [0.5, 0.84],
  [0.92, 0.46],
  [1, 0],
];
/** Bands lie between two rings of equal brightness. */
const ANGULAR: readonly (readonly [at: number, radius: number])[] = [
  [0, 0.12],
  [0.2, 1.08],
  [0.38, 0.95],
  [0.46, 0.9],
  [0.58, 0.81],
  [0.66, 0.75],
  [1, 0.3],
];
const BANDS: readonly (readonly [from: number, to: number])[] = [
  [0.38, 0.46],
  [0.58, 0.66],
];
/** How bright a band is, of its bone's brightness. */
const BAND = 0.3;

function profile(rings: readonly (readonly [number, number])[]): THREE.Vector2[] {
  return rings.map(([y, radius]) => new THREE.Vector2(radius, y));
}

function faceted(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}

/** Colours each triangle by whether its middle lies within a band. */
function banded(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const place = geometry.getAttribute('position');
  const colours = new Float32Array(3 * place.count);
  for (let i = 0; i < place.count; i += 3) {
    const middle =
      (Math.max(place.getY(i), place.getY(i + 1), place.getY(i + 2)) +
        Math.min(place.getY(i), place.getY(i + 1), place.getY(i + 2))) /
      2;
    const isBand = BANDS.some(([from, to]) => middle > from && middle < to);
    colours.fill(isBand ? BAND : 1, 3 * i, 3 * i + 9);
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return geometry;
}

function plain(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const colours = new Float32Array(3 * geometry.getAttribute('position').count).fill(1);
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return geometry;
}

/** The shape of the bones of a side; whoever asks disposes of it. */
export function boneShape(side: Side): THREE.BufferGeometry {
  switch (side) {
    case 'left':
      return plain(new THREE.LatheGeometry(profile(ROUND), 12));
    case 'right':
      return banded(faceted(new THREE.LatheGeometry(profile(ANGULAR), 4, Math.PI / 4)));
    case 'centre':
      return plain(faceted(new THREE.LatheGeometry(profile(ROUND), 6)));
  }
}

export function jointShape(): THREE.BufferGeometry {
  return new THREE.SphereGeometry(1, 12, 8);
}

/** An egg along +Y from 0 to 1. */
export function headShape(): THREE.BufferGeometry {
  return new THREE.SphereGeometry(1, 20, 14).scale(1, 0.5, 1).translate(0, 0.5, 0);
}
