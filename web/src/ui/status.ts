// The state of the connection, said calmly: a line over the dimmed picture, and nothing at all while it works.

import type { ConnectionState } from "../protocol/connection";

/** A connection that comes back within this time is not worth a word. */
const kPatienceMilliseconds = 300;

export class Status {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private everConnected = false;
  /** A picture of this connection is on the canvas. */
  private isCurrent = false;

  constructor(
    private readonly stage: HTMLElement,
    private readonly line: HTMLElement,
  ) {}

  show(state: ConnectionState, detail: string): void {
    // What is on the canvas is the past until a new picture has come.
    this.isCurrent = false;
    this.stage.classList.add("stale");
    if (state === "stopped") this.say(detail);
    else if (state === "open") this.say("Waiting for the first picture …");
    else if (this.everConnected) this.say(detail ? `${detail}. Trying again …` : undefined);
    else this.say(state === "connecting" ? "Connecting …" : "The server cannot be reached. Trying again …");
  }

  /** An open connection on which nothing comes although an answer is due, or on which something has come again. */
  silence(silent: boolean): void {
    if (silent) {
      this.stage.classList.add("stale");
      this.say("The server has not answered for some seconds; this picture may be out of date.");
    } else if (this.isCurrent) {
      this.clear();
    }
  }

  /** A picture of this connection is on the canvas. */
  pictureDrawn(): void {
    if (this.isCurrent) return;
    this.isCurrent = true;
    this.everConnected = true;
    this.clear();
  }

  private clear(): void {
    this.stage.classList.remove("stale");
    clearTimeout(this.timer);
    this.timer = undefined;
    this.line.hidden = true;
  }

  /** `undefined` leaves what stands: a further attempt after a loss is no news. Nothing to say takes the line away. */
  private say(text: string | undefined): void {
    if (text === undefined) return;
    clearTimeout(this.timer);
    const write = () => {
      this.line.textContent = text;
      this.line.hidden = text === "";
    };
    if (this.line.hidden) this.timer = setTimeout(write, kPatienceMilliseconds);
    else write();
  }
}
