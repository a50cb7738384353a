// Decoder and painter as one: in a worker where the browser draws there, else in the page.

import type { Codec } from "../gen/sluice/v1/session_pb";
import { Decoder } from "./decoder";
import type { EncodedPicture } from "./encoded";
import { Painter } from "./painter";

export type PipelineReport =
  /** Times on the clock of performance.now() where the pipeline runs. */
  | { readonly kind: "drawn"; readonly index: number; readonly decodedAt: number; readonly drawnAt: number }
  | { readonly kind: "dropped"; readonly index: number; readonly reason: string | undefined }
  | { readonly kind: "keyframe needed" }
  | { readonly kind: "codec failing"; readonly codec: Codec; readonly reason: string };

export class Pipeline {
  private readonly painter: Painter;
  private readonly decoder: Decoder;

  constructor(canvas: OffscreenCanvas | HTMLCanvasElement, report: (report: PipelineReport) => void) {
    this.painter = new Painter(canvas, (index, decodedAt, drawnAt) =>
      report({ kind: "drawn", index, decodedAt, drawnAt }),
    );
    this.decoder = new Decoder({
      onDecoded: (index, picture) => this.painter.show(index, picture),
      onDropped: (index, reason) => report({ kind: "dropped", index, reason }),
      onKeyframeNeeded: () => report({ kind: "keyframe needed" }),
      onCodecFailing: (codec, reason) => report({ kind: "codec failing", codec, reason }),
    });
  }

  push(picture: EncodedPicture): void {
    this.decoder.push(picture);
  }

  reset(): void {
    this.decoder.reset();
    this.painter.forget();
  }
}

export type PipelineOrder =
  /** The first order; `timeOrigin` is the page's, so that reports carry its clock. */
  | { readonly kind: "start"; readonly canvas: OffscreenCanvas; readonly timeOrigin: number }
  | { readonly kind: "picture"; readonly picture: EncodedPicture }
  | { readonly kind: "reset" };
