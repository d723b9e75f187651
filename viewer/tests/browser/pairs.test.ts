// SPDX-License-Identifier: MIT
// Pairs: a list is looked through with the keyboard, cut anew with the mouse, saved, and nothing is lost on the way.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { openPage, startChromium } from './support/chromium';
import { DEMO, HAS_REAL_CLIPS, OUTPUT, realClip, run, View } from './support/program';

const FOLDER = join(OUTPUT, 'pairs');
const LIST = join(FOLDER, 'pairs.toml');
const MADE = join(FOLDER, 'made.toml');

let browser: Browser;
let view: View;
let page: Page;
let errors: string[];

function saved(): string {
  return readFileSync(LIST, 'utf8');
}

function countPairs(text: string): number {
  return text.match(/^\[\[pair\]\]$/gm)?.length ?? 0;
}

async function openList(): Promise<void> {
  view = await View.start(LIST);
  ({ page, errors } = await openPage(browser, view.address));
  await page.waitForSelector('.pair-strips [data-mark]');
}

function status(): Promise<string | null> {
  return page.locator('.pairs-file [role=status]').textContent();
}

async function save(): Promise<void> {
  await page.keyboard.press('Control+s');
  await expect.poll(status).toBe('saved');
}

/** Drags a mark by `pixels`. */
async function drag(mark: string, pixels: number): Promise<void> {
  const box = (await page.locator(`[data-mark="${mark}"]`).boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + pixels / 2, y);
  await page.mouse.move(x + pixels, y);
  await page.mouse.up();
}

function frameOf(mark: string): Promise<number> {
  return page.locator(`[data-mark="${mark}"]`).getAttribute('aria-valuenow').then(Number);
}

beforeAll(async () => {
  browser = await startChromium();
  mkdirSync(FOLDER, { recursive: true });
  const clips = (style: string) => [1, 2].map((take) => join(DEMO, `${style}_${take}.bvh`));
  await run('pair', '--input', ...clips('normal'), '--output', ...clips('limp'), '-o', MADE, '--force');
});

beforeEach(() => copyFileSync(MADE, LIST));

afterEach(async () => {
  await page?.context().close();
  await view?.stop();
});

afterAll(() => browser.close());

describe('pairs', () => {
  it('are looked through, cut and saved for learning', async () => {
    const before = saved();
    await openList();
    await page.keyboard.press('a');
    await page.keyboard.press('r');
    await expect.poll(() => page.locator('.pairs-file .progress').textContent()).toContain('2 of');
    expect(
      await page
        .locator('.pair-row.rejected .what')
        .first()
        .evaluate((row) => getComputedStyle(row).textDecoration),
    ).toContain('line-through');
    await page.keyboard.press('k');
    await page.keyboard.press('k');
    const begin = await frameOf('input begin');
    await page.keyboard.press('m'); // as a whole
    await page.keyboard.press('m'); // begin
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await expect.poll(() => frameOf('input begin')).toBe(begin + 2);
    await drag('output end', 60);
    await expect.poll(status).toContain('not saved');
    expect(saved()).toBe(before);
    await save();
    const text = saved();
    expect(countPairs(text)).toBe(countPairs(before) - 1);
    expect(text).toContain('# cut by hand; proposed: ');
    expect(text).toContain('# accepted');
    expect(text).toMatch(/^# # (left|right) cycle/m);
    expect(text.split('\n').slice(0, 2)).toEqual(before.split('\n').slice(0, 2));
    await run('learn', LIST, '-o', join(FOLDER, 'cut.strut'), '--force');
    expect(errors).toEqual([]);
  });

  it('show the frame under a mark while it is dragged', async () => {
    await openList();
    await drag('output end', 40);
    const [shown, end] = await page.evaluate(() => {
      const { playback, stage } = window.strut;
      const actor = stage.actors.value[1]!;
      return [playback.frameAt(actor, playback.time.value), actor.frames![1]];
    });
    expect(shown).toBe(end - 1);
    expect(await frameOf('output end')).toBe(end);
  });

  it('come back one change after the other', async () => {
    await openList();
    const begin = await frameOf('input begin');
    await drag('input begin', 25);
    await expect.poll(() => frameOf('input begin')).not.toBe(begin);
    await page.keyboard.press('r');
    await page.keyboard.press('u');
    await page.keyboard.press('u');
    await expect.poll(() => frameOf('input begin')).toBe(begin);
    await expect.poll(status).toBe('saved');
    await page.keyboard.press('Shift+u');
    await expect.poll(status).toContain('not saved');
  });

  it('show the same phase of both at once', async () => {
    await openList();
    await page.waitForFunction(() => {
      const { stage } = window.strut;
      const [first, second] = stage.actors.value;
      const moments = second && stage.alignments.value.get(second.clip.id);
      if (!first?.frames || !moments) return false;
      const own = [...moments.slice(first.frames[0], first.frames[1])];
      const steps = own.slice(1).map((moment, i) => moment - own[i]!);
      return Math.max(...steps) - Math.min(...steps) > 0.01; // no longer evenly
    });
  });

  it('are not written over what somebody else wrote', async () => {
    await openList();
    await page.keyboard.press('a');
    writeFileSync(LIST, `${saved()}# theirs\n`);
    await page.keyboard.press('Control+s');
    await page.waitForSelector('.trouble >> text=changed on disk');
    expect(saved()).toContain('# theirs');
    const download = page.waitForEvent('download');
    await page.locator('.trouble button:has-text("Save a copy")').click();
    expect(readFileSync(await (await download).path(), 'utf8')).toContain('# accepted');
  });

  it('are not lost when the program ends', async () => {
    await openList();
    const text = page.waitForResponse(/\/text$/);
    await page.keyboard.press('r');
    await (await text).finished();
    await view.stop('SIGKILL');
    await page.keyboard.press('Control+s');
    await page.waitForSelector('.trouble');
    expect(await status()).toContain('not saved');
    const download = page.waitForEvent('download');
    await page.locator('.trouble button:has-text("Save a copy")').click();
    copyFileSync(await (await download).path(), LIST);
    await openList();
    await expect.poll(() => page.locator('.pairs-file .progress').textContent()).toContain('1 of');
  });

  it('can be added, filtered and sorted', async () => {
    await openList();
    const total = countPairs(saved());
    await page.locator('.pairs-add summary').click();
    await page.locator('.pairs-add button').click();
    await expect.poll(() => page.locator('.pairs-file .progress').textContent()).toContain(`of ${total + 1}`);
    await page.locator('[aria-label=Kind]').selectOption('left cycle');
    const kinds = await page.locator('.pair-row .what').allTextContents();
    expect(kinds.length).toBeGreaterThan(0);
    expect(kinds.every((kind) => kind.includes('left cycle'))).toBe(true);
    await page.locator('[aria-label=Order]').selectOption('distance');
    const distances = (await page.locator('.pair-row .distance').allTextContents()).map(Number);
    expect(distances).toEqual([...distances].sort((a, b) => a - b));
  });

  it.skipIf(!HAS_REAL_CLIPS)('of recorded clips are told with their facts', async () => {
    const takes = [1, 2];
    const clips = (style: string) => takes.map((take) => realClip(`walk_${style}`, take));
    await run('pair', '--input', ...clips('normal'), '--output', ...clips('elderly'), '-o', LIST, '--force');
    await openList();
    expect(await page.locator('.pairs-details').textContent()).toMatch(/speed \[m\/s\]/);
    await page.keyboard.press('a');
    await save();
    expect(countPairs(saved())).toBeGreaterThan(50);
  });
});
