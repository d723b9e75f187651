// SPDX-License-Identifier: MIT
// What `strut pair` wrote above a pair, in parts: "left cycle: 1.23 -> 0.89 m/s, turning +1 -> +0 degrees, 1.10 -> 0.90 s;
// distance 0.05". A person may have written something else; then there are fewer facts.

export type Kind = 'left cycle' | 'right cycle' | 'whole' | 'other';

export interface Fact {
  name: string;
  unit: string;
  input: number;
  output: number;
}

export interface Facts {
  kind: Kind;
  /** Between what the two were matched by: 0 alike, 1 different to the eye. */
  distance: number | null;
  facts: readonly Fact[];
}

const KIND = /^(left cycle|right cycle|whole):/m;
const DISTANCE = /\bdistance (\d+(?:\.\d+)?)/;
const FACT = /([-+]?\d+(?:\.\d+)?) -> ([-+]?\d+(?:\.\d+)?) (m\/s|degrees|cm|s)\b/g;
const NAMES: Record<string, string> = { 'm/s': 'speed', degrees: 'turning', cm: 'joints move by', s: 'duration' };

export function factsOf(comment: string): Facts {
  const facts = [...comment.matchAll(FACT)].map(([, input, output, unit]) => ({
    name: NAMES[unit!]!,
    unit: unit!,
    input: Number(input),
    output: Number(output),
  }));
  const distance = DISTANCE.exec(comment)?.[1];
  return {
    kind: (KIND.exec(comment)?.[1] as Kind | undefined) ?? 'other',
    distance: distance === undefined ? null : Number(distance),
    facts,
  };
}
