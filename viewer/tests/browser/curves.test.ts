// SPDX-License-Identifier: MIT
// Curves in the page: chosen, drawn, hovered, zoomed, and through an alignment.
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { openPage, startChromium, timeOf, waitForClips } from './support/chromium';
import { DEMO, View } from './support/program';

let browser: Browser;
let view: View;
let page: Page;
let errors: string[];

beforeAll(async () => {
  browser = await startChromium();
  view = await View.start(join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'));
});

beforeEach(async () => {
  ({ page, errors } = await openPage(browser, view.address));
  await waitForClips(page, 2);
  await page.keyboard.press('c');
  await page.waitForSelector('.chart canvas');
  // A chart is made again when a curve comes.
  await page.waitForFunction(() => !document.querySelector('.chart .legend')?.textContent?.includes('…'));
});

afterEach(async () => {
  expect(errors).toEqual([]);
  await page.context().close();
});

afterAll(async () => {
  await view.stop();
  await browser.close();
});

const chart = (title: string) => page.locator(`figure[aria-label^="${title}"]`);
/** What the legend says of each clip. */
const said = (title: string) => chart(title).locator('output').allTextContents();
const middleOf = async (title: string, share: number) => {
  // At once: the page may make a chart again at any moment.
  const box = await chart(title)
    .locator('.u-over')
    .evaluate((plot) => plot.getBoundingClientRect().toJSON() as DOMRect);
  return [box.x + share * box.width, box.y + box.height / 2] as const;
};

describe('curves', () => {
  it('begin with the speed of the body, of every clip', async () => {
    for (const value of await said('Whole body: speed')) expect(value).toMatch(/^\d+\.\d+ m\/s$/);
  });

  it('are found by words, added and taken away', async () => {
    const sought = page.getByLabel('Find curves');
    await sought.fill('X rotation');
    const found = page.locator('.picker input[type=checkbox]');
    await page.waitForFunction(() =>
      document.querySelector('.picker input[type=checkbox]')?.getAttribute('data-curve')?.endsWith('rotation/x'),
    );
    const count = await found.count();
    expect(count).toBeGreaterThan(0);
    const name = await found.first().getAttribute('data-curve');
    await found.first().focus();
    await page.keyboard.press('Space');
    await expect.poll(() => page.locator('.chart').count()).toBe(2);
    await page.reload();
    await waitForClips(page, 2);
    await expect.poll(() => page.locator('.chart canvas').count()).toBe(2);
    expect(name).toMatch(/rotation\/x$/);
    await page.locator('.chart figcaption button').last().click();
    await expect.poll(() => page.locator('.chart').count()).toBe(1);
  });

  it('show the moment under the pointer, go back, and keep what is clicked', async () => {
    await page.mouse.move(...(await middleOf('Whole body', 0.5)));
    await page.waitForFunction(() => window.strut.playback.time.value > 0);
    const duration = await page.evaluate(() => window.strut.playback.duration.value);
    await expect.poll(() => timeOf(page)).toBeCloseTo(duration / 2, 1);
    await page.mouse.move(300, 200);
    await page.waitForFunction(() => window.strut.playback.time.value === 0);
    await page.mouse.click(...(await middleOf('Whole body', 0.25)));
    await page.mouse.move(300, 200);
    expect(await timeOf(page)).toBeCloseTo(duration / 4, 1);
  });

  it('zoom where one drags, and out by a double click', async () => {
    const width = () => page.locator('.plant-strip .bars svg').first().getAttribute('viewBox');
    const all = await width();
    await page.mouse.move(...(await middleOf('Whole body', 0.25)));
    await page.mouse.down();
    await page.mouse.move(...(await middleOf('Whole body', 0.4)), { steps: 4 });
    await page.mouse.up();
    await page.waitForSelector('.zoom-note');
    await expect.poll(width).not.toBe(all);
    await page.mouse.dblclick(...(await middleOf('Whole body', 0.5)));
    await page.waitForSelector('.zoom-note', { state: 'detached' });
    await expect.poll(width).toBe(all);
  });

  it('show how clips are aligned with the first', async () => {
    await page.getByRole('button', { name: 'Alignment', exact: true }).click();
    await page.waitForFunction(() => window.strut.stage.alignments.value.size === 1);
    await page.waitForSelector('figure[aria-label^="Alignment with the reference: moment"] canvas');
    const seconds = expect.stringMatching(/ s$/);
    await expect.poll(() => said('Alignment with the reference: moment')).toEqual([seconds, seconds]);
  });
});
