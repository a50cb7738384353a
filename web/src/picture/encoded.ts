// An encoded picture on its way to the decoder, and what becomes of it.

import type { Codec } from "../gen/sluice/v1/session_pb";

export interface EncodedPicture {
  /** Counts the pictures of this page; never used twice, also over reconnections. */
  readonly index: number;
  readonly codec: Codec;
  readonly width: number;
  readonly height: number;
  readonly keyframe: boolean;
  /** What WebCodecs is configured with; on keyframes of video. */
  readonly decoder: string;
  readonly payload: Uint8Array;
}

/** What drawImage takes; both must be closed by whoever holds them last. */
export type DecodedPicture = ImageBitmap | VideoFrame;

export interface DecoderEvents {
  onDecoded(index: number, picture: DecodedPicture): void;
  /** This one will not be shown. `reason` where it was broken; none where it needs a picture that never came. */
  onDropped(index: number, reason?: string): void;
  onKeyframeNeeded(): void;
  /** Repeatedly and from its keyframes on: this browser does not decode the codec, whatever it said. */
  onCodecFailing(codec: Codec, reason: string): void;
}
