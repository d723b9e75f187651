// SPDX-License-Identifier: MIT
// When a test fails, what its pages show: a picture in tests/output, and the text for the log of a machine nobody sits
// at. Loaded before every file of browser tests. With STRUT_PICTURES=1 there are pictures of tests that pass, too.
import { join } from 'node:path';
import { afterEach } from 'vitest';
import { OUTPUT } from './program';

/** A page of Playwright or of Puppeteer. */
interface Shown {
  isClosed(): boolean;
  url(): string;
  screenshot(options: { path: `${string}.png` }): Promise<unknown>;
  evaluate(what: () => string): Promise<string>;
}

/** The pages that a test has opened, and what went wrong in each. */
const watched = new Map<Shown, readonly string[]>();

export function watch(page: Shown, errors: readonly string[]): void {
  watched.set(page, errors);
}

async function tell(page: Shown, errors: readonly string[], path: `${string}.png`): Promise<void> {
  await page.screenshot({ path });
  const text = await page.evaluate(() =>
    (document.querySelector('#app') ?? document.body).textContent.replace(/\s+/g, ' ').slice(0, 1500),
  );
  console.error(`${path}\n${page.url()}\nerrors: ${JSON.stringify(errors)}\ntext: ${text}`);
}

afterEach(async ({ task }) => {
  const hasFailed = task.result?.state === 'fail';
  const what = hasFailed ? 'failed' : 'passed';
  const name = `${task.file.name} ${task.name}`.replace(/^.*\//, '').replace(/[^\w]+/g, '-');
  for (const [i, [page, errors]] of [...watched].entries()) {
    if (page.isClosed()) watched.delete(page);
    else if (hasFailed || process.env.STRUT_PICTURES) {
      // A page that cannot be shown any more must not hide why the test failed.
      await tell(page, errors, `${join(OUTPUT, `${what}-${name}-${i}`)}.png`).catch((error) => console.error(error));
    }
  }
});
