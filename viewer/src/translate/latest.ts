// SPDX-License-Identifier: MIT
// Questions of which only the newest matters, as while a slider is dragged: one is on its way at a time, and the newest of
// those that came meanwhile goes next. Answers are told in order, so that the result follows the hand.

export class Latest<Question, Answer> {
  private pending: { question: Question } | null = null;
  private running: AbortController | null = null;

  constructor(
    private readonly ask: (question: Question, signal: AbortSignal) => Promise<Answer>,
    private readonly tell: (question: Question, answer: Answer) => void,
    private readonly fail: (question: Question, error: unknown) => void,
  ) {}

  get isBusy(): boolean {
    return this.running !== null;
  }

  /** Asks, at once or when the answer that is awaited has come. */
  put(question: Question): void {
    this.pending = { question };
    if (!this.running) void this.work();
  }

  /** Drops what is awaited and what waits: nobody wants to know any more. */
  drop(): void {
    this.pending = null;
    this.running?.abort();
    this.running = null;
  }

  private async work(): Promise<void> {
    const mine = new AbortController();
    this.running = mine;
    while (this.pending && this.running === mine) {
      const { question } = this.pending;
      this.pending = null;
      await this.one(question, mine);
    }
    if (this.running === mine) this.running = null;
  }

  private async one(question: Question, mine: AbortController): Promise<void> {
    try {
      const answer = await this.ask(question, mine.signal);
      if (this.running === mine) this.tell(question, answer);
    } catch (error) {
      if (this.running === mine) this.fail(question, error);
    }
  }
}
