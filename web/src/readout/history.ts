// The last half minute of a figure, and what it was before and after the last change of the simulation.

/** What sparklines show. */
export const kHistoryMilliseconds = 30_000;
/** Before and after a change are medians over at most this time. */
const kCompareMilliseconds = 10_000;
/** Statistics come a few times a second; a server that sends many more is thinned out. */
const kMostSamples = 600;

export interface Sample {
  readonly at: number;
  readonly value: number;
}

export class History {
  private samples: Sample[] = [];
  private before: number | undefined;
  private changedAt = -Infinity;

  add(at: number, value: number): void {
    if (!Number.isFinite(value)) return;
    this.samples.push({ at, value });
    const from = at - kHistoryMilliseconds;
    const first = this.samples.findIndex((sample) => sample.at >= from);
    this.samples = this.samples.slice(Math.max(first, this.samples.length - kMostSamples));
  }

  /** The simulation changed at `at`. Changes in a row, as of a slider that is dragged, count as one. */
  mark(at: number, joinsLast: boolean): void {
    if (!joinsLast) this.before = median(this.between(Math.max(this.changedAt, at - kCompareMilliseconds), at));
    this.changedAt = at;
  }

  clear(): void {
    this.samples = [];
    this.before = undefined;
    this.changedAt = -Infinity;
  }

  get all(): readonly Sample[] {
    return this.samples;
  }

  get last(): number | undefined {
    return this.samples.at(-1)?.value;
  }

  /** Median before the last change; undefined where there was none. */
  get beforeChange(): number | undefined {
    return this.before;
  }

  /** Median since the last change, of its last seconds. */
  get sinceChange(): number | undefined {
    const end = this.samples.at(-1)?.at ?? 0;
    return median(this.between(Math.max(this.changedAt, end - kCompareMilliseconds), end));
  }

  private between(from: number, to: number): number[] {
    return this.samples.filter(({ at }) => at > from && at <= to).map(({ value }) => value);
  }
}

function median(values: readonly number[]): number | undefined {
  const sorted = [...values].sort((a, b) => a - b);
  const upper = sorted[Math.floor(sorted.length / 2)];
  const lower = sorted[Math.ceil(sorted.length / 2) - 1];
  return upper === undefined || lower === undefined ? undefined : (upper + lower) / 2;
}
