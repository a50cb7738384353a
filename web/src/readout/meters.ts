// Figures over the last second: how often frames are drawn, and how long after an input.

const kWindowMilliseconds = 1000;

interface Sample {
  readonly at: number;
  readonly value: number;
}

/** Values of the last second. Times are on the clock of performance.now(). */
export class Window {
  private samples: Sample[] = [];

  add(at: number, value = 1): void {
    this.samples.push({ at, value });
    this.expire(at);
  }

  /** How many values came in the second before `now`. */
  count(now: number): number {
    this.expire(now);
    return this.samples.length;
  }

  sum(now: number): number {
    this.expire(now);
    return this.samples.reduce((total, { value }) => total + value, 0);
  }

  median(now: number): number | undefined {
    this.expire(now);
    const sorted = this.samples.map(({ value }) => value).sort((a, b) => a - b);
    const upper = sorted[Math.floor(sorted.length / 2)];
    const lower = sorted[Math.ceil(sorted.length / 2) - 1];
    return upper === undefined || lower === undefined ? undefined : (upper + lower) / 2;
  }

  clear(): void {
    this.samples = [];
  }

  private expire(now: number): void {
    const first = this.samples.findIndex(({ at }) => at > now - kWindowMilliseconds);
    if (first !== 0) this.samples = first < 0 ? [] : this.samples.slice(first);
  }
}

/** From a person's input to the first drawn frame that shows it. */
export class DelayMeter {
  private readonly waiting = new Map<number, number>();
  private readonly delays = new Window();

  /** An input made at `inputTime` left as message `sequence`. */
  sent(sequence: number, inputTime: number): void {
    if (sequence > 0) this.waiting.set(sequence, inputTime);
  }

  /** A frame was drawn that shows message `reflects` and, with it, all earlier ones. */
  drawn(reflects: number, now: number): void {
    for (const [sequence, inputTime] of this.waiting) {
      if (sequence > reflects) continue;
      this.waiting.delete(sequence);
      this.delays.add(now, now - inputTime);
    }
  }

  /** Median over the last second, ms. */
  median(now: number): number | undefined {
    return this.delays.median(now);
  }

  /** A message was refused, and no frame will show it. */
  refused(sequence: number): void {
    this.waiting.delete(sequence);
  }

  forget(): void {
    this.waiting.clear();
    this.delays.clear();
  }
}
