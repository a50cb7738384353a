/** Waits between attempts to connect: growing, bounded, and spread so that many viewers do not return all at once. */
export class Backoff {
  private attempts = 0;

  constructor(
    private readonly firstMilliseconds = 400,
    private readonly growth = 1.6,
    private readonly mostMilliseconds = 5000,
    private readonly random: () => number = Math.random,
  ) {}

  /** The next wait, ms: between 75 % and 100 % of the grown one. */
  next(): number {
    const grown = Math.min(this.mostMilliseconds, this.firstMilliseconds * this.growth ** this.attempts);
    this.attempts += 1;
    return grown * (0.75 + 0.25 * this.random());
  }

  /** After a connection that worked. */
  reset(): void {
    this.attempts = 0;
  }
}
