// SPDX-License-Identifier: MIT
/** Lets the browser save `content` as a file. */
export function download(name: string, content: Blob): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  // The browser takes the address over at once, but not within the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
