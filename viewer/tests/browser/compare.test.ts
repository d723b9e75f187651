// SPDX-License-Identifier: MIT
// Comparing clips: playing, scrubbing, stretches, frames, what keeps clips in step, and what a person is told.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { openPage, startChromium, timeOf, waitForClips } from './support/chromium';
import { DEMO, HAS_REAL_CLIPS, OUTPUT, realClip, View } from './support/program';

/** Half a frame of the demo's clips [s]. */
const HALF_A_FRAME = 0.5 / 60;

let browser: Browser;
let view: View;
let page: Page;
let errors: string[];

/** A clip whose third row of numbers is none. */
function malformedClip(): string {
  const path = join(OUTPUT, 'malformed.bvh');
  const joint = 'HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 3 Xposition Yposition Zposition\n}\n';
  writeFileSync(path, `${joint}MOTION\nFrames: 2\nFrame Time: 0.0333333\n0 0 0\n0 what 0\n`);
  return path;
}

/** Waits until that frame of the reference is shown. */
async function waitForFrame(frame: number): Promise<void> {
  await expect.poll(() => page.getByLabel('Frame', { exact: true }).inputValue()).toBe(String(frame));
}

const isPlaying = () => page.evaluate(() => window.strut.playback.isPlaying.value);

async function loopOf(what: Page): Promise<readonly [number, number] | null> {
  return what.evaluate(() => window.strut.playback.loop.value);
}

/** The middle of the bar of the timeline and its ends, in pixels. */
async function barOf(what: Page): Promise<{ left: number; right: number; middle: number; y: number }> {
  const box = (await what.getByRole('slider', { name: 'Time', exact: true }).boundingBox())!;
  return { left: box.x, right: box.x + box.width, middle: box.x + box.width / 2, y: box.y + box.height / 2 };
}

