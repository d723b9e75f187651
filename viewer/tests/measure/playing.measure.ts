// SPDX-License-Identifier: MIT
// Ten minutes of sixty joints: how long until they are on the stage, and what a frame of the display costs while they
// play.
import { join } from 'node:path';
import type { Browser, CDPSession, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, it } from 'vitest';
import { openPage, startChromium, waitForClips } from '../browser/support/chromium';
import { OUTPUT, View } from '../browser/support/program';
import { writeLongClip } from './long_clip';

const CLIP = join(OUTPUT, 'long.bvh');
const SECONDS = 10;

let browser: Browser;

beforeAll(async () => {
  writeLongClip(CLIP);
  browser = await startChromium();
});

afterAll(() => browser.close());

/** Seconds that the page's thread has spent: in scripts, and in all. */
async function spent(session: CDPSession): Promise<{ script: number; task: number }> {
  const { metrics } = await session.send('Performance.getMetrics');
  const value = (name: string) => metrics.find((metric) => metric.name === name)?.value ?? 0;
  return { script: value('ScriptDuration'), task: value('TaskDuration') };
}

/** Plays for a while: what a frame cost, and how many there were a second. */
async function play(page: Page, what: string): Promise<void> {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable');
  await page.evaluate(() => {
    window.strut.playback.isPlaying.value = true;
  });
  await page.waitForTimeout(1000);
  const before = await spent(session);
  const frames = await page.evaluate(async (seconds) => {
    const end = performance.now() + 1000 * seconds;
    let count = 0;
    while ((await new Promise<number>((next) => requestAnimationFrame(next))) < end) ++count;
    return count;
  }, SECONDS);
  const after = await spent(session);
  const each = (seconds: number) => ((1000 * seconds) / frames).toFixed(2);
  console.log(
    `| ${what} | ${(frames / SECONDS).toFixed(1)} | ${each(after.script - before.script)} | ${each(after.task - before.task)} |`,
  );
  await page.evaluate(() => {
    window.strut.playback.isPlaying.value = false;
  });
}

describe('ten minutes of sixty joints at 60 frames/s', () => {
  it('load and play', async () => {
    const view = await View.start(CLIP);
    const begin = performance.now();
    const { page } = await openPage(browser, view.address);
    await waitForClips(page, 1);
    console.log(`on the stage after ${((performance.now() - begin) / 1000).toFixed(1)} s`);
    console.log('| what plays | frames/s | script ms a frame | all of the page ms a frame |');
    await play(page, 'one clip');
    await page.evaluate(() => {
      const { actors } = window.strut.stage;
      actors.value = [0, 1, 2, 3].map((colour) => ({ ...actors.value[0]!, colour, title: `${colour}` }));
    });
    await play(page, 'four clips');
    await view.stop();
  });
});
