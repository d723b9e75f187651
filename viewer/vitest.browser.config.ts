// SPDX-License-Identifier: MIT
// Tests of the real page, served by the real program, in real browsers. One file after the other: a page that draws in
// software takes all the cores there are.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['tests/browser/**/*.test.ts'],
    globalSetup: 'tests/browser/support/demo.ts',
    setupFiles: 'tests/browser/support/failures.ts',
    sequence: { hooks: 'list' }, // pages are shown before a test's own hooks close them
    fileParallelism: false,
    expect: { poll: { timeout: 20_000, interval: 100 } }, // others may be at work on the machine
    testTimeout: 60_000,
    hookTimeout: 120_000,
  },
});
