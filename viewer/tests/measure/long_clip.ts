// SPDX-License-Identifier: MIT
// A clip as long as people bring: ten minutes of sixty joints at sixty frames a second, a body that walks in circles with
// fingers and toes, written as BVH (some 60 MB).
import { closeSync, openSync, writeSync } from 'node:fs';

interface Bone {
  name: string;
  offset: [number, number, number];
  children: Bone[];
  /** Amplitude [degrees], cycles per second and phase of its swing about x. */
  swing?: [number, number, number];
}

const STEP = 0.9; // cycles of the gait per second

function chain(name: string, offsets: [number, number, number][], swing?: [number, number, number]): Bone {
  const [first, ...rest] = offsets;
  return { name, offset: first!, swing, children: rest.length > 0 ? [chain(`${name}_`, rest)] : [] };
}

function limb(side: 1 | -1): { leg: Bone; arm: Bone } {
  const name = side === 1 ? 'Left' : 'Right';
  const phase = side === 1 ? 0 : Math.PI;
  const foot: Bone = { name: `${name}Foot`, offset: [0, -42, 0], children: [chain(`${name}Toe`, [[0, -6, 14]])] };
  const knee: Bone = { name: `${name}Knee`, offset: [0, -43, 0], swing: [20, STEP, phase + 1], children: [foot] };
  const leg: Bone = { name: `${name}Hip`, offset: [9 * side, -5, 0], swing: [28, STEP, phase], children: [knee] };
  const fingers = [0, 1, 2, 3, 4].map((i) =>
    chain(`${name}Finger${i}`, [
      [8 * side, 0, 2 * i - 4],
      [3 * side, 0, 0],
      [2.5 * side, 0, 0],
      [2 * side, 0, 0],
    ]),
  );
  const hand: Bone = { name: `${name}Hand`, offset: [0, -24, 0], children: fingers };
  const elbow: Bone = { name: `${name}Elbow`, offset: [0, -28, 0], swing: [-25, STEP, phase], children: [hand] };
  const arm: Bone = {
    name: `${name}Shoulder`,
    offset: [17 * side, 12, 0],
    swing: [-25, STEP, phase],
    children: [elbow],
  };
  return { leg, arm };
}

/** Sixty joints. */
function body(): Bone {
  const left = limb(1);
  const right = limb(-1);
  const head = chain('Neck', [
    [0, 16, 0],
    [0, 9, 0],
    [0, 5, 4],
  ]);
  const chest: Bone = { name: 'Chest', offset: [0, 18, 0], children: [head, left.arm, right.arm] };
  const spine: Bone = { name: 'Spine', offset: [0, 12, 0], swing: [4, 2 * STEP, 0], children: [chest] };
  return { name: 'Hips', offset: [0, 0, 0], children: [spine, left.leg, right.leg] };
}

function hierarchy(bone: Bone, depth: number, order: Bone[]): string {
  order.push(bone);
  const tab = '  '.repeat(depth);
  const channels = depth === 0 ? '6 Xposition Yposition Zposition' : '3';
  const inside =
    bone.children.length > 0
      ? bone.children.map((child) => hierarchy(child, depth + 1, order)).join('')
      : `${tab}  End Site\n${tab}  {\n${tab}    OFFSET 0 -2 0\n${tab}  }\n`;
  return (
    `${tab}${depth === 0 ? 'ROOT' : 'JOINT'} ${bone.name}\n${tab}{\n${tab}  OFFSET ${bone.offset.join(' ')}\n` +
    `${tab}  CHANNELS ${channels} Zrotation Xrotation Yrotation\n${inside}${tab}}\n`
  );
}

function row(order: readonly Bone[], time: number): string {
  const turn = 0.15 * time;
  const values = [600 * Math.sin(turn), 97 + 2 * Math.cos(4 * Math.PI * STEP * time), 600 * Math.cos(turn)];
  order.forEach((bone, i) => {
    const [amplitude, rate, phase] = bone.swing ?? [3, 0.1 + 0.01 * i, i];
    const swing = amplitude * Math.sin(2 * Math.PI * rate * time + phase);
    values.push(0, swing, i === 0 ? (180 / Math.PI) * turn + 90 : 0);
  });
  return values.map((value) => value.toFixed(4)).join(' ');
}

/** Writes it to `path`; how many joints it has. */
export function writeLongClip(path: string, seconds = 600, rate = 60): number {
  const order: Bone[] = [];
  const file = openSync(path, 'w');
  const frames = seconds * rate;
  writeSync(file, `HIERARCHY\n${hierarchy(body(), 0, order)}MOTION\nFrames: ${frames}\nFrame Time: ${1 / rate}\n`);
  for (let begin = 0; begin < frames; begin += 1000) {
    const rows = Array.from({ length: Math.min(1000, frames - begin) }, (_, i) => row(order, (begin + i) / rate));
    writeSync(file, `${rows.join('\n')}\n`);
  }
  closeSync(file);
  return order.length;
}
