// SPDX-License-Identifier: MIT
// The same page in Firefox: every mode does what it is for, a report opens from disk, and it is dark where the screen is.
import { execFileSync } from 'node:child_process';
import { cpSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import type { Page } from 'puppeteer-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { type Firefox, openInFirefox, startFirefox } from './support/firefox';
import { DEMO, OUTPUT, PROGRAM, run, View } from './support/program';

/** The demo's files, to be changed. */
const FOLDER = join(OUTPUT, 'firefox');
const LIST = join(FOLDER, 'pairs.toml');
const DATABASE = join(FOLDER, 'label.db');
const CLIPS = [join(FOLDER, 'input.bvh'), join(FOLDER, 'output.bvh')];

let firefox: Firefox;
let view: View | undefined;
let page: Page;
let errors: string[];
let asked: string[];

beforeAll(async () => {
  rmSync(FOLDER, { recursive: true, force: true });
  cpSync(DEMO, FOLDER, { recursive: true });
  await run('effort', 'segment', DATABASE, ...CLIPS);
  firefox = await startFirefox();
});

afterEach(async () => {
  await page?.close();
  await view?.stop();
  view = undefined;
});

afterAll(() => firefox?.stop());

/** The page on files, with its first clips on the stage. */
async function open(clips: number, ...files: string[]): Promise<void> {
  view = await View.start(...files);
  ({ page, errors, asked } = await openInFirefox(firefox, view.address));
  await onStage(clips);
}

/** Waits until so many clips are on the stage and were drawn. */
async function onStage(count: number): Promise<void> {
  await page.waitForFunction(
    (least) =>
      window.strut.stage.actors.value.length >= least &&
      Number(document.querySelector<HTMLElement>('.stage')?.dataset.framesDrawn) > 0,
    {},
    count,
  );
}

async function click(text: string): Promise<void> {
  await page.locator(`button ::-p-text(${text})`).click();
}

async function press(...keys: Parameters<Page['keyboard']['press']>[0][]): Promise<void> {
  for (const key of keys) await page.keyboard.press(key);
}

async function textOf(selector: string): Promise<string> {
  return page.$eval(selector, (element) => element.textContent ?? '');
}

/** A point on an element as it is now: the page may make it again at any moment. */
async function middleOf(selector: string, share = 0.5): Promise<[number, number]> {
  await page.waitForSelector(selector);
  const box = await page.$eval(selector, (element) => {
    const { x, y, width, height } = element.getBoundingClientRect();
    return { x, y, width, height };
  });
  return [box.x + share * box.width, box.y + box.height / 2];
}

const timeOf = () => page.evaluate(() => window.strut.playback.time.value);
const durationOf = () => page.evaluate(() => window.strut.playback.duration.value);

describe('comparing in Firefox', () => {
  it('plays clips, over each other and in phase', async () => {
    await open(2, ...CLIPS);
    await press(' ');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.2);
    await click('Overlaid');
    expect(await page.evaluate(() => window.strut.stage.layout.value)).toBe('overlaid');
    await click('Alignment');
    await page.waitForFunction(() => window.strut.stage.alignments.value.size === 1);
    await page.waitForSelector('::-p-text(Aligned by)');
    expect(asked.length).toBeGreaterThan(2); // so that a report, which asks for nothing, is seen to
    expect(errors).toEqual([]);
  });

  it('scrubs by the pointer on the bar, and shows a moment under it in the curves', async () => {
    await open(2, ...CLIPS);
    const [x, y] = await middleOf('[aria-label=Time]', 0.25);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(...(await middleOf('[aria-label=Time]')), { steps: 3 });
    await page.mouse.up();
    const duration = await durationOf();
    expect(await timeOf()).toBeCloseTo(duration / 2, 1);
    await press('c');
    await page.waitForFunction(() => /\d m\/s/.test(document.querySelector('.chart .legend')?.textContent ?? ''));
    await page.mouse.move(...(await middleOf('.chart .u-over', 0.75)));
    await expect.poll(timeOf).toBeCloseTo(0.75 * duration, 1);
    expect(errors).toEqual([]);
  });

  it('lists its keys', async () => {
    await open(2, ...CLIPS);
    await press('?');
    await page.waitForSelector('dialog[open] ::-p-text(Playback)');
    await press('Escape');
    await page.waitForSelector('dialog', { hidden: true });
    await press('?');
    await page.waitForSelector('dialog[open] ::-p-text(Compare)');
    expect(errors).toEqual([]);
  });
});

