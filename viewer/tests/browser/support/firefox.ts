// SPDX-License-Identifier: MIT
// Debian's Firefox, spoken to by WebDriver BiDi. Without a window Firefox has no WebGL here, so it gets one on a virtual
// screen.
import { type ChildProcess, spawn } from 'node:child_process';
import puppeteer, { type Browser, type Page } from 'puppeteer-core';
import { watch } from './failures';

/** A virtual screen of its own, ended with the browser. */
async function startScreen(): Promise<{ process: ChildProcess; name: string }> {
  const process = spawn('Xvfb', ['-displayfd', '3', '-screen', '0', '1600x1000x24', '-nolisten', 'tcp'], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe'],
  });
  const name = await new Promise<string>((found, failed) => {
    process.stdio[3]?.on('data', (bytes: Buffer) => found(`:${bytes.toString().trim()}`));
    process.on('error', failed);
    process.on('exit', (code) => failed(new Error(`Xvfb ended with ${code}`)));
  });
  return { process, name };
}

export interface Firefox {
  browser: Browser;
  stop(): Promise<void>;
}

export async function startFirefox(scheme: 'light' | 'dark' = 'light'): Promise<Firefox> {
  const screen = await startScreen();
  const browser = await puppeteer.launch({
    browser: 'firefox',
    executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr',
    headless: false,
    defaultViewport: { width: 1366, height: 768 },
    env: { ...process.env, DISPLAY: screen.name, LIBGL_ALWAYS_SOFTWARE: '1' },
    extraPrefsFirefox: {
      'webgl.force-enabled': true, // drawn in software
      'layout.css.prefers-color-scheme.content-override': scheme === 'dark' ? 0 : 1,
    },
  });
  return {
    browser,
    async stop() {
      await browser.close();
      screen.process.kill();
    },
  };
}

/** A page at `address`; what goes wrong in it, which the test expects to be nothing; all that it asks for. */
export async function openInFirefox(
  firefox: Firefox,
  address: string,
): Promise<{ page: Page; errors: string[]; asked: string[] }> {
  const page = await firefox.browser.newPage();
  const errors: string[] = [];
  const asked: string[] = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  page.on('request', (request) => asked.push(request.url()));
  watch(page, errors);
  await page.goto(address);
  return { page, errors, asked };
}
