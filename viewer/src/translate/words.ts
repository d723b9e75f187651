// SPDX-License-Identifier: MIT
// What the controls are called on the page, and what they do.

export interface Words {
  title: string;
  hint: string;
  unit?: string;
}

const WORDS: Readonly<Record<string, Words>> = {
  strength: { title: 'Strength', hint: 'How much of the style: 0 none, 1 all of it, more is overdone' },
  pose: { title: 'Pose', hint: 'How much of the way the style holds the body, times the strength' },
  movement: { title: 'Movement', hint: 'How much of the way the style moves, its timing included, times the strength' },
  head: { title: 'Head', hint: 'How much of the style on the head and neck' },
  trunk: { title: 'Trunk', hint: 'How much of the style on the trunk and the path of the body' },
  left_arm: { title: 'Left arm', hint: 'How much of the style on the left arm' },
  right_arm: { title: 'Right arm', hint: 'How much of the style on the right arm' },
  left_leg: { title: 'Left leg', hint: 'How much of the style on the left leg' },
  right_leg: { title: 'Right leg', hint: 'How much of the style on the right leg' },
  generalization: {
    title: 'Pass unfamiliar motion through',
    hint: 'Motion that is unlike every example stays as it is, instead of being translated',
  },
  confidence: {
    title: 'Confidence',
    hint: 'How unlike the examples motion may be and still be translated',
    unit: 'deviations',
  },
  preference: { title: 'Preference', hint: 'How strongly doubtful motion is translated rather than passed through' },
  retime: { title: "The style's timing", hint: 'The output is as fast or slow as the style is' },
  cleanFeet: { title: 'Hold planted feet', hint: 'Feet that stand do not slide' },
  keepLayout: {
    title: "Save the input's channels",
    hint: 'Written with the channels of the input file instead of six on the root, three elsewhere',
  },
  warmUp: { title: 'Warm-up', hint: 'Motion made up before the clip, so that its first frames are usable', unit: 's' },
};

/** A control that this page does not know has its own name. */
export function wordsOf(name: string): Words {
  return WORDS[name] ?? { title: name, hint: '' };
}

/** Names of the files a style was learnt from, in short: the first, and how many more. */
export function filesInShort(provenance: unknown, side: 'inputs' | 'outputs'): string | null {
  const files = (provenance as Record<string, unknown> | null)?.[side];
  if (!Array.isArray(files) || files.length === 0) return null;
  const first = String((files[0] as { file?: unknown } | null)?.file ?? '?').replace(/^.*[\\/]/, '');
  return files.length === 1 ? first : `${first} and ${files.length - 1} more`;
}
