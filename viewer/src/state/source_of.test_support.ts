// SPDX-License-Identifier: MIT
// For tests: a program that answers as it is told.
import type { Clip } from '../data/clip';
import { type Alignment, type Source, SourceError } from '../data/source';
import type { FileEntry, SessionInfo } from '../data/types';
import { clipOf } from './clip_of.test_support';

export function fileOf(id: string, more: Partial<FileEntry> = {}): FileEntry {
  return { id, kind: 'clip', name: `${id}.bvh`, path: `/motions/${id}.bvh`, ...more };
}

/** A file called bad cannot be read or aligned. While it is gone it does not answer. */
export class ToldSource implements Source {
  isGone = false;
  readonly asked: string[] = [];
  constructor(public info: SessionInfo) {}

  private note(question: string): void {
    if (this.isGone) throw new SourceError({ message: 'no answer' }, true);
    this.asked.push(question);
    if (question.includes('bad')) throw new SourceError({ message: 'bad.bvh:3:7: no number' });
  }
  async session(): Promise<SessionInfo> {
    this.note('session');
    return this.info;
  }
  async clip(id: string): Promise<Clip> {
    this.note(id);
    return clipOf(id, 31, 30);
  }
  async curve(): Promise<Float32Array> {
    return new Float32Array();
  }
  async alignment(reference: string, clip: string): Promise<Alignment> {
    this.note(`${reference} ${clip}`);
    return { reference, clip, method: 'told', warnings: [], moments: new Float32Array([0, Number.NaN, 2]) };
  }
}
