// SPDX-License-Identifier: MIT
// How much is drawn where drawing is slow: levels from full to light, and which one the times between pictures ask for.

export interface DrawingLevel {
  /** At most so many pixels per CSS pixel. */
  pixels: number;
  antialias: boolean;
  shadows: boolean;
  /** Fine grid lines. */
  fineGrid: boolean;
}

const ALL = { antialias: true, shadows: true, fineGrid: true };

/** From full to light. More than three pixels per CSS pixel are not seen. */
export const DRAWING_LEVELS: readonly DrawingLevel[] = [
  { ...ALL, pixels: 3 },
  { ...ALL, pixels: 1 },
  { ...ALL, pixels: 1, shadows: false },
  { pixels: 1, antialias: true, shadows: false, fineGrid: false },
  { pixels: 1, antialias: false, shadows: false, fineGrid: false },
  { pixels: 0.7, antialias: false, shadows: false, fineGrid: false },
];
export const LIGHTEST = DRAWING_LEVELS.length - 1;

/** What the level leaves out of the picture, in words. */
export function leftOut(level: number): string[] {
  const { pixels, shadows, fineGrid, antialias } = DRAWING_LEVELS[level]!;
  const words: readonly (readonly [boolean, string])[] = [
    [level > 0 && pixels < 3, pixels < 1 ? 'fine detail' : 'more than one pixel per CSS pixel'],
    [!shadows, 'shadows'],
    [!fineGrid, 'the fine grid of 10 cm'],
    [!antialias, 'smooth edges'],
  ];
  return words.flatMap(([isLeftOut, what]) => (isLeftOut ? [what] : []));
}

/** A mean over SPAN above this is too slow, below the other one smooth [ms]. */
const SLOW = 22;
const SMOOTH = 18;
const SPAN = 500;
/** After a change, pictures wait for programs of the graphics card and are not counted [ms]. */
const SETTLING = 400;
/** What took longer was not drawing: the page was in the background, say [ms]. */
const PAUSE = 2000;
/** So long it has to be smooth before more is tried, and twice as long after every try that failed [ms]. */
const PATIENCE = 8000;
/** A try that is slow within this time has failed [ms]. */
const TRIAL = 4000;
/** Drawing less that leaves this part of the time does not help, if pictures come at the pace of a display that shows
 *  few, e.g. 30 a second to save power [ms]. Where they come more slowly than any display, it is drawing that is slow. */
const NO_HELP = 0.9;
const SLOWEST_DISPLAY = 45;

/** Steps down when pictures come slowly, and up again with growing patience. */
export class LevelChooser {
  level = 0;
  private settling = SETTLING;
  private elapsed = 0;
  private pictures = 0;
  private smooth = 0;
  private patience = PATIENCE;
  private sinceTry = Infinity;
  /** The mean when the first step down was made [ms]. */
  private atFull = 0;
  private isInVain = false;

  /** `first` is the level below the full one that makes a difference here. */
  constructor(private readonly first = 1) {}

  /** Playing begins anew: the next pictures have to settle. */
  restart(): void {
    this.settling = SETTLING;
    this.elapsed = this.pictures = 0;
  }

  /** A picture came `ms` after the one before; the level from now on. */
  add(ms: number): number {
    if (this.isInVain || !(ms > 0 && ms < PAUSE)) return this.level;
    if (this.settling > 0) {
      this.settling -= ms;
      return this.level;
    }
    this.elapsed += ms;
    this.pictures += 1;
    if (this.elapsed >= SPAN) this.judge(this.elapsed / this.pictures);
    return this.level;
  }

  private judge(mean: number): void {
    this.sinceTry += this.elapsed;
    this.smooth = mean < SMOOTH ? this.smooth + this.elapsed : 0;
    this.elapsed = this.pictures = 0;
    if (mean > SLOW) this.less(mean);
    else if (this.level > 0 && this.smooth >= this.patience) this.more();
  }

  private less(mean: number): void {
    if (this.level === 0) this.atFull = mean;
    if (this.sinceTry < TRIAL) this.patience *= 2;
    this.sinceTry = Infinity;
    if (this.level < LIGHTEST) {
      this.go(this.level === 0 ? this.first : this.level + 1);
    } else if (mean > NO_HELP * this.atFull && mean < SLOWEST_DISPLAY) {
      this.isInVain = true;
      this.go(0);
    }
  }

  private more(): void {
    this.sinceTry = 0;
    this.go(this.level === this.first ? 0 : this.level - 1);
  }

  private go(level: number): void {
    this.level = level;
    this.smooth = 0;
    this.restart();
  }
}
