// SPDX-License-Identifier: MIT
// The container in which the program sends numbers: how long the header is (4 bytes, little-endian), the header (JSON,
// padded with blanks to a multiple of four bytes), then the arrays that the header's "arrays" names, each at its byte
// from the end of the header. Written by cli/view/container.h; described in docs/viewer.md.

/** One array of a container's header. */
interface ArrayEntry {
  name: string;
  /** f32: numbers as they are. u16: value = offset + scale * stored, 65535 for "no number". */
  type: 'f32' | 'u16';
  start: number;
  count: number;
  scale?: number;
  offset?: number;
}

export interface Container<Header> {
  header: Header;
  arrays: Record<string, Float32Array>;
}

const NO_NUMBER = 0xffff;

function decode(entry: ArrayEntry, buffer: ArrayBuffer, base: number): Float32Array {
  if (entry.type === 'f32') return new Float32Array(buffer, base + entry.start, entry.count);
  const stored = new Uint16Array(buffer, base + entry.start, entry.count);
  const { scale = 1, offset = 0 } = entry;
  return Float32Array.from(stored, (value) => (value === NO_NUMBER ? Number.NaN : offset + scale * value));
}

/** Reads a container. Throws if the bytes are none. Arrays of f32 are views, not copies. */
export function readContainer<Header>(buffer: ArrayBuffer): Container<Header> {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  const header = JSON.parse(text) as Header & { arrays: ArrayEntry[] };
  const arrays: Record<string, Float32Array> = {};
  for (const entry of header.arrays) arrays[entry.name] = decode(entry, buffer, 4 + length);
  return { header, arrays };
}
