// SPDX-License-Identifier: MIT
// Tests of the real page, served by the real program, in real browsers. One file after the other: a page that draws in
// software takes all the cores there are.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['tests/browser/**/*.test.ts'],
    globalSetup: 'tests/browser/support/demo.ts',
    fileParallelism: false,
    testTimeout: 60_000,
    hookTimeout: 120_000,
  },
});
