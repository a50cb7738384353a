// Encoded pictures become drawable ones: video by WebCodecs, JPEG and PNG by createImageBitmap.

import { codecName, isVideo, kImageTypes } from "./codecs";
import type { DecoderEvents, EncodedPicture } from "./encoded";
import { VideoStream } from "./video_stream";

export class Decoder {
  private readonly video: VideoStream;
  /** Pictures of an earlier connection are not shown in a later one. */
  private epoch = 0;

  constructor(private readonly events: DecoderEvents) {
    this.video = new VideoStream(events);
  }

  push(picture: EncodedPicture): void {
    if (isVideo(picture.codec)) this.video.push(picture);
    else void this.decodeImage(picture);
  }

  reset(): void {
    this.epoch += 1;
    this.video.reset();
  }

  private async decodeImage({ index, codec, payload }: EncodedPicture): Promise<void> {
    const { epoch } = this;
    try {
      const type = kImageTypes[codec];
      if (!type) throw new Error(`${codecName(codec)} is not known to this page`);
      const blob = new Blob([payload as Uint8Array<ArrayBuffer>], { type });
      const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none" });
      if (epoch === this.epoch) this.events.onDecoded(index, bitmap);
      else bitmap.close();
    } catch (reason) {
      if (epoch === this.epoch) this.events.onDropped(index, reason instanceof Error ? reason.message : String(reason));
    }
  }
}
