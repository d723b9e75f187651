// SPDX-License-Identifier: MIT
// The program's answers about the labels of one database.
import { Clip } from '../data/clip';
import { getContainer, getJson, sendJson } from '../data/server_source';
import type { ClipHeader } from '../data/types';
import type { LabelProgress, LabelSaid, UndoSaid } from './types';

export interface LabelServer {
  progress(rater: string): Promise<LabelProgress>;
  movement(rater: string, item: string): Promise<Clip>;
  /** Stored when this returns. May be repeated: nothing is stored twice. */
  store(label: LabelSaid): Promise<LabelProgress>;
  /** May be repeated, too. */
  undo(said: UndoSaid): Promise<LabelProgress>;
}

export function labelServer(database: string): LabelServer {
  const path = `labels/${encodeURIComponent(database)}`;
  const asked = (rater: string) => `?rater=${encodeURIComponent(rater)}`;
  return {
    progress: (rater) => getJson(path + asked(rater)),
    movement: async (rater, item) =>
      new Clip(await getContainer<ClipHeader>(`${path}/items/${encodeURIComponent(item)}${asked(rater)}`)),
    store: async (label) => (await sendJson('POST', path, label)).json() as Promise<LabelProgress>,
    undo: async (said) => (await sendJson('POST', `${path}/undo`, said)).json() as Promise<LabelProgress>,
  };
}
