// SPDX-License-Identifier: MIT
import { afterEach, describe, expect, it, vi } from 'vitest';
import { remembered } from './remembered';

function storage(entries: Record<string, string>) {
  const map = new Map(Object.entries(entries));
  return {
    getItem: (key: string) => map.get(key) ?? null,
    setItem: (key: string, value: string) => void map.set(key, value),
  };
}

afterEach(() => {
  vi.unstubAllGlobals();
});

describe('remembered', () => {
  it('begins with what it was and keeps what it becomes', () => {
    const kept = storage({ 'strut.width': '250' });
    vi.stubGlobal('localStorage', kept);
    const width = remembered('width', 200);
    expect(width.value).toBe(250);
    width.value = 300;
    expect(kept.getItem('strut.width')).toBe('300');
  });

  it('does not believe what is kept under its name by others', () => {
    vi.stubGlobal('localStorage', storage({ 'strut.width': '"wide"', 'strut.open': '{' }));
    expect(remembered('width', 200).value).toBe(200);
    expect(remembered('open', true).value).toBe(true);
  });

  it('works where nothing may be kept', () => {
    const refuse = () => {
      throw new Error('denied');
    };
    vi.stubGlobal('localStorage', { getItem: refuse, setItem: refuse });
    const open = remembered('open', true);
    open.value = false;
    expect(open.value).toBe(false);
  });
});
