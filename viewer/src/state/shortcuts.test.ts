// SPDX-License-Identifier: MIT
import { afterEach, describe, expect, it, vi } from 'vitest';
import { handleKey, type KeyPress, nameOf, registerShortcut, shortcuts } from './shortcuts';

function press(key: string, more: Partial<KeyPress> = {}): KeyPress {
  const none = { ctrlKey: false, altKey: false, metaKey: false, shiftKey: false, defaultPrevented: false };
  return { key, ...none, target: null, preventDefault: vi.fn(), ...more };
}

/** An element that matches the first selector only if it is named in it. */
function element(name: string) {
  return { matches: (selector: string) => selector.split(/,\s*(?![^(]*\))/).some((part) => part.startsWith(name)) };
}

function register(keys: string | string[], when?: () => boolean) {
  const action = vi.fn();
  registerShortcut({ keys, description: 'a', group: 'b', action, when });
  return action;
}

afterEach(() => {
  shortcuts.value = [];
});

describe('shortcuts', () => {
  it('name keys with what is held down', () => {
    expect(nameOf(press(' '))).toBe('Space');
    expect(nameOf(press('?', { shiftKey: true }))).toBe('?');
    expect(nameOf(press('L', { shiftKey: true }))).toBe('Shift+l');
    expect(nameOf(press('ArrowLeft', { shiftKey: true }))).toBe('Shift+ArrowLeft');
    expect(nameOf(press('s', { metaKey: true }))).toBe('Ctrl+s');
  });

  it('do what was registered, and keep the browser from its own', () => {
    const action = register(['i', 'I']);
    const event = press('I');
    handleKey(event);
    expect(action).toHaveBeenCalledOnce();
    expect(event.preventDefault).toHaveBeenCalledOnce();
  });

  it('leave other keys to the browser', () => {
    register('i');
    const event = press('o');
    handleKey(event);
    expect(event.preventDefault).not.toHaveBeenCalled();
  });

  it('of two the latest counts, until it is taken back', () => {
    const first = register('Space');
    const second = vi.fn();
    const undo = registerShortcut({ keys: 'Space', description: 'a', group: 'b', action: second });
    handleKey(press(' '));
    undo();
    handleKey(press(' '));
    expect(second).toHaveBeenCalledOnce();
    expect(first).toHaveBeenCalledOnce();
  });

  it('one that does not work now lets an earlier one through', () => {
    const general = register('Enter');
    const special = register('Enter', () => false);
    handleKey(press('Enter'));
    expect(general).toHaveBeenCalledOnce();
    expect(special).not.toHaveBeenCalled();
  });

  it('are off while a person types', () => {
    const action = register(['i', 'Space']);
    handleKey(press('i', { target: element('textarea') }));
    handleKey(press(' ', { target: element('input:not') }));
    expect(action).not.toHaveBeenCalled();
  });

  it('leave a control its own keys and take the others', () => {
    const action = register(['Space', 'ArrowRight', 'i']);
    handleKey(press(' ', { target: element('button') }));
    handleKey(press('ArrowRight', { target: element('input[type=range]') }));
    expect(action).not.toHaveBeenCalled();
    handleKey(press('ArrowRight', { target: element('button') }));
    handleKey(press('i', { target: element('input[type=range]') }));
    expect(action).toHaveBeenCalledTimes(2);
  });

  it('leave alone what was dealt with already', () => {
    const action = register('i');
    handleKey(press('i', { defaultPrevented: true }));
    expect(action).not.toHaveBeenCalled();
  });
});
