// SPDX-License-Identifier: MIT
// How fast the page is, on clips as long as people bring: run by ./dev page-speed, never by the tests.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['tests/measure/**/*.measure.ts'],
    globalSetup: 'tests/browser/support/demo.ts',
    fileParallelism: false,
    testTimeout: 600_000,
    hookTimeout: 600_000,
  },
});
