// SPDX-License-Identifier: MIT
/** A file's name, which may be broken after the signs that part its words. */
export function FileName({ name }: { name: string }) {
  const parts = name.split(/(?<=[-_.])(?=[^-_.])/);
  return (
    <span class="file-name">
      {parts.map((part, i) => (
        <span key={i}>
          {part}
          <wbr />
        </span>
      ))}
    </span>
  );
}
