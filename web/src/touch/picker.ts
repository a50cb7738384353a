// Asks what fluid stands under the cursor: one question at a time, and again while the fluid moves.

import type { Picked } from "../gen/sluice/v1/session_pb";
import type { Point } from "../view/picture_area";

/** Between two questions about the same point. */
const kAgainMilliseconds = 250;
/** Between two questions of a moving cursor. */
const kSpacingMilliseconds = 60;
const kPatienceMilliseconds = 2000;

export class Picker {
  private at: Point | undefined;
  private asked: Point | undefined;
  private askedAt = -Infinity;
  private underWay = 0;
  private timer: ReturnType<typeof setInterval> | undefined;
  /** The particles have moved since the last answer. */
  private outdated = false;

  /** `ask` returns the message's sequence number; `show` gets undefined where nothing is pointed at any more. */
  constructor(
    private readonly ask: (at: Point) => number,
    private readonly show: (picked: Picked | undefined) => void,
    private readonly now: () => number = () => performance.now(),
  ) {}

  /** A point of the picture; undefined beside it. */
  aim(at: Point | undefined): void {
    if (!at) {
      this.leave();
      return;
    }
    this.at = at;
    this.timer ??= setInterval(() => this.step(), kSpacingMilliseconds);
    this.step();
  }

  leave(): void {
    clearInterval(this.timer);
    this.timer = undefined;
    this.at = undefined;
    this.asked = undefined;
    this.underWay = 0;
    this.show(undefined);
  }

  pictureChanged(): void {
    this.outdated = true;
  }

  /** False where it answers something else. */
  answered(sequence: number, picked: Picked | undefined): boolean {
    if (sequence === 0 || sequence !== this.underWay) return false;
    this.underWay = 0;
    if (picked && this.at) this.show(picked);
    return true;
  }

  private step(): void {
    if (!this.at) return;
    const since = this.now() - this.askedAt;
    if (this.underWay !== 0 && since < kPatienceMilliseconds) return;
    const moved = this.at !== this.asked;
    if (since < kSpacingMilliseconds || (!moved && !(this.outdated && since >= kAgainMilliseconds))) return;
    this.asked = this.at;
    this.askedAt = this.now();
    this.outdated = false;
    this.underWay = this.ask(this.at);
  }
}
