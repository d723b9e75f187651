// SPDX-License-Identifier: MIT
// Tests of the page's own logic, without a browser.
import { defineConfig } from 'vitest/config';

export default defineConfig({ test: { include: ['src/**/*.test.ts'] } });
