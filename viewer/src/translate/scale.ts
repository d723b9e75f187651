// SPDX-License-Identifier: MIT
// Where a number lies on its slider, from 0 to 1: in proportion; by its logarithm where the range spans orders of magnitude
// from above zero; and with more room for small numbers where a wide range begins at zero.

interface Range {
  least: number;
  greatest: number;
}

const WIDE = 10;
const DIGITS = 3;
const CUBE = 3;

const isLogarithmic = ({ least, greatest }: Range) => least > 0 && greatest / least > WIDE;
const isCubic = ({ least, greatest }: Range) => least === 0 && greatest > WIDE;

export function positionOf(value: number, range: Range): number {
  const { least, greatest } = range;
  const at = Math.min(Math.max(value, least), greatest);
  if (isLogarithmic(range)) return Math.log(at / least) / Math.log(greatest / least);
  const share = (at - least) / (greatest - least);
  return isCubic(range) ? Math.cbrt(share) : share;
}

/** Rounded to what a person would write. */
export function valueAt(position: number, range: Range): number {
  const { least, greatest } = range;
  if (isLogarithmic(range)) return Number((least * (greatest / least) ** position).toPrecision(DIGITS));
  const share = isCubic(range) ? position ** CUBE : position;
  return Number((least + share * (greatest - least)).toFixed(2));
}
