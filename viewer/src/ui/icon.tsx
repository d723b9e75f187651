// SPDX-License-Identifier: MIT
// The page's few drawn signs, 16 units square, in the colour of the text. They stand in buttons that say what they do.
const PATHS = {
  play: 'M4 2.5v11l9-5.5z',
  pause: 'M3.5 2.5h3.2v11H3.5zM9.3 2.5h3.2v11H9.3z',
  back: 'M11 3v10L4 8zM12 3h1.5v10H12z',
  on: 'M5 3v10l7-5zM2.5 3H4v10H2.5z',
  first: 'M2.5 3h1.8v10H2.5zM13.5 3v10L5 8z',
  last: 'M11.7 3h1.8v10h-1.8zM2.5 3v10L11 8z',
  repeat: 'M4 6V5a2 2 0 0 1 2-2h6M10 1l2.2 2L10 5M12 10v1a2 2 0 0 1-2 2H4M6 15l-2.2-2L6 11',
  close: 'M4 4l8 8M12 4l-8 8',
  left: 'M2 3h12v10H2zM6 3v10',
  right: 'M2 3h12v10H2zM10 3v10',
  bottom: 'M2 3h12v10H2zM2 9.5h12',
} as const;

export type IconName = keyof typeof PATHS;

const DRAWN_AS_LINES: ReadonlySet<IconName> = new Set(['repeat', 'close', 'left', 'right', 'bottom']);

export function Icon({ name }: { name: IconName }) {
  const isLine = DRAWN_AS_LINES.has(name);
  return (
    <svg class="icon" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true">
      <path
        d={PATHS[name]}
        fill={isLine ? 'none' : 'currentColor'}
        stroke={isLine ? 'currentColor' : 'none'}
        stroke-width="1.6"
        stroke-linecap="round"
        stroke-linejoin="round"
      />
    </svg>
  );
}
