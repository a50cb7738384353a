// Frames become pictures on the canvas: decoded side by side, kept in order, drawn on the next animation frame.

import { Codec, type Frame } from "../gen/sluice/v1/session_pb";

export interface DrawnFrame {
  readonly frame: Frame;
  /** All on the clock of performance.now(). */
  readonly receivedAt: number;
  readonly decodedAt: number;
  readonly drawnAt: number;
}

interface DecodedFrame {
  readonly frame: Frame;
  readonly bitmap: ImageBitmap;
  readonly receivedAt: number;
  readonly decodedAt: number;
}

const kMimeTypes: Partial<Record<Codec, string>> = {
  [Codec.JPEG]: "image/jpeg",
  [Codec.PNG]: "image/png",
};

/** Codecs that this page decodes. */
export const kDecodable: readonly Codec[] = [Codec.JPEG, Codec.PNG];

export class Picture {
  private readonly context: ImageBitmapRenderingContext;
  private waiting: DecodedFrame | undefined;
  private inOrder: Promise<void> = Promise.resolve();
  private epoch = 0;
  private requested = 0;

  /**
   * `onDrawn` is called after a frame is on the canvas. Where decoding is quicker than the screen the older frame is
   * left out, so that a call stands for every earlier frame too. `onUndecodable` is called for a frame that is broken.
   */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly onDrawn: (drawn: DrawnFrame) => void,
    private readonly onUndecodable: (frame: Frame, reason: unknown) => void,
  ) {
    const context = canvas.getContext("bitmaprenderer", { alpha: false });
    if (!context) throw new Error("This browser draws no bitmaps on a canvas.");
    this.context = context;
  }

  push(frame: Frame): void {
    const { epoch } = this;
    const receivedAt = performance.now();
    const decoding = decode(frame);
    this.inOrder = this.inOrder.then(async () => {
      try {
        const bitmap = await decoding;
        if (epoch === this.epoch) this.present({ frame, bitmap, receivedAt, decodedAt: performance.now() });
        else bitmap.close();
      } catch (reason) {
        if (epoch === this.epoch) this.onUndecodable(frame, reason);
      }
    });
  }

  /** Forgets frames under way: their connection is gone. The picture on the canvas stays. */
  forget(): void {
    this.epoch += 1;
    this.waiting?.bitmap.close();
    this.waiting = undefined;
  }

  private present(decoded: DecodedFrame): void {
    this.waiting?.bitmap.close();
    this.waiting = decoded;
    if (this.requested === 0) this.requested = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.requested = 0;
    const next = this.waiting;
    if (!next) return;
    this.waiting = undefined;
    // Takes the bitmap over, without a copy, and gives the canvas its size.
    this.context.transferFromImageBitmap(next.bitmap);
    const { frame, receivedAt, decodedAt } = next;
    this.onDrawn({ frame, receivedAt, decodedAt, drawnAt: performance.now() });
  }
}

async function decode(frame: Frame): Promise<ImageBitmap> {
  const type = kMimeTypes[frame.codec];
  if (!type) throw new Error(`codec ${Codec[frame.codec] ?? frame.codec} is not known to this page`);
  return createImageBitmap(pictureBlob(frame, type), { colorSpaceConversion: "none" });
}

/** The encoded picture as a file. */
export function pictureBlob(frame: Frame, type = kMimeTypes[frame.codec] ?? ""): Blob {
  return new Blob([frame.payload as Uint8Array<ArrayBuffer>], { type });
}
