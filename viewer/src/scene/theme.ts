// SPDX-License-Identifier: MIT
// The page's colours as numbers, and when they change: with the system's light or dark, or by the page's own switch.
import { Color } from 'three';

export interface Theme {
  left: Color;
  right: Color;
  centre: Color;
  text: Color;
  page: Color;
  rule: Color;
  soft: Color;
  accent: Color;
  isDark: boolean;
  /** By Actor.colour, beginning again after the last. */
  clips: readonly Color[];
}

const NUM_CLIP_COLOURS = 6;

/** Resolves the variables where `element` is: light-dark() has no value of its own until a colour is made of it. */
export function readTheme(element: HTMLElement): Theme {
  const probe = document.createElement('span');
  element.append(probe);
  const colour = (name: string) => {
    probe.style.color = `var(--${name})`;
    return new Color(getComputedStyle(probe).color);
  };
  const clips = Array.from({ length: NUM_CLIP_COLOURS }, (_, i) => colour(`clip-${i}`));
  const names = ['left', 'right', 'centre', 'text', 'page', 'rule', 'soft', 'accent'] as const;
  const named = Object.fromEntries(names.map((name) => [name, colour(name)])) as Omit<Theme, 'clips' | 'isDark'>;
  probe.remove();
  return { ...named, clips, isDark: named.page.getHSL({ h: 0, s: 0, l: 0 }).l < 0.5 };
}

/** Calls `changed` whenever the colours may have changed, until the returned function is called. */
export function watchTheme(changed: () => void): () => void {
  const system = matchMedia('(prefers-color-scheme: dark)');
  system.addEventListener('change', changed);
  const page = new MutationObserver(changed);
  page.observe(document.documentElement, { attributes: true });
  return () => {
    system.removeEventListener('change', changed);
    page.disconnect();
  };
}
