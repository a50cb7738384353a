// A touch that lasts: sent at once, and again with the frames for as long as it is held.

import type { Ray } from "../view/camera";
import type { TouchTool } from "./tools";

/** A server acts on each message for 0.1 simulated seconds; a ball of fluid needs time to make room for the next. */
const kSpacingMilliseconds: Readonly<Record<TouchTool, number>> = { push: 30, pull: 30, add: 120 };
/** An answer that takes longer than this is not waited for. */
const kPatienceMilliseconds = 400;

interface Held {
  readonly tool: TouchTool;
  ray: Ray | undefined;
}

export class Stroke {
  private held: Held | undefined;
  private sentAt = -Infinity;
  /** Message that has not been answered yet; 0 where there is none. */
  private underWay = 0;
  private requested = false;

  /** `send` returns the message's sequence number, or 0 where nothing is connected. */
  constructor(
    private readonly send: (tool: TouchTool, ray: Ray) => number,
    private readonly now: () => number = () => performance.now(),
    private readonly nextFrame: (callback: () => void) => void = (callback) => void requestAnimationFrame(callback),
  ) {}

  get isHeld(): boolean {
    return this.held !== undefined;
  }

  begin(tool: TouchTool, ray: Ray | undefined): void {
    this.held = { tool, ray };
    this.sentAt = -Infinity;
    this.underWay = 0;
    this.step();
  }

  /** Where it points now; undefined beside the picture, where it touches nothing. */
  aim(ray: Ray | undefined): void {
    if (this.held) this.held.ray = ray;
  }

  end(): void {
    this.held = undefined;
  }

  /** The server's answer; a refusal ends the touch. False where it answers something else. */
  answered(sequence: number, refused: boolean): boolean {
    if (sequence === 0 || sequence !== this.underWay) return false;
    this.underWay = 0;
    if (refused) this.end();
    return true;
  }

  private step(): void {
    const { held } = this;
    if (!held) return;
    const now = this.now();
    const waits = this.underWay !== 0 && now - this.sentAt < kPatienceMilliseconds;
    if (held.ray && !waits && now - this.sentAt >= kSpacingMilliseconds[held.tool]) {
      this.sentAt = now;
      this.underWay = this.send(held.tool, held.ray);
    }
    if (this.requested) return;
    this.requested = true;
    this.nextFrame(() => {
      this.requested = false;
      this.step();
    });
  }
}
