// SPDX-License-Identifier: MIT
// The program under test: $STRUT_PROGRAM, or the release build. Started as a person starts it, ended by its id.
import { type ChildProcess, execFile, spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), '../../../..');
export const PROGRAM = process.env.STRUT_PROGRAM ?? join(ROOT, 'build/release/strut');
/** Where tests write; ignored by git. */
export const OUTPUT = join(ROOT, 'viewer/tests/output');
/** What `strut demo` makes: normal_N.bvh, limp_N.bvh, pairs.toml, limp.strut, input.bvh, output.bvh, truth.bvh. */
export const DEMO = join(OUTPUT, 'demo');

const REAL = join(process.env.STRUT_DATA ?? join(ROOT, '../shared/data'), 'bandai-namco');
/** Whether recorded clips are there; tests that need them are skipped otherwise. */
export const HAS_REAL_CLIPS = existsSync(REAL);

/** A recorded clip, e.g. realClip('walk_normal', 1). */
export function realClip(what: string, take: number): string {
  return join(REAL, `dataset-2_${what}_${String(take).padStart(3, '0')}.bvh`);
}

/** Runs the program to its end; what it prints on standard output. Throws with what it said if it fails. */
export async function run(...words: string[]): Promise<string> {
  return (await promisify(execFile)(PROGRAM, words, { maxBuffer: 1 << 28 })).stdout;
}

/** `strut view`, serving. */
export class View {
  private constructor(
    private readonly process: ChildProcess,
    readonly address: string,
  ) {}

  /** Starts it on files and further options; waits for the address. */
  static async start(...words: string[]): Promise<View> {
    const child = spawn(PROGRAM, ['view', '--no-browser', ...words], { stdio: ['ignore', 'pipe', 'pipe'] });
    let printed = '';
    let said = '';
    child.stderr.on('data', (bytes: Buffer) => {
      said += bytes.toString();
    });
    const address = await new Promise<string>((found, failed) => {
      child.stdout.on('data', (bytes: Buffer) => {
        printed += bytes.toString();
        const match = /http:\/\/127\.0\.0\.1:\d+\/\S+/.exec(printed);
        if (match) found(match[0]);
      });
      child.on('exit', (code) => failed(new Error(`strut view ended with ${code}: ${said}`)));
    });
    return new View(child, address);
  }

  /** Ends it, at once with SIGKILL; waits until it is gone. */
  async stop(signal: NodeJS.Signals = 'SIGTERM'): Promise<void> {
    if (this.process.exitCode !== null || this.process.signalCode !== null) return;
    const gone = new Promise((done) => this.process.once('exit', done));
    this.process.kill(signal);
    await gone;
  }
}
