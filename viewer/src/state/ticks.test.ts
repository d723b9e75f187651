// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { readSeconds, tickName, ticksOf, written } from './ticks';

describe('ticks', () => {
  it('of a short clip on a wide bar mark every frame', () => {
    const { named, fine } = ticksOf(2, 30, 1000);
    expect(named).toEqual([0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6, 1.8, 2].map((x) => expect.closeTo(x)));
    expect(fine).toHaveLength(61);
  });
  it('of ten minutes name whole minutes and are no blur', () => {
    const { named, fine } = ticksOf(600, 30, 900);
    expect(named[1]).toBe(60);
    expect(fine.length).toBeLessThan(150);
  });
  it('are none where there is nothing', () => {
    expect(ticksOf(0, 30, 900).named).toEqual([]);
    expect(ticksOf(3, 30, 0).fine).toEqual([]);
  });
  it('are few however long it lasts', () => {
    expect(ticksOf(1e5, 30, 300).named.length).toBeLessThan(40);
  });
});

describe('names of ticks', () => {
  it('have no more digits than they need', () => {
    expect([0, 0.5, 10, 60, 90, 600].map(tickName)).toEqual(['0 s', '0.5 s', '10 s', '1:00', '1:30', '10:00']);
  });
});

describe('seconds', () => {
  it('are written to the hundredth, with minutes when there are some', () => {
    expect(written(4.256)).toBe('4.26');
    expect(written(64.2)).toBe('1:04.20');
    expect(written(119.999)).toBe('2:00.00');
  });
  it('are read as they are written', () => {
    for (const seconds of [0, 4.25, 64.2, 600]) expect(readSeconds(written(seconds))).toBeCloseTo(seconds);
    expect(readSeconds(' 3,5 s')).toBe(3.5);
    expect(readSeconds('.5')).toBe(0.5);
  });
  it('are not read from anything else', () => {
    for (const text of ['', 'x', '1:', '-3', '1e3', '1:2:3']) expect(readSeconds(text)).toBeNaN();
  });
});
