// SPDX-License-Identifier: MIT
// Ten minutes of sixty joints, once and four times: how long until they are on the stage, how many pictures a second there
// are, and what a picture costs the page itself, which does not depend on what draws it.
import { linkSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';
import type { Browser, CDPSession, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, it } from 'vitest';
import { openPage, startChromium } from '../browser/support/chromium';
import { OUTPUT, View } from '../browser/support/program';
import { writeLongClip } from './long_clip';

const CLIPS = [1, 2, 3, 4].map((i) => join(OUTPUT, `long_${i}.bvh`));
/** The stage tells what pictures cost as a mean of so many. */
const WINDOW = 60;
/** It plays for so long at least, and at most [s]: drawing in software is slow, and slower while others work. */
const LEAST = 5;
const MOST = 40;

let browser: Browser;

beforeAll(async () => {
  for (const path of CLIPS) rmSync(path, { force: true });
  const [first, ...others] = CLIPS;
  writeLongClip(first!);
  for (const path of others) linkSync(first!, path);
  browser = await startChromium();
});

afterAll(async () => {
  await browser.close();
  for (const path of CLIPS) rmSync(path, { force: true });
});

/** What draws: SwiftShader where there is no graphics card. */
async function rendererOf(page: Page): Promise<string> {
  return page.evaluate(() => {
    const context = document.createElement('canvas').getContext('webgl2')!;
    return String(context.getParameter(context.getExtension('WEBGL_debug_renderer_info')!.UNMASKED_RENDERER_WEBGL));
  });
}

interface Spent {
  drawn: number;
  updateMs: string | undefined;
  /** Of the page's clock, and of its thread in scripts and in all [s]. */
  now: number;
  script: number;
  task: number;
}

async function spent(page: Page, session: CDPSession): Promise<Spent> {
  const { metrics } = await session.send('Performance.getMetrics');
  const value = (name: string) => metrics.find((metric) => metric.name === name)?.value ?? 0;
  const { framesDrawn, updateMs } = await page.locator('.stage').evaluate((stage) => ({ ...stage.dataset }));
  return {
    drawn: Number(framesDrawn),
    updateMs,
    now: value('Timestamp'),
    script: value('ScriptDuration'),
    task: value('TaskDuration'),
  };
}

/** Plays until the stage has told anew what pictures cost. */
async function play(page: Page, what: string): Promise<void> {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable');
  await page.evaluate(() => window.strut.playback.play());
  await pause(1000);
  const before = await spent(page, session);
  let after = before;
  const hasTold = () => Math.floor(after.drawn / WINDOW) > Math.floor(before.drawn / WINDOW);
  while (after.now < before.now + (hasTold() ? LEAST : MOST)) {
    await pause(500);
    after = await spent(page, session);
  }
  const frames = Math.max(after.drawn - before.drawn, 1);
  const rate = frames / (after.now - before.now);
  const each = (seconds: number) => ((1000 * seconds) / frames).toFixed(2);
  const update = hasTold() ? after.updateMs : `none in ${MOST} s`;
  console.log(
    `| ${what} | ${rate.toFixed(1)} | ${update} | ${each(after.script - before.script)} | ${each(after.task - before.task)} |`,
  );
  await page.evaluate(() => {
    window.strut.playback.isPlaying.value = false;
  });
}

async function measure(clips: readonly string[], what: string): Promise<void> {
  const view = await View.start(...clips);
  const begin = performance.now();
  const { page } = await openPage(browser, view.address);
  await page.waitForFunction((count) => window.strut.stage.actors.value.length === count, clips.length, {
    polling: 100,
    timeout: 120_000,
  });
  console.log(`${what}: on the stage after ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  console.log(`drawn by ${await rendererOf(page)}, 1366 x 768`);
  console.log('| what plays | pictures/s | placing ms | scripts ms | all of the page ms, each a picture |');
  await play(page, what);
  await page.context().close();
  await view.stop();
}

describe('ten minutes of sixty joints at 60 frames/s', () => {
  it('load and play', () => measure(CLIPS.slice(0, 1), 'one clip'));
  it('load and play beside three others', () => measure(CLIPS, 'four clips'));
});
