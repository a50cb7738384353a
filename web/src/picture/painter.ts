// The newest decoded picture goes onto the canvas with the next animation frame.

import type { DecodedPicture } from "./encoded";

interface Waiting {
  readonly index: number;
  readonly picture: DecodedPicture;
  readonly decodedAt: number;
}

export type PaintedHandler = (index: number, decodedAt: number, drawnAt: number) => void;

export class Painter {
  private readonly context: OffscreenCanvasRenderingContext2D | CanvasRenderingContext2D;
  private waiting: Waiting | undefined;
  private requested = 0;
  private newest = -1;

  /** `onPainted` stands for every earlier picture too: the screen may be slower than the stream. */
  constructor(
    private readonly canvas: OffscreenCanvas | HTMLCanvasElement,
    private readonly onPainted: PaintedHandler,
  ) {
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("This browser draws on no canvas.");
    this.context = context as OffscreenCanvasRenderingContext2D | CanvasRenderingContext2D;
  }

  /** Takes the picture over. Images and video are decoded side by side: one that comes late is not shown any more. */
  show(index: number, picture: DecodedPicture): void {
    if (index <= this.newest) {
      picture.close();
      return;
    }
    this.newest = index;
    this.waiting?.picture.close();
    this.waiting = { index, picture, decodedAt: performance.now() };
    if (this.requested === 0) this.requested = requestAnimationFrame(() => this.paint());
  }

  /** What waits belongs to a connection that is gone. The picture on the canvas stays. */
  forget(): void {
    this.waiting?.picture.close();
    this.waiting = undefined;
  }

  private paint(): void {
    this.requested = 0;
    const next = this.waiting;
    if (!next) return;
    this.waiting = undefined;
    const { index, picture, decodedAt } = next;
    const width = "displayWidth" in picture ? picture.displayWidth : picture.width;
    const height = "displayHeight" in picture ? picture.displayHeight : picture.height;
    // The canvas takes the picture's size, and the page scales it to its place.
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    this.context.drawImage(picture, 0, 0);
    picture.close();
    this.onPainted(index, decodedAt, performance.now());
  }
}
