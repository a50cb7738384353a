// Video through WebCodecs: from keyframe to keyframe, and a new decoder whenever one has failed.

import type { Codec } from "../gen/sluice/v1/session_pb";
import { decoderConfig } from "./codecs";
import type { DecoderEvents, EncodedPicture } from "./encoded";

/** A keyframe that was asked for and has not come after this time is asked for again. */
const kKeyframePatienceMilliseconds = 1000;
/** Failures in a row, without one picture between them, that no lost frame explains. */
const kMostFailures = 3;

export class VideoStream {
  private decoder: VideoDecoder | undefined;
  private codec: Codec | undefined;
  private configured = "";
  /** Pictures that the decoder holds, oldest first. */
  private underWay: number[] = [];
  private askedAt = -Infinity;
  private failures = 0;

  constructor(
    private readonly events: DecoderEvents,
    private readonly now: () => number = () => performance.now(),
  ) {}

  push(picture: EncodedPicture): void {
    const { index, codec, keyframe } = picture;
    if (!keyframe && (!this.decoder || codec !== this.codec)) {
      // A delta to pictures that were lost.
      this.events.onDropped(index);
      this.askForKeyframe();
      return;
    }
    this.underWay.push(index);
    try {
      if (keyframe) this.configure(picture);
      const type = keyframe ? "key" : "delta";
      this.decoder!.decode(new EncodedVideoChunk({ type, timestamp: index, data: picture.payload }));
    } catch (reason) {
      this.fail(codec, reason);
    }
  }

  /** The connection is gone, and the next stream starts with a keyframe. */
  reset(): void {
    this.close();
    this.underWay = [];
    this.askedAt = -Infinity;
    this.failures = 0;
  }

  private configure({ codec, decoder, width, height }: EncodedPicture): void {
    const config = decoderConfig(codec, decoder, width, height);
    const wanted = `${config.codec} ${width}×${height}`;
    this.askedAt = -Infinity;
    if (this.decoder && wanted === this.configured) return;
    this.decoder ??= this.makeDecoder();
    this.decoder.configure(config);
    this.codec = codec;
    this.configured = wanted;
  }

  private makeDecoder(): VideoDecoder {
    const decoder = new VideoDecoder({
      output: (frame) => {
        if (decoder === this.decoder) this.decoded(frame);
        else frame.close();
      },
      error: (reason) => {
        if (decoder === this.decoder) this.fail(this.codec, reason);
      },
    });
    return decoder;
  }

  private decoded(frame: VideoFrame): void {
    const index = frame.timestamp;
    this.failures = 0;
    this.underWay = this.underWay.filter((other) => other > index);
    this.events.onDecoded(index, frame);
  }

  private fail(codec: Codec | undefined, reason: unknown): void {
    this.close();
    const message = reason instanceof Error ? reason.message : String(reason);
    const lost = this.underWay;
    this.underWay = [];
    for (const index of lost) this.events.onDropped(index, message);
    this.failures += 1;
    if (this.failures >= kMostFailures && codec !== undefined) {
      this.failures = 0;
      this.events.onCodecFailing(codec, message);
    }
    this.askForKeyframe();
  }

  private close(): void {
    const { decoder } = this;
    this.decoder = undefined;
    this.codec = undefined;
    this.configured = "";
    if (decoder && decoder.state !== "closed") decoder.close();
  }

  private askForKeyframe(): void {
    const now = this.now();
    if (now - this.askedAt < kKeyframePatienceMilliseconds) return;
    this.askedAt = now;
    this.events.onKeyframeNeeded();
  }
}
