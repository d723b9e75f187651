// SPDX-License-Identifier: MIT
// A rater labels in the real page, by keys alone; the program is killed in the middle and nothing is lost.
import { execFileSync } from 'node:child_process';
import { readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { openPage, startChromium } from './support/chromium';
import { DEMO, OUTPUT, PROGRAM, run, View } from './support/program';

const DATABASE = join(OUTPUT, 'label.db');
/** Small and without glides: drawing in software is what takes the time here. */
const SCREEN = { viewport: { width: 1200, height: 480 }, reducedMotion: 'reduce' } as const;
const PATIENCE = 180_000;
let browser: Browser;

beforeAll(async () => {
  for (const left of ['', '-journal']) rmSync(DATABASE + left, { force: true });
  await run('effort', 'segment', DATABASE, join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'));
  browser = await startChromium();
});
afterAll(() => browser?.close());

interface Rater {
  rater: string;
  labels: number;
}

/** What the database holds, as another program sees it. */
function labelsOf(rater: string): number {
  const told = execFileSync(PROGRAM, ['effort', 'labels', DATABASE, '--json'], { encoding: 'utf8' });
  const { raters } = JSON.parse(told) as { raters: Rater[] };
  return raters.find((entry) => entry.rater === rater)?.labels ?? 0;
}

/** Waits until `count` labels are said to be given and something can be labelled. */
async function waitForLabels(page: Page, count: number): Promise<void> {
  await page.locator('.label-progress output', { hasText: new RegExp(`^${count} of `) }).waitFor();
  await page.locator('.label-factors:enabled').waitFor();
}

async function startLabelling(page: Page, rater: string): Promise<void> {
  await page.locator('.label-name').waitFor();
  await page.keyboard.type(rater);
  await page.keyboard.press('Enter');
}

/** Flow 0.2 bound, Weight 0.11 light, Time not present. */
async function rate(page: Page): Promise<void> {
  for (const key of ['1', 'ArrowRight', 'ArrowRight', '2', 'ArrowLeft', 'Shift+ArrowLeft', '3', 'x']) {
    await page.keyboard.press(key);
  }
}

async function label(page: Page, count: number): Promise<void> {
  await rate(page);
  await page.keyboard.press('Enter');
  await waitForLabels(page, count);
}

/** The labels themselves, as a table of another program's: which movement, whether again, and what was said. */
async function exported(rater: string): Promise<{ movement: string; said: string }[]> {
  const table = join(OUTPUT, 'label.csv');
  await run('effort', 'labels', DATABASE, '--export', table, '--force');
  const [head, ...rows] = readFileSync(table, 'utf8').trim().split('\n');
  const places = head!.split(',');
  const entries = rows.map((row) => {
    const cells = row.split(',');
    return (name: string) => cells[places.indexOf(name)];
  });
  const movement = ['fragment', 'first', 'second', 'alpha', 'repeat'];
  return entries
    .filter((cell) => cell('rater') === rater)
    .map((cell) => ({
      movement: movement.map(cell).join(' '),
      said: ['flow', 'weight', 'time'].map(cell).join(' '),
    }));
}

describe('labelling', { timeout: PATIENCE }, () => {
  it('takes ten labels by keys, over the death of the program, without loss', async () => {
    let view = await View.start(DATABASE);
    const first = await openPage(browser, view.address, SCREEN);
    await startLabelling(first.page, 'ada');
    await waitForLabels(first.page, 0);
    for (let count = 1; count <= 5; ++count) {
      await label(first.page, count);
      expect(labelsOf('ada')).toBe(count); // before the next one shows
    }
    await rate(first.page);
    await view.stop('SIGKILL');
    await first.page.keyboard.press('Enter');
    await first.page.getByText('This one label is not saved yet').waitFor();
    expect(await first.page.locator('[data-factor=flow] output').textContent()).toBe('0.20 bound');
    expect(labelsOf('ada')).toBe(5);
    await first.page.context().close();

    view = await View.start(DATABASE);
    const second = await openPage(browser, view.address, SCREEN);
    await startLabelling(second.page, 'ada');
    await waitForLabels(second.page, 5);
    for (let count = 6; count <= 7; ++count) await label(second.page, count);
    expect(second.errors).toEqual([]);
    await rate(second.page);
    await second.page.keyboard.press('Enter');
    await view.stop('SIGKILL'); // while it stores, or just before or after
    const stored = labelsOf('ada');
    expect([7, 8]).toContain(stored);
    await second.page.context().close();

    view = await View.start(DATABASE);
    const third = await openPage(browser, view.address, SCREEN);
    await startLabelling(third.page, 'ada');
    await waitForLabels(third.page, stored);
    for (let count = stored + 1; count <= 10; ++count) await label(third.page, count);
    expect(third.errors).toEqual([]);
    await third.page.context().close();
    await view.stop();
    const labels = await exported('ada');
    expect(labels.map(({ said }) => said)).toEqual(Array(10).fill('0.2 -0.11 not present'));
    expect(new Set(labels.map(({ movement }) => movement)).size).toBe(10);
  });

  it('asks for a word on every factor, and undoes', async () => {
    const view = await View.start(DATABASE);
    const { page, errors } = await openPage(browser, view.address, SCREEN);
    await startLabelling(page, 'ada');
    await waitForLabels(page, 10);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Enter');
    await page.getByText('Rate every factor').waitFor();
    expect(labelsOf('ada')).toBe(10);
    await page.keyboard.press('c');
    await page.keyboard.type('unsure 1 x');
    await page.keyboard.press('Enter');
    await label(page, 11);
    await page.keyboard.press('u');
    await waitForLabels(page, 10);
    expect(labelsOf('ada')).toBe(10);
    expect(await page.locator('.label-comment').inputValue()).toBe('unsure 1 x');
    expect(errors).toEqual([]);
    await page.context().close();
    await view.stop();
  });

  it('shows a second rater nothing of the first', async () => {
    const view = await View.start(DATABASE);
    const { page } = await openPage(browser, view.address, SCREEN);
    await startLabelling(page, 'eve');
    await waitForLabels(page, 0);
    expect(await page.locator('.label-panel').textContent()).not.toContain('ada');
    await label(page, 1);
    expect(labelsOf('eve')).toBe(1);
    expect(labelsOf('ada')).toBe(10);
    // This tab goes on as eve, another asks who labels.
    await page.reload();
    await waitForLabels(page, 1);
    const other = await openPage(browser, view.address, SCREEN);
    await other.page.locator('.label-name').waitFor();
    await other.page.context().close();
    await page.context().close();
    await view.stop();
  });
});
