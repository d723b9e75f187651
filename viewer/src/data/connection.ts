// SPDX-License-Identifier: MIT
// Whether the program still answers. Everything that asks it notes here what came of it, so that the page says it once.
import { signal } from '@preact/signals';

/** Set when a question went unanswered, until one is answered again. */
export const isGone = signal(false);
