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

/** Where the delay of an input went, ms, on the way that it took. The server's part is by the server's clock. */
export interface DelayParts {
  /** From the input to the message: moves within one animation frame become one. */
  readonly gather: number;
  /** From the arrival of the message to the sending of the frame. */
  readonly server: number;
  /** Both ways on the network, and decoding. */
  readonly travel: number;
  /** From the decoded picture to the screen. */
  readonly draw: number;
}

/** What a drawn frame says about its delay. */
export interface DrawnTimes {
  readonly decodedAt: number;
  readonly drawnAt: number;
  /** Frame.response_milliseconds; 0 where the server says none. */
  readonly response: number;
}

/** From a person's input to the first drawn frame that shows it. */
export class DelayMeter {
  private readonly waiting = new Map<number, { readonly inputTime: number; readonly sentAt: number }>();
  private readonly delays = new Window();
  private readonly parts = { gather: new Window(), server: new Window(), travel: new Window(), draw: new Window() };
  private lastParts: DelayParts | undefined;

  /** An input made at `inputTime` left as message `sequence` at `sentAt`. */
  sent(sequence: number, inputTime: number, sentAt = inputTime): void {
    if (sequence > 0) this.waiting.set(sequence, { inputTime, sentAt });
  }

  /** A frame was drawn that shows message `reflects` and, with it, all earlier ones. */
  drawn(reflects: number, times: DrawnTimes): void {
    for (const [sequence, { inputTime, sentAt }] of this.waiting) {
      if (sequence > reflects) continue;
      this.waiting.delete(sequence);
      this.delays.add(times.drawnAt, times.drawnAt - inputTime);
      if (sequence === reflects && times.response > 0) this.split(times, inputTime, sentAt);
    }
  }

  /** Median over the last second, ms. */
  median(now: number): number | undefined {
    return this.delays.median(now);
  }

  /** Means over the last second with inputs. */
  meanParts(now: number): DelayParts | undefined {
    const mean = (window: Window) => window.sum(now) / window.count(now);
    const { gather, server, travel, draw } = this.parts;
    if (server.count(now) > 0) {
      this.lastParts = { gather: mean(gather), server: mean(server), travel: mean(travel), draw: mean(draw) };
    }
    return this.lastParts;
  }

  /** A message was refused, and no frame will show it. */
  refused(sequence: number): void {
    this.waiting.delete(sequence);
  }

  forget(): void {
    this.waiting.clear();
    this.delays.clear();
    for (const window of Object.values(this.parts)) window.clear();
    this.lastParts = undefined;
  }

  private split({ decodedAt, drawnAt, response }: DrawnTimes, inputTime: number, sentAt: number): void {
    this.parts.gather.add(drawnAt, sentAt - inputTime);
    this.parts.server.add(drawnAt, response);
    // Two clocks are involved, so that a difference of next to nothing may come out negative.
    this.parts.travel.add(drawnAt, Math.max(0, decodedAt - sentAt - response));
    this.parts.draw.add(drawnAt, drawnAt - decodedAt);
  }
}
