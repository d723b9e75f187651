// SPDX-License-Identifier: MIT
import { effect } from '@preact/signals';
import { useLayoutEffect } from 'preact/hooks';

/** Runs `follow` at once whenever a signal in it changes, so that what it writes is drawn together with what the scene
 *  draws of the same moment; useSignalEffect would be a frame late. `follow` is read once: it looks at signals. */
export function useLive(follow: () => void): void {
  useLayoutEffect(() => effect(follow), []);
}
