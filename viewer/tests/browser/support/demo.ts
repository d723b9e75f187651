// SPDX-License-Identifier: MIT
// Before all tests: the demo's clips, pair list and model.
import { mkdirSync } from 'node:fs';
import { DEMO, OUTPUT, run } from './program';

export async function setup(): Promise<void> {
  mkdirSync(OUTPUT, { recursive: true });
  await run('demo', '-o', DEMO, '--force');
}
