// SPDX-License-Identifier: MIT
// Translating in the page: the result follows the controls while time goes on, and is saved as the command writes it.
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { openPage, startChromium } from './support/chromium';
import { DEMO, run, View } from './support/program';

const MODEL = join(DEMO, 'limp.strut');
const CLIP = join(DEMO, 'input.bvh');

let browser: Browser;
let view: View;
let page: Page;
let errors: string[];

beforeAll(async () => {
  browser = await startChromium();
  view = await View.start(CLIP, join(DEMO, 'truth.bvh'), MODEL);
});

afterAll(async () => {
  await view.stop();
  await browser.close();
});

beforeEach(async () => {
  ({ page, errors } = await openPage(browser, view.address));
  await page
    .getByRole('tab', { name: 'Translate' })
    .or(page.getByRole('button', { name: 'Translate' }))
    .first()
    .click();
  await output(page);
  return async () => {
    expect(errors).toEqual([]);
    await page.context().close();
  };
});

/** The id of the result on the stage, when there is another than `before`. */
async function output(on: Page, before = ''): Promise<string> {
  const handle = await on.waitForFunction((old) => {
    const id = window.strut.stage.actors.value.find((actor) => actor.title === 'output')?.clip.id;
    return id !== undefined && id !== old && id;
  }, before);
  return (await handle.jsonValue()) as string;
}

async function setStrength(value: string): Promise<void> {
  const before = await output(page);
  await page.getByLabel('Strength, number').fill(value);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await output(page, before);
}

/** How many frames the result has. */
async function framesOf(on: Page): Promise<number | undefined> {
  return on.evaluate(() => window.strut.stage.actors.value.find((actor) => actor.title === 'output')?.clip.numFrames);
}

async function saved(): Promise<{ name: string; text: string }> {
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('button', { name: 'Save as BVH' }).click(),
  ]);
  return { name: download.suggestedFilename(), text: readFileSync((await download.path())!, 'utf8') };
}

async function written(...options: string[]): Promise<string> {
  const file = join(mkdtempSync(join(tmpdir(), 'strut-')), 'out.bvh');
  await run('translate', MODEL, CLIP, '-o', file, ...options);
  return readFileSync(file, 'utf8');
}

describe('translating', () => {
  it('shows input and output, in phase', async () => {
    const shown = await page.evaluate(() => {
      const { actors, alignments, step } = window.strut.stage;
      const titles = actors.value.map((actor) => actor.title);
      return { titles, step: step.value, moments: alignments.value.get(actors.value[1]!.clip.id)?.length };
    });
    expect(shown.titles).toEqual(['input', 'output']);
    expect(shown.step).toBe('alignment');
    expect(shown.moments).toBeGreaterThan(100);
  });

  it('follows a slider while it plays, without going back in time', async () => {
    await page.evaluate(() => {
      window.strut.playback.time.value = 1;
      window.strut.playback.isPlaying.value = true;
    });
    let before = await output(page);
    const slider = page.getByRole('slider', { name: 'Strength', exact: true });
    await slider.focus();
    for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowLeft');
    before = await output(page, before);
    expect(await page.evaluate(() => window.strut.playback.time.value)).toBeGreaterThan(1);
    expect(await page.evaluate(() => window.strut.playback.isPlaying.value)).toBe(true);
  });

  it('saves the bytes that the command writes', async () => {
    await setStrength('0.6');
    const { name, text } = await saved();
    expect(name).toBe('input_limp.bvh');
    expect(text).toBe(await written('--strength', '0.6'));
  });

  it('says the command', async () => {
    await setStrength('0.6');
    await page.getByRole('button', { name: 'Copy command' }).click();
    await expect.poll(() => page.locator('.translate-command').textContent()).toContain('--strength 0.6');
  });

  it('undoes and redoes', async () => {
    const usual = await framesOf(page);
    await setStrength('0');
    expect(await framesOf(page)).not.toBe(usual);
    await page.keyboard.press('Control+z');
    await expect.poll(() => framesOf(page)).toBe(usual);
    await page.getByRole('button', { name: 'Redo' }).click();
    await expect.poll(() => framesOf(page)).not.toBe(usual);
  });

  it('keeps what was set while another mode is in use', async () => {
    await setStrength('0.4');
    const tab = (name: string) => page.getByRole('tab', { name }).or(page.getByRole('button', { name })).first();
    await tab('Compare').click();
    await tab('Translate').click();
    expect(await page.getByLabel('Strength, number').inputValue()).toBe('0.4');
    await output(page);
  });

  it('shows a recorded truth beside', async () => {
    await page.getByRole('combobox', { name: 'Compare with' }).selectOption({ label: 'truth' });
    await expect.poll(() => page.evaluate(() => window.strut.stage.actors.value.length)).toBe(3);
  });
});
