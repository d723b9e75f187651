// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { DRAWING_LEVELS, LevelChooser, LIGHTEST } from './drawing_level';

/** What a picture takes at each level [ms]. */
type Machine = (level: number) => number;

const FAST: Machine = () => 16.7;
/** Smooth from level 4 on. */
const SLOW: Machine = (level) => (level < 4 ? 60 - 8 * level : 16.7);

/** Plays for `seconds`; the level at every picture. */
function play(chooser: LevelChooser, machine: Machine, seconds: number): number[] {
  const levels: number[] = [];
  for (let ms = 0; ms < 1000 * seconds; ms += machine(chooser.level)) {
    levels.push(chooser.add(machine(chooser.level)));
  }
  return levels;
}

function changes(levels: readonly number[]): number {
  return levels.filter((level, i) => i > 0 && level !== levels[i - 1]).length;
}

describe('how much is drawn', () => {
  it('is everything where pictures come in time', () => {
    expect(new Set(play(new LevelChooser(), FAST, 60))).toEqual(new Set([0]));
  });

  it('becomes less within seconds, until pictures come in time', () => {
    expect(play(new LevelChooser(), SLOW, 6).at(-1)).toBe(4);
    expect(play(new LevelChooser(), (level) => 170 - 12 * level, 10).at(-1)).toBe(LIGHTEST);
  });

  it('leaves out a level that makes no difference', () => {
    expect(play(new LevelChooser(2), SLOW, 6)).not.toContain(1);
  });

  it('does not change for one slow picture or a pause', () => {
    const chooser = new LevelChooser();
    play(chooser, FAST, 2);
    chooser.add(120);
    chooser.add(60_000);
    expect(new Set(play(chooser, FAST, 5))).toEqual(new Set([0]));
  });

  it('becomes more again when what was slow is over', () => {
    const chooser = new LevelChooser();
    play(chooser, SLOW, 5);
    expect(play(chooser, FAST, 60).at(-1)).toBe(0);
  });

  it('tries more ever more rarely where that fails', () => {
    const chooser = new LevelChooser();
    play(chooser, SLOW, 10);
    const early = changes(play(chooser, SLOW, 60));
    const late = changes(play(chooser, SLOW, 60));
    expect(early).toBeGreaterThan(0);
    expect(early).toBeLessThan(9);
    expect(late).toBeLessThan(early);
  });

  it('is everything on a display of 30 Hz, as drawing less does not help', () => {
    const chooser = new LevelChooser();
    expect(play(chooser, () => 33.3, 10).at(-1)).toBe(0);
    expect(new Set(play(chooser, () => 33.3, 60))).toEqual(new Set([0]));
  });

  it('stays light where even that is slow, however much other programs slow it down', () => {
    const chooser = new LevelChooser();
    play(chooser, () => 100, 10);
    expect(play(chooser, () => 130, 10).at(-1)).toBe(LIGHTEST);
  });

  it('never draws more at a lighter level', () => {
    DRAWING_LEVELS.slice(1).forEach((level, i) => {
      const before = DRAWING_LEVELS[i]!;
      expect(level.pixels).toBeLessThanOrEqual(before.pixels);
      expect(Number(level.antialias)).toBeLessThanOrEqual(Number(before.antialias));
      expect(Number(level.shadows)).toBeLessThanOrEqual(Number(before.shadows));
      expect(Number(level.fineGrid)).toBeLessThanOrEqual(Number(before.fineGrid));
    });
  });
});
