// Frames become pictures on the canvas. What is drawn, what is not, and when, is told by the frame.

import type { Codec, Frame } from "../gen/sluice/v1/session_pb";
import { kImageTypes } from "./codecs";
import type { EncodedPicture } from "./encoded";
import { Pipeline, type PipelineOrder, type PipelineReport } from "./pipeline";

export interface DrawnFrame {
  /** Without its payload, which has gone to the decoder. */
  readonly frame: Frame;
  /** All on the clock of performance.now(). */
  readonly receivedAt: number;
  readonly decodedAt: number;
  readonly drawnAt: number;
}

export interface PictureEvents {
  /** The frame is on the canvas. Stands for every earlier frame too. */
  onDrawn(drawn: DrawnFrame): void;
  /** The frame will not be shown; `reason` where it was broken, none where it needs one that was. */
  onDropped(frame: Frame, reason: string | undefined): void;
  onKeyframeNeeded(): void;
  onCodecFailing(codec: Codec, reason: string): void;
}

interface Target {
  push(picture: EncodedPicture): void;
  reset(): void;
}

export class Picture {
  private readonly target: Target;
  private readonly underWay = new Map<number, { readonly frame: Frame; readonly receivedAt: number }>();
  private index = 0;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly events: PictureEvents,
  ) {
    const report = (said: PipelineReport) => this.reported(said);
    this.target = canDrawInWorker(canvas) ? inWorker(canvas, report) : new Pipeline(canvas, report);
  }

  /** Takes the payload of the frame over. */
  push(frame: Frame): void {
    this.index += 1;
    this.underWay.set(this.index, { frame, receivedAt: performance.now() });
    const { codec, width, height, keyframe, decoder, payload } = frame;
    this.target.push({ index: this.index, codec, width, height, keyframe, decoder, payload });
  }

  /** Forgets frames under way: their connection is gone. The picture on the canvas stays. */
  forget(): void {
    this.underWay.clear();
    this.target.reset();
  }

  private reported(said: PipelineReport): void {
    switch (said.kind) {
      case "drawn": {
        const sent = this.underWay.get(said.index);
        for (const index of this.underWay.keys()) if (index <= said.index) this.underWay.delete(index);
        if (sent) this.events.onDrawn({ ...sent, decodedAt: said.decodedAt, drawnAt: said.drawnAt });
        break;
      }
      case "dropped": {
        const sent = this.underWay.get(said.index);
        this.underWay.delete(said.index);
        if (sent) this.events.onDropped(sent.frame, said.reason);
        break;
      }
      case "keyframe needed":
        this.events.onKeyframeNeeded();
        break;
      case "codec failing":
        this.events.onCodecFailing(said.codec, said.reason);
        break;
    }
  }
}

function canDrawInWorker(canvas: HTMLCanvasElement): boolean {
  return typeof Worker !== "undefined" && "transferControlToOffscreen" in canvas;
}

function inWorker(canvas: HTMLCanvasElement, report: (said: PipelineReport) => void): Target {
  const worker = new Worker(new URL("./picture_worker.ts", import.meta.url), { type: "module", name: "pictures" });
  const order = (what: PipelineOrder, moved: Transferable[] = []) => worker.postMessage(what, moved);
  worker.addEventListener("message", ({ data }: MessageEvent<PipelineReport>) => report(data));
  const offscreen = canvas.transferControlToOffscreen();
  order({ kind: "start", canvas: offscreen, timeOrigin: performance.timeOrigin }, [offscreen]);
  return {
    push: (picture) => order({ kind: "picture", picture }, [picture.payload.buffer as ArrayBuffer]),
    reset: () => order({ kind: "reset" }),
  };
}

/** An encoded image as a file. */
export function pictureBlob(frame: Frame): Blob {
  return new Blob([frame.payload as Uint8Array<ArrayBuffer>], { type: kImageTypes[frame.codec] ?? "" });
}
