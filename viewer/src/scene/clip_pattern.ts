// SPDX-License-Identifier: MIT
// Patterns that tell clips apart beside their colours: of lines in space, and of the ring about a body's feet.

/** By Actor.colour, beginning again after the last: metres drawn and left out; nothing left out: solid. */
const DASHES: readonly (readonly [drawn: number, gap: number])[] = [
  [1, 0],
  [0.12, 0.05],
  [0.035, 0.035],
  [0.25, 0.03],
  [0.06, 0.02],
  [0.02, 0.06],
];

export function dashOf(colour: number): readonly [drawn: number, gap: number] {
  return DASHES[colour % DASHES.length]!;
}

/** An arc of a ring: where it begins and how far it goes (parts of a turn), between two radii (parts of the ring's). */
export interface Arc {
  begin: number;
  length: number;
  inner: number;
  outer: number;
}

function arcs(count: number, share: number, inner = 0.88, outer = 1): Arc[] {
  return Array.from({ length: count }, (_, i) => ({ begin: i / count, length: share / count, inner, outer }));
}

/** The ring of the clip with this colour: whole, in pieces, or double. */
export function ringArcs(colour: number): Arc[] {
  const rings = [
    arcs(1, 1),
    arcs(7, 0.68),
    arcs(26, 0.5),
    [...arcs(1, 1, 0.82, 0.87), ...arcs(1, 1, 0.94, 1)],
    arcs(3, 0.85),
    [...arcs(1, 1, 0.82, 0.87), ...arcs(14, 0.5, 0.93, 1)],
  ];
  return rings[colour % rings.length]!;
}