beforeAll(async () => {
  browser = await startChromium();
  view = await View.start(join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'), malformedClip());
});

afterAll(async () => {
  await view.stop();
  await browser.close();
});

beforeEach(async () => {
  ({ page, errors } = await openPage(browser, view.address));
  await waitForClips(page, 2);
});

afterEach(async () => {
  await page.context().close();
});

describe('the clock', () => {
  it('stands until a person plays, and goes on then', async () => {
    await page.waitForTimeout(300); // in which it would have gone on
    expect(await timeOf(page)).toBe(0);
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.3);
    await page.keyboard.press('Space');
    await expect.poll(isPlaying).toBe(false);
    const stopped = await timeOf(page);
    await page.waitForTimeout(200);
    expect(await timeOf(page)).toBe(stopped);
  });

  it('is scrubbed on the whole bar, stands meanwhile and goes on after', async () => {
    const { left, right, middle, y } = await barOf(page);
    const duration = await page.evaluate(() => window.strut.playback.duration.value);
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await page.mouse.move(left + 20, y);
    await page.mouse.down();
    await page.mouse.move(middle, y, { steps: 5 });
    expect(await isPlaying()).toBe(false);
    await expect.poll(() => timeOf(page)).toBeCloseTo(duration / 2, 1);
    await page.mouse.move(right + 200, y - 300);
    await expect.poll(() => timeOf(page)).toBe(duration);
    await page.mouse.move(middle, y);
    await page.mouse.up();
    await expect.poll(isPlaying).toBe(true);
  });

  it('steps by frames of the reference', async () => {
    await page.keyboard.press('ArrowRight');
    await waitForFrame(1);
    await page.keyboard.press('Shift+ArrowRight');
    await waitForFrame(11);
    await page.keyboard.press('ArrowLeft');
    await waitForFrame(10);
    await page.keyboard.press('Home');
    expect(await timeOf(page)).toBe(0);
    await page.keyboard.press('End');
    expect(await timeOf(page)).toBe(await page.evaluate(() => window.strut.playback.duration.value));
  });

  it('goes to the time and the frame that are typed, and leaves nonsense alone', async () => {
    const time = page.getByLabel('Time in seconds');
    await time.fill('0.5');
    await time.press('Enter');
    expect(await timeOf(page)).toBeCloseTo(0.5, 6);
    await time.fill('soon');
    await time.press('Enter');
    expect(await timeOf(page)).toBeCloseTo(0.5, 6);
    await expect.poll(() => time.inputValue()).toBe('0.50');
    const frame = page.getByLabel('Frame', { exact: true });
    await frame.fill('12');
    await frame.press('Enter');
    await waitForFrame(12);
  });

  it('keeps within a stretch', async () => {
    await page.evaluate(() => window.strut.playback.seek(0.2));
    await page.keyboard.press('i');
    await page.evaluate(() => window.strut.playback.seek(0.5));
    await page.keyboard.press('o');
    expect(await loopOf(page)).toEqual([expect.closeTo(0.2), expect.closeTo(0.5)]);
    await page.keyboard.press('Space');
    for (let i = 0; i < 8; ++i) {
      await page.waitForTimeout(100);
      const now = await timeOf(page);
      expect(now).toBeGreaterThanOrEqual(0.2 - HALF_A_FRAME);
      expect(now).toBeLessThanOrEqual(0.5 + HALF_A_FRAME);
    }
    await page.keyboard.press('x');
    expect(await loopOf(page)).toBeNull();
  });

  it('has a stretch whose ends are dragged, and moved by keys', async () => {
    const { left, right, middle, y } = await barOf(page);
    await page.keyboard.down('Shift');
    await page.mouse.move(left + 0.25 * (right - left), y);
    await page.mouse.down();
    await page.mouse.move(middle, y, { steps: 4 });
    await page.mouse.up();
    await page.keyboard.up('Shift');
    const duration = await page.evaluate(() => window.strut.playback.duration.value);
    const [begin, end] = (await loopOf(page))!;
    expect(begin).toBeCloseTo(0.25 * duration, 1);
    expect(end).toBeCloseTo(0.5 * duration, 1);
    await page.getByRole('slider', { name: 'Loop begins' }).press('ArrowRight');
    await expect.poll(async () => (await loopOf(page))![0]).toBeGreaterThan(begin);
    const box = (await page.getByRole('slider', { name: 'Loop ends' }).boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, y);
    await page.mouse.down();
    await page.mouse.move(left + 0.75 * (right - left), y, { steps: 4 });
    await page.mouse.up();
    expect((await loopOf(page))![1]).toBeCloseTo(0.75 * duration, 1);
  });

  it('goes slower and faster', async () => {
    const speed = page.getByLabel('Speed');
    await page.keyboard.press('-');
    await expect.poll(() => speed.inputValue()).toBe('0.75');
    await page.keyboard.press('+');
    await page.keyboard.press('+');
    await expect.poll(() => speed.inputValue()).toBe('1.5');
    await page.keyboard.press('1');
    await expect.poll(() => speed.inputValue()).toBe('1');
  });
});

describe('what is compared', () => {
  it('lies over each other when asked for', async () => {
    await page.keyboard.press('l');
    expect(await page.evaluate(() => window.strut.stage.layout.value)).toBe('overlaid');
  });

  it('is taken off and put on again, and another one becomes the reference', async () => {
    const shown = () => page.evaluate(() => window.strut.stage.actors.value.map((actor) => actor.title));
    const all = await shown();
    expect(all).toHaveLength(2);
    await page.getByRole('button', { name: 'make reference' }).click();
    await expect.poll(shown).toEqual([...all].reverse());
    await page.getByLabel(all[0]!).uncheck();
    await expect.poll(shown).toEqual([all[1]]);
    await page.getByLabel(all[0]!).check();
    await expect.poll(shown).toHaveLength(2);
  });

  it('is kept in step by an alignment', async () => {
    await page.getByRole('button', { name: 'Alignment' }).click();
    await page.waitForFunction(() => window.strut.stage.alignments.value.size === 1);
    const moments = await page.evaluate(() => [...window.strut.stage.alignments.value.values()][0]!.length);
    expect(moments).toBe(await page.evaluate(() => window.strut.stage.actors.value[0]!.clip.numFrames));
    await page.getByText('Aligned by').waitFor();
    await page.getByRole('button', { name: 'Time', exact: true }).click();
    await page.waitForFunction(() => window.strut.stage.alignments.value.size === 0);
  });

  it('names a file that cannot be read, with the place in it', async () => {
    await page.getByText(/malformed\.bvh:11:3/).waitFor();
    expect(await page.title()).toContain('malformed.bvh');
  });
});

