// SPDX-License-Identifier: MIT
// How long labels take, and so how long the rest will: the median of the last ones, breaks left out.

/** The last labels that count. */
const WINDOW = 20;
/** Fewer tell nothing. */
const FEWEST = 3;
/** Longer than this is taken for a break [s]. */
const BREAK = 180;

export class Pace {
  private readonly seconds: number[] = [];

  add(seconds: number): void {
    if (seconds > 0 && seconds < BREAK) this.seconds.push(seconds);
    if (this.seconds.length > WINDOW) this.seconds.shift();
  }

  /** For `count` more labels [s]; nothing while too few were given. */
  estimate(count: number): number | null {
    if (this.seconds.length < FEWEST) return null;
    const sorted = [...this.seconds].sort((a, b) => a - b);
    return count * sorted[Math.floor(sorted.length / 2)]!;
  }
}

/** A length of time as people say it. */
export function spanInWords(seconds: number): string {
  const minutes = Math.ceil(seconds / 60);
  if (minutes < 1) return 'nothing';
  if (minutes < 60) return minutes === 1 ? '1 minute' : `${minutes} minutes`;
  const hours = Math.floor(minutes / 60);
  const rest = minutes - 60 * hours;
  return `${hours} h ${rest} min`;
}
