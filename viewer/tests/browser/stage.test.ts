// SPDX-License-Identifier: MIT
// The three-dimensional view in a real browser: it draws what is on the stage, only when it has to, tells which joint is
// under the pointer, and says so when it cannot draw.
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { type Opened, openPage, startChromium, waitForClips } from './support/chromium';
import { DEMO, View } from './support/program';

let browser: Browser;
let view: View;
let opened: Opened;
let page: Page;

beforeAll(async () => {
  browser = await startChromium();
  view = await View.start(join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'));
});

afterAll(async () => {
  await view.stop();
  await browser.close();
});

beforeEach(async () => {
  // A small picture: it is drawn in software.
  opened = await openPage(browser, view.address, { viewport: { width: 1000, height: 640 } });
  page = opened.page;
  await waitForClips(page, 2);
  await settled();
});

afterEach(() => page.context().close());

/** How many pictures were drawn. */
async function drawn(): Promise<number> {
  return Number(await page.locator('.stage').getAttribute('data-frames-drawn'));
}

/** Waits until nothing is drawn any more, for so many frames of the display; how many pictures there were by then. */
async function settled(): Promise<number> {
  await page.waitForFunction(() => Number(document.querySelector<HTMLElement>('.stage')?.dataset.framesDrawn) > 0);
  return page.evaluate(async (least) => {
    const { dataset } = document.querySelector<HTMLElement>('.stage')!;
    let before = '';
    for (let still = 0; still < least; still = dataset.framesDrawn === before ? still + 1 : 0) {
      before = dataset.framesDrawn!;
      await new Promise(requestAnimationFrame);
    }
    return Number(before);
  }, 10);
}

describe('the stage', () => {
  it('draws nothing while nothing changes, and again when the moment does', async () => {
    const before = await settled();
    await page.waitForTimeout(1000); // in which it would have drawn
    expect(await drawn()).toBe(before);
    await page.evaluate(() => window.strut.playback.seek(0.5));
    await expect.poll(drawn).toBeGreaterThan(before);
    expect(opened.errors).toEqual([]);
  });

  it('draws on while it plays, and stops with it', async () => {
    const before = await drawn();
    await page.evaluate(() => {
      window.strut.playback.isPlaying.value = true;
    });
    await expect.poll(drawn, { timeout: 20_000 }).toBeGreaterThan(before + 5);
    await page.evaluate(() => {
      window.strut.playback.isPlaying.value = false;
    });
    const after = await settled();
    expect(await drawn()).toBe(after);
  });

  it('changes layout, switches and views from the toolbar', async () => {
    const toolbar = page.getByRole('toolbar', { name: 'View' });
    await toolbar.getByRole('button', { name: 'Overlaid' }).click();
    expect(await page.evaluate(() => window.strut.stage.layout.value)).toBe('overlaid');
    await toolbar.getByRole('button', { name: 'Skate' }).click();
    expect(await page.evaluate(() => window.strut.stage.showsSlide.value)).toBe(true);
    await settled();
    const before = await drawn();
    await toolbar.getByRole('button', { name: 'Top' }).click();
    await expect.poll(drawn).toBeGreaterThan(before);
    expect(opened.errors).toEqual([]);
  });

  it('names the joint under the pointer, and a click gives it a trail', async () => {
    await page.keyboard.press('7');
    await settled();
    const found = await findJoint();
    await page.mouse.click(found.x, found.y);
    expect(await page.evaluate(() => window.strut.stage.trails.value)).toEqual([found.name]);
    await page.locator('.joint-picker summary').click();
    expect(await page.getByRole('checkbox', { name: found.name, exact: true }).isChecked()).toBe(true);
    expect(opened.errors).toEqual([]);
  });

  it('shows a title for each clip', async () => {
    const titles = await page.locator('.actor-label').allTextContents();
    expect(titles).toEqual(await page.evaluate(() => window.strut.stage.actors.value.map(({ title }) => title)));
  });

  it('says that the picture was lost, and brings it back', async () => {
    await page.evaluate(() => {
      const canvas = document.querySelector<HTMLCanvasElement>('.stage canvas')!;
      const context = canvas.getContext('webgl2')!.getExtension('WEBGL_lose_context')!;
      context.loseContext();
      setTimeout(() => context.restoreContext(), 1500);
    });
    await page.locator('.stage-problem').waitFor();
    await page.locator('.stage[data-state=ready]').waitFor();
    expect(await page.locator('.stage-problem').count()).toBe(0);
    const before = await drawn();
    await page.evaluate(() => window.strut.playback.seek(1));
    await expect.poll(drawn).toBeGreaterThan(before);
  });

  it('draws as much as a person chooses', async () => {
    const choice = page.getByLabel('Drawing:');
    const level = () => page.locator('.stage').getAttribute('data-drawing');
    await choice.selectOption('light');
    await expect.poll(level).not.toBe('0');
    expect(await choice.getAttribute('aria-description')).toContain('shadows');
    const before = await settled();
    await choice.selectOption('full');
    await expect.poll(level).toBe('0');
    await expect.poll(drawn).toBeGreaterThan(before);
    expect(await page.locator('.stage canvas').count()).toBe(1);
    expect(opened.errors).toEqual([]);
  });

  it('turns and comes nearer by keys', async () => {
    const where = () => page.locator('.actor-label').last().getAttribute('style');
    for (const key of ['.', 'Shift+ArrowUp', 'z']) {
      const before = await where();
      await page.keyboard.press(key);
      await expect.poll(where).not.toBe(before);
      await settled();
    }
  });

  it('follows the change to dark', async () => {
    const before = await drawn();
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(drawn).toBeGreaterThan(before);
  });
});

/** Moves the pointer about the middle of the stage until a joint is under it. */
async function findJoint(): Promise<{ x: number; y: number; name: string }> {
  const box = (await page.locator('.stage').boundingBox())!;
  for (let y = box.y + box.height * 0.25; y < box.y + box.height * 0.8; y += 14) {
    for (let x = box.x + box.width * 0.25; x < box.x + box.width * 0.75; x += 14) {
      await page.mouse.move(x, y);
      const label = page.locator('.joint-label');
      const isSeen = () => label.evaluate((element) => element.style.visibility === 'visible');
      if (!(await isSeen())) continue;
      await settled(); // it may have been seen for a place before
      if (await isSeen()) return { x, y, name: (await label.textContent())! };
    }
  }
  throw new Error('there is no joint');
}

describe('without WebGL', () => {
  it('says what is missing, and the rest of the page works', async () => {
    await page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
    await page.reload();
    await page.getByText('WebGL 2 is missing').waitFor();
    await waitForClips(page, 2);
    expect(await page.locator('.stage').getAttribute('data-state')).toBe('missing');
  });
});
