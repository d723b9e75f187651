// SPDX-License-Identifier: MIT
// How the files of a session stand in the list: by what they are, the clips of a pair list under it.
import type { FileEntry, FileKind } from '../data/types';

export interface FileGroup {
  kind: FileKind;
  title: string;
  files: readonly FileEntry[];
}

const TITLES: readonly (readonly [FileKind, string])[] = [
  ['clip', 'Clips'],
  ['model', 'Models'],
  ['pairs', 'Pair lists'],
  ['database', 'Effort databases'],
];

/** The files named on the command line, by kind; kinds without any are left out. */
export function fileGroups(files: readonly FileEntry[]): FileGroup[] {
  const named = files.filter((file) => file.listedBy === undefined);
  return TITLES.map(([kind, title]) => ({ kind, title, files: named.filter((file) => file.kind === kind) })).filter(
    (group) => group.files.length > 0,
  );
}

/** The clips that the pair list `id` names. */
export function clipsListedBy(id: string, files: readonly FileEntry[]): FileEntry[] {
  return files.filter((file) => file.listedBy === id);
}

/** What the page is about, for its title: a few names, and how many more there are. */
export function titleOf(files: readonly FileEntry[]): string {
  const MOST = 3;
  const names = files.filter((file) => file.listedBy === undefined).map((file) => file.name);
  const more = names.length > MOST ? ` and ${names.length - MOST} more` : '';
  return names.length === 0 ? 'strut' : `${names.slice(0, MOST).join(', ')}${more} – strut`;
}
