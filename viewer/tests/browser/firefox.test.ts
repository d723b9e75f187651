// SPDX-License-Identifier: MIT
// The same page in Firefox: clips load, are drawn and play.
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { type Firefox, startFirefox } from './support/firefox';
import { DEMO, View } from './support/program';

let firefox: Firefox;
let view: View;

beforeAll(async () => {
  view = await View.start(join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'));
  firefox = await startFirefox();
});

afterAll(async () => {
  await firefox?.stop();
  await view.stop();
});

describe('Firefox', () => {
  it('loads clips, draws and plays them', async () => {
    const page = await firefox.browser.newPage();
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error') errors.push(message.text());
    });
    await page.goto(view.address);
    await page.waitForFunction(() => window.strut.session.clips.value.length === 2);
    await page.waitForFunction(() => document.querySelector('canvas') !== null);
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.2);
    expect(errors).toEqual([]);
  });
});
