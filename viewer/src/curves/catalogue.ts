// SPDX-License-Identifier: MIT
// Which curves there are to choose from: by joint, found by words, and the same ones in clips of other skeletons.
import type { CurveInfo } from '../data/types';

/** Curves that belong together: of the body, of one joint, of an alignment. */
export interface Group {
  /** The first part of its curves' names. */
  key: string;
  title: string;
  curves: readonly CurveInfo[];
}

/** Curves of the page's own: how the clips are aligned with the first. */
export const ALIGNMENT_CURVES: readonly CurveInfo[] = [
  { name: 'alignment/moment', joint: '', label: 'moment of the clip', unit: 's' },
  { name: 'alignment/slope', joint: '', label: 'slope: clip time per reference time', unit: '' },
];

const TITLES: Record<string, string> = { body: 'Whole body', alignment: 'Alignment with the reference' };

function keyOf(curve: CurveInfo): string {
  return curve.name.split('/', 1)[0]!;
}

/** What a group, or a chart, is called: the joint's name, or its number if it has none. */
export function ownerOf(curve: CurveInfo): string {
  return TITLES[keyOf(curve)] ?? (curve.joint || `joint ${keyOf(curve)}`);
}

/** In the order in which they come. */
export function groupsOf(curves: readonly CurveInfo[]): Group[] {
  const groups = new Map<string, CurveInfo[]>();
  for (const curve of curves) {
    const group = groups.get(keyOf(curve)) ?? [];
    group.push(curve);
    groups.set(keyOf(curve), group);
  }
  return [...groups].map(([key, members]) => ({ key, title: ownerOf(members[0]!), curves: members }));
}

/** What of the groups has all words of `text` in the joint's or the curve's name; everything if there is no word. */
export function search(groups: readonly Group[], text: string): Group[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = (group: Group, curve: CurveInfo) => {
    const said = `${group.title} ${curve.label}`.toLowerCase();
    return words.every((word) => said.includes(word));
  };
  return groups
    .map((group) => ({ ...group, curves: group.curves.filter((curve) => fits(group, curve)) }))
    .filter((group) => group.curves.length > 0);
}

/** The curve of another clip that is the same: of the same joint by name, wherever in its skeleton; none if it has none. */
export function counterpart(curve: CurveInfo, others: readonly CurveInfo[]): CurveInfo | undefined {
  const isSame = (other: CurveInfo) => other.joint === curve.joint && other.label === curve.label;
  return others.find((other) => other.name === curve.name && isSame(other)) ?? others.find(isSame);
}
