// SPDX-License-Identifier: MIT
// Debian's Chromium, drawing in software and calling nobody.
import { type Browser, chromium, type Page } from 'playwright-core';
import { watch } from './failures';

const FLAGS = [
  '--no-sandbox', // CI runs as root
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

export async function startChromium(): Promise<Browser> {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
}

export interface Opened {
  page: Page;
  /** What went wrong in the page, which the test expects to be nothing. */
  errors: string[];
}

/** A page at `address`, on a laptop's screen unless told otherwise. */
export async function openPage(
  browser: Browser,
  address: string,
  options: Parameters<Browser['newContext']>[0] = {},
): Promise<Opened> {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, ...options });
  const page = await context.newPage();
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  watch(page, errors);
  await page.goto(address);
  return { page, errors };
}

/** Waits until `count` clips have been loaded. */
export async function waitForClips(page: Page, count: number): Promise<void> {
  await page.waitForFunction((n) => window.strut.session.clips.value.length >= n, count);
}

/** The time of the page's clock [s]. */
export async function timeOf(page: Page): Promise<number> {
  return page.evaluate(() => window.strut.playback.time.value);
}