describe('the page', () => {
  it('lists its keys under ?, and gives the focus back', async () => {
    await page.getByLabel('Speed').focus();
    await page.getByRole('button', { name: 'Keyboard shortcuts' }).click();
    const list = page.getByRole('dialog');
    for (const group of ['Page', 'Playback', 'Compare', 'View']) await list.getByText(group, { exact: true }).waitFor();
    await page.keyboard.press('Escape');
    // By what it is: for assistive technology it is gone before the page has noticed.
    await page.locator('dialog').waitFor({ state: 'detached' });
    await page.waitForFunction(() => document.activeElement?.getAttribute('aria-label') === 'Keyboard shortcuts');
    await page.keyboard.press('?');
    await list.waitFor();
  });

  it('does nothing with keys that are typed into a field', async () => {
    await page.getByLabel('Time in seconds').focus();
    await page.keyboard.type('?i');
    expect(await page.getByRole('dialog').count()).toBe(0);
    expect(await loopOf(page)).toBeNull();
  });

  it('says once that the program is gone, and goes on where it was', async () => {
    await page.evaluate(() => window.strut.playback.seek(0.5));
    await page.context().setOffline(true);
    await page.getByRole('button', { name: 'Alignment' }).click();
    const gone = page.getByText('does not answer any more').first();
    await gone.waitFor();
    await page.getByRole('button', { name: 'Try again' }).click();
    await gone.waitFor();
    await page.context().setOffline(false);
    await page.getByRole('button', { name: 'Try again' }).click();
    await page.waitForFunction(() => window.strut.stage.alignments.value.size === 1);
    await gone.waitFor({ state: 'detached' });
    expect(await timeOf(page)).toBe(0.5);
  });

  it('makes room, and remembers it', async () => {
    const files = page.getByRole('complementary', { name: 'Files' });
    await page.keyboard.press('[');
    await expect.poll(() => files.count()).toBe(0);
    await page.reload();
    await waitForClips(page, 2);
    expect(await files.count()).toBe(0);
  });

  it('has its columns over the stage on a narrow screen', async () => {
    await page.setViewportSize({ width: 700, height: 800 });
    const controls = page.getByRole('complementary', { name: 'Controls' });
    await controls.waitFor({ state: 'hidden' });
    await page.getByRole('button', { name: 'Controls', exact: true }).click();
    await controls.waitFor();
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(700);
  });
});

/** Files that are no clips, or not all of one, each with what the page has to say of it. */
function malformedClips(): [path: string, said: RegExp][] {
  const write = (name: string, content: string | Buffer): string => {
    const path = join(OUTPUT, name);
    writeFileSync(path, content);
    return path;
  };
  const whole = readFileSync(realClip('walk_normal', 3));
  return [
    [malformedClip(), /malformed\.bvh:11:3/],
    [write('empty.bvh', ''), /empty\.bvh:1/],
    [write('noise.bvh', Buffer.from(Array.from({ length: 4096 }, (_, i) => (i * 7919) % 256))), /noise\.bvh:1/],
    [write('cut.bvh', whole.subarray(0, whole.length / 2)), /cut\.bvh:\d+: the last row is cut off/],
  ];
}

describe.skipIf(!HAS_REAL_CLIPS)('recorded clips', () => {
  let real: View;
  const open = async (...files: string[]) => {
    real = await View.start(...files);
    await page.goto(real.address);
  };
  afterEach(() => real.stop());

  it('play while what is wrong with the files beside them is told', async () => {
    const malformed = malformedClips();
    const clips = [1, 2, 4].map((take) => realClip('walk_normal', take));
    await open(clips[0]!, ...malformed.map(([path]) => path), ...clips.slice(1));
    const shown = clips.length + 1; // what is there of the one that was cut off
    await page.waitForFunction((count) => window.strut.stage.actors.value.length === count, shown);
    for (const [, said] of malformed) await page.getByText(said).first().waitFor({ state: 'attached' });
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.3);
    expect(await page.evaluate(() => window.strut.stage.actors.value.length)).toBe(shown);
  });

  it('play side by side without a word of trouble', async () => {
    await open(realClip('walk_normal', 1), realClip('walk_elderly', 2));
    await waitForClips(page, 2);
    errors.length = 0; // of the page before
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.strut.playback.time.value > 0.5);
    await page.getByRole('button', { name: 'Alignment' }).click();
    await page.waitForFunction(() => window.strut.stage.alignments.value.size === 1);
    expect(errors).toEqual([]);
  });
});
