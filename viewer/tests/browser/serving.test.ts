// SPDX-License-Identifier: MIT
// Who gets to see the page: whoever has its address, in their own browser, and nobody else.
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { join } from 'node:path';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { openPage, startChromium, waitForClips } from './support/chromium';
import { DEMO, View } from './support/program';

let browser: Browser;
let view: View;
/** Another site on the same machine. */
let other: Server;

beforeAll(async () => {
  browser = await startChromium();
  view = await View.start(join(DEMO, 'input.bvh'), join(DEMO, 'output.bvh'));
  other = createServer((_, answer) => answer.setHeader('Content-Type', 'text/html').end('<title>other</title>'));
  await new Promise<void>((done) => other.listen(0, '127.0.0.1', done));
});

afterAll(async () => {
  other.close();
  await view.stop();
  await browser.close();
});

describe('the page', () => {
  it('loads its clips and asks nobody but the program', async () => {
    const { page, errors } = await openPage(browser, 'about:blank');
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    await page.goto(view.address);
    await waitForClips(page, 2);
    expect(asked.filter((url) => !url.startsWith(view.address) && !url.startsWith('data:'))).toEqual([]);
    expect(errors).toEqual([]);
    await page.context().close();
  });

  it('is refused without the token', async () => {
    const { origin } = new URL(view.address);
    for (const path of ['/', '/api/session', `/${'0'.repeat(48)}/`, `/${'0'.repeat(48)}/api/session`]) {
      const answer = await fetch(origin + path);
      expect(answer.status, path).toBe(403);
      expect(await answer.text()).not.toContain('clip');
    }
  });

  it('is refused to another origin, which cannot read or change anything', async () => {
    const { page } = await openPage(browser, `http://127.0.0.1:${(other.address() as AddressInfo).port}/`);
    const tried = await page.evaluate(async (address) => {
      const ask = async (init?: RequestInit) => {
        try {
          return (await fetch(`${address}api/session`, init)).status;
        } catch {
          return 'blocked';
        }
      };
      return [await ask(), await ask({ method: 'POST', body: '{}' })];
    }, view.address);
    expect(tried).toEqual(['blocked', 'blocked']);
    await page.context().close();
  });

  it('is not shown inside a page of another site', async () => {
    const { page } = await openPage(browser, `http://127.0.0.1:${(other.address() as AddressInfo).port}/`);
    // What the browser shows instead of a refused page loads, too.
    await page.evaluate(async (address) => {
      const frame = document.createElement('iframe');
      frame.src = address;
      const hasLoaded = new Promise((done) => frame.addEventListener('load', done));
      document.body.append(frame);
      await hasLoaded;
    }, view.address);
    const inner = page.frames().find((frame) => frame !== page.mainFrame());
    expect(await inner?.locator('#app').count()).toBeFalsy();
    await page.context().close();
  });
});
