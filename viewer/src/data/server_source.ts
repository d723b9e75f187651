// SPDX-License-Identifier: MIT
// The program that serves the page. Every address begins with the page's own, which holds the token.
import { Clip } from './clip';
import { isGone } from './connection';
import { type Container, readContainer } from './container';
import { type Alignment, type Source, SourceError } from './source';
import type { AlignmentHeader, ClipHeader, Problem, SessionInfo } from './types';

const GONE: Problem = {
  message: 'The program does not answer any more.',
  hint: 'Start `strut view` again with the same files and open the address it prints; nothing that was saved is lost.',
};

/** Asks the program for `path`. Throws SourceError if it refuses or does not answer. */
export async function request(path: string, init: RequestInit = {}): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(`api/${path}`, init);
  } catch (error) {
    if (init.signal?.aborted) throw error;
    isGone.value = true;
    throw new SourceError(GONE, true);
  }
  isGone.value = false;
  if (answer.ok) return answer;
  const text = await answer.text();
  try {
    throw new SourceError((JSON.parse(text) as { problem: Problem }).problem);
  } catch (error) {
    if (error instanceof SourceError) throw error;
    throw new SourceError({ message: text || answer.statusText });
  }
}

export async function getJson<T>(path: string): Promise<T> {
  return (await request(path)).json() as Promise<T>;
}

export async function sendJson(method: 'POST' | 'PUT', path: string, body: unknown): Promise<Response> {
  return request(path, {
    method,
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
  });
}

export async function getContainer<Header>(path: string): Promise<Container<Header>> {
  return readContainer<Header>(await (await request(path)).arrayBuffer());
}

export class ServerSource implements Source {
  session(): Promise<SessionInfo> {
    return getJson('session');
  }
  async clip(id: string): Promise<Clip> {
    return new Clip(await getContainer<ClipHeader>(`clips/${id}`));
  }
  async curve(clip: string, name: string): Promise<Float32Array> {
    const { arrays } = await getContainer(`clips/${clip}/curve?name=${encodeURIComponent(name)}`);
    return arrays.values ?? new Float32Array();
  }
  async alignment(reference: string, clip: string): Promise<Alignment> {
    const { header, arrays } = await getContainer<AlignmentHeader>(`alignment?reference=${reference}&clip=${clip}`);
    return { ...header, moments: arrays.moments ?? new Float32Array() };
  }
}
