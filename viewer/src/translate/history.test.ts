// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { changed, type History, redone, undone } from './history';

const start: History<number> = { past: [], now: 0, future: [] };

describe('history', () => {
  it('goes back and forth', () => {
    const two = changed(changed(start, 1, 'a', 0), 2, 'b', 1);
    expect(undone(two).now).toBe(1);
    expect(undone(undone(two)).now).toBe(0);
    expect(redone(undone(two)).now).toBe(2);
    expect(undone(start)).toBe(start);
    expect(redone(two)).toBe(two);
  });

  it('takes a drag as one step, and a later one as another', () => {
    const dragged = [1, 2, 3].reduce((history, value) => changed(history, value, 'a', 100 * value), start);
    expect(undone(dragged).now).toBe(0);
    expect(undone(changed(dragged, 9, 'a', 5000)).now).toBe(3);
  });

  it('forgets what was undone once something else is changed', () => {
    const other = changed(undone(changed(start, 1, 'a', 0)), 5, 'a', 1);
    expect(redone(other).now).toBe(5);
    expect(undone(other).now).toBe(0);
  });
});
