// SPDX-License-Identifier: MIT
// Names of clips where there is little room: without what all of them begin with.

/** Where the words of a name end: what is left out are whole words. */
const WORD_END = /[_\-. /]/;

function commonBeginning(names: readonly string[]): string {
  let common = names[0] ?? '';
  for (const name of names) {
    while (!name.startsWith(common)) common = common.slice(0, -1);
  }
  while (common !== '' && !WORD_END.test(common.at(-1)!)) common = common.slice(0, -1);
  return common;
}

/** The names without their common beginning and their ending; one name alone keeps what it begins with. */
export function shortened(names: readonly string[]): string[] {
  const bare = names.map((name) => name.replace(/\.bvh$/i, ''));
  const { length } = new Set(bare).size > 1 ? commonBeginning(bare) : '';
  return bare.map((name) => name.slice(length) || name);
}