describe('working in Firefox', () => {
  it('translates as a slider moves', async () => {
    await open(2, CLIPS[0]!, join(FOLDER, 'limp.strut'));
    const idOf = () => page.evaluate(() => window.strut.stage.actors.value[1]?.clip.id);
    const before = await idOf();
    await page.mouse.click(...(await middleOf('input[type=range][aria-label=Strength]', 0.2)));
    await page.waitForFunction((old) => window.strut.stage.actors.value[1]?.clip.id !== old, {}, before);
    const typed = await page.$eval('[aria-label="Strength, number"]', (input) => (input as HTMLInputElement).value);
    expect(Number(typed)).not.toBe(1);
    await page.waitForFunction(() => /\d ms after the change/.test(document.body.textContent ?? ''));
    expect(errors).toEqual([]);
  });

  it('accepts a pair and saves the list', async () => {
    await open(2, LIST);
    await page.waitForSelector('.pair-strips [data-mark]');
    await press('a');
    await page.waitForFunction(() => /not saved/.test(document.querySelector('.pairs-file')?.textContent ?? ''));
    await page.keyboard.down('Control');
    await press('s');
    await page.keyboard.up('Control');
    await expect.poll(() => textOf('.pairs-file [role=status]')).toBe('saved');
    expect(readFileSync(LIST, 'utf8').match(/# accepted/g)).toHaveLength(1);
    expect(errors).toEqual([]);
  });

  it('labels three movements by keys', async () => {
    view = await View.start(DATABASE);
    ({ page, errors, asked } = await openInFirefox(firefox, view.address));
    await page.waitForSelector('.label-name');
    await page.keyboard.type('ada');
    await press('Enter');
    for (let count = 1; count <= 3; ++count) {
      await page.waitForSelector('.label-factors:enabled');
      await press('1', 'ArrowRight', '2', 'ArrowLeft', '3', 'x', 'Enter');
      await page.waitForFunction((n) => document.body.textContent?.includes(`${n} of `), {}, count);
      const { raters } = JSON.parse(
        execFileSync(PROGRAM, ['effort', 'labels', DATABASE, '--json'], { encoding: 'utf8' }),
      );
      expect(raters).toEqual([expect.objectContaining({ rater: 'ada', labels: count })]);
    }
    await page.waitForSelector('.label-factors:enabled');
    await press('1', 'ArrowRight', '2');
    expect(errors).toEqual([]);
  });
});

describe('a report in Firefox', () => {
  it('opens from disk, plays, and asks nobody', async () => {
    const path = join(FOLDER, 'report.html');
    await run('report', ...CLIPS, '-o', path);
    ({ page, errors, asked } = await openInFirefox(firefox, pathToFileURL(path).href));
    await onStage(2);
    await press(' ');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.2);
    expect(asked.filter((url) => !/^(file|data|blob):/.test(url))).toEqual([]);
    expect(errors).toEqual([]);
  });
});

describe('a dark screen', () => {
  let dark: Firefox;
  beforeAll(async () => {
    dark = await startFirefox('dark');
  });
  afterAll(() => dark?.stop());

  it('has a dark page', async () => {
    view = await View.start(...CLIPS, join(FOLDER, 'limp.strut'), LIST);
    ({ page, errors, asked } = await openInFirefox(dark, view.address));
    await onStage(2);
    await press('c');
    await page.waitForFunction(() => /m\/s.*\d m\/s/.test(document.querySelector('.chart .legend')?.textContent ?? ''));
    const colour = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const brightest = Math.max(...colour.match(/\d+/g)!.slice(0, 3).map(Number));
    expect(brightest).toBeLessThan(64);
    expect(errors).toEqual([]);
  });
});
