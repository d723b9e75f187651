// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { Pace, spanInWords } from './pace';

describe('Pace', () => {
  it('says nothing before a few labels were given', () => {
    const pace = new Pace();
    pace.add(10);
    pace.add(10);
    expect(pace.estimate(5)).toBeNull();
  });

  it('goes by the median and leaves breaks out', () => {
    const pace = new Pace();
    for (const seconds of [8, 10, 12, 60, 3600]) pace.add(seconds);
    expect(pace.estimate(10)).toBe(120);
  });

  it('forgets how it began', () => {
    const pace = new Pace();
    for (let i = 0; i < 20; ++i) pace.add(100);
    for (let i = 0; i < 20; ++i) pace.add(10);
    expect(pace.estimate(1)).toBe(10);
  });
});

describe('spanInWords', () => {
  it('rounds up to minutes', () => {
    expect(spanInWords(20)).toBe('1 minute');
    expect(spanInWords(61)).toBe('2 minutes');
    expect(spanInWords(3700)).toBe('1 h 2 min');
  });
});
