// SPDX-License-Identifier: MIT
// A report opened from disk: it plays, in phase too, shows its figures, and asks nobody for anything.
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { type Opened, openPage, startChromium, timeOf, waitForClips } from './support/chromium';
import { DEMO, HAS_REAL_CLIPS, OUTPUT, realClip, run } from './support/program';

let browser: Browser;

beforeAll(async () => {
  browser = await startChromium();
});
afterAll(() => browser.close());

/** A report of `clips`, opened from disk; all that it asks for. */
async function opened(name: string, ...clips: string[]): Promise<Opened & { asked: string[] }> {
  const path = join(OUTPUT, name);
  await run('report', ...clips, '-o', path, '--force', '--title', '<b>Two walks</b>', '--note', 'Look at the knees.');
  const { page, errors } = await openPage(browser, 'about:blank');
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.goto(pathToFileURL(path).href);
  await waitForClips(page, clips.length);
  return { page, errors, asked };
}

describe('a report', () => {
  it('opens from disk, plays and goes where a figure is at its highest', async () => {
    const { page, errors, asked } = await opened('demo.html', join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'));
    expect(await page.title()).toBe('<b>Two walks</b>');
    await page.getByText('Look at the knees.').waitFor();
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.2);
    const figures = page.getByRole('region', { name: 'Figures' });
    await figures.getByText('Jerk').waitFor();
    await figures.getByRole('button').first().click();
    expect(await page.evaluate(() => window.strut.playback.isPlaying.value)).toBe(false);
    expect(await timeOf(page)).toBeGreaterThan(0);
    expect(errors).toEqual([]);
    expect(asked.filter((url) => !/^(file|data|blob):/.test(url))).toEqual([]);
    expect(asked.filter((url) => url.startsWith('file:'))).toHaveLength(1);
    await page.context().close();
  });

  it.skipIf(!HAS_REAL_CLIPS)('keeps recorded clips in phase without a program', async () => {
    const clips = [realClip('walk-turn-left_active', 1), realClip('walk-turn-left_elderly', 1)];
    const { page, errors } = await opened('real.html', ...clips);
    await page.evaluate(() => {
      window.strut.stage.step.value = 'alignment';
    });
    await page.waitForFunction(() => window.strut.stage.alignments.value.get('c1') !== undefined);
    const moments = await page.evaluate(() => [...window.strut.stage.alignments.value.get('c1')!]);
    expect(moments.every((moment, i) => i === 0 || moment >= moments[i - 1]!)).toBe(true);
    expect(errors).toEqual([]);
    await page.context().close();
  });
});
