// SPDX-License-Identifier: MIT
// Translating live: from a slider's event to the new result on the stage, for half a minute of motion.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, it } from 'vitest';
import { openPage, startChromium } from '../browser/support/chromium';
import { DEMO, OUTPUT, View } from '../browser/support/program';

const CLIP = join(OUTPUT, 'there_and_back.bvh');
const TIMES = 20;

let browser: Browser;

/** The demo's walk, then the same backwards: twice as long, on the model's skeleton and without a jump. */
function writeThereAndBack(): void {
  const [head, motion] = readFileSync(join(DEMO, 'input.bvh'), 'utf8').split(/^(?=Frames:)/m) as [string, string];
  const [, frameTime, ...rows] = motion.trim().split('\n') as [string, string, ...string[]];
  const all = [...rows, ...rows.slice(0, -1).reverse()];
  writeFileSync(CLIP, `${head}Frames: ${all.length}\n${frameTime}\n${all.join('\n')}\n`);
}

beforeAll(async () => {
  writeThereAndBack();
  browser = await startChromium();
});

afterAll(() => browser.close());

interface Took {
  /** From the event to the result on the stage; from the question to the answer's beginning; all else [ms]. */
  all: number;
  program: number;
  page: number;
}

/** Moves the slider of the strength to a share of its way, and waits for the result. */
async function move(page: Page, share: number): Promise<Took> {
  return page.evaluate(async (to) => {
    const { actors } = window.strut.stage;
    const idNow = () => actors.value.find((actor) => actor.title === 'output')?.clip.id;
    const before = idNow();
    const slider = document.querySelector<HTMLInputElement>('input[type=range][aria-label=Strength]')!;
    slider.value = String(to);
    const begin = performance.now();
    const end = await new Promise<number>((done) => {
      const stop = actors.subscribe(() => {
        if (idNow() === before) return;
        done(performance.now());
        queueMicrotask(() => stop());
      });
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    });
    await new Promise((later) => setTimeout(later, 50)); // what was asked is told by the browser a little later
    const asked = performance.getEntriesByType('resource') as PerformanceResourceTiming[];
    const last = asked.filter((entry) => entry.name.endsWith('/api/translate')).at(-1)!;
    const program = last.responseStart - last.requestStart;
    return { all: end - begin, program, page: end - begin - program };
  }, share);
}

function inWords(values: readonly number[]): string {
  const sorted = [...values].sort((a, b) => a - b);
  const median = (sorted[(sorted.length - 1) >> 1]! + sorted[sorted.length >> 1]!) / 2;
  return `${median.toFixed(0)} / ${sorted.at(-1)!.toFixed(0)}`;
}

async function measure(page: Page, what: string): Promise<void> {
  const took: Took[] = [];
  for (let i = 0; i < TIMES; ++i) took.push(await move(page, 0.1 + (0.8 * ((7 * i) % TIMES)) / TIMES));
  const [all, program, own] = (['all', 'program', 'page'] as const).map((part) =>
    inWords(took.map((one) => one[part])),
  );
  console.log(`| ${what} | ${all} | ${program} | ${own} |`);
}

describe('translating live', () => {
  it('follows a slider', async () => {
    const view = await View.start(CLIP, join(DEMO, 'limp.strut'));
    const { page } = await openPage(browser, view.address);
    await page.waitForFunction(() => window.strut.stage.actors.value.some((actor) => actor.title === 'output'));
    await page.locator('.translate-status', { hasText: 'after the change' }).waitFor();
    console.log(`| ms from a slider to the stage, median / worst of ${TIMES} | in all | program | page |`);
    await measure(page, 'while it stands');
    console.log(`the page says: ${await page.locator('.translate-status').textContent()}`);
    await page.evaluate(() => window.strut.playback.play());
    await measure(page, 'while it plays, drawn in software');
    await page.context().close();
    await view.stop();
  });
});
