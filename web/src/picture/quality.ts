// What a person chooses of the pictures' quality, and the SetView that asks for it.

import { Codec, QualityMode } from "../gen/sluice/v1/session_pb";
import type { View } from "../protocol/session";
import { isVideo } from "./codecs";

export interface QualityChoice {
  readonly mode: QualityMode;
  /** Preferred over all others; undefined takes the best. */
  readonly codec: Codec | undefined;
  /** For FIXED_QUALITY, 1..100. */
  readonly quality: number;
  /** For FIXED_BIT_RATE. */
  readonly megabitsPerSecond: number;
  /** JPEG with colour at full resolution. */
  readonly fullChroma: boolean;
  /** A lossless picture when all is at rest. */
  readonly still: boolean;
}

/** What both sides know, best first as this browser has it. A server that names none is taken at JPEG. */
export function commonCodecs(decodable: readonly Codec[], server: readonly Codec[]): Codec[] {
  const common = decodable.filter((codec) => server.includes(codec));
  return common.length > 0 ? common : [Codec.JPEG];
}

/** Codecs that the mode allows: PNG alone is lossless, and only video has a bit rate. */
export function codecsFor(mode: QualityMode, common: readonly Codec[]): Codec[] {
  switch (mode) {
    case QualityMode.LOSSLESS:
      return [Codec.PNG];
    case QualityMode.FIXED_BIT_RATE:
      return common.filter(isVideo);
    default:
      return [...common];
  }
}

/** The choice as far as the codecs allow it: a bit rate without video becomes the automatic mode. */
export function viewFor(choice: QualityChoice, common: readonly Codec[]): View {
  const possible = codecsFor(choice.mode, common).length > 0;
  const mode = possible ? choice.mode : QualityMode.AUTOMATIC;
  const codecs = codecsFor(mode, common);
  const first = codecs.filter((codec) => codec === choice.codec);
  return {
    mode,
    codecs: [...first, ...codecs.filter((codec) => codec !== choice.codec)],
    quality: mode === QualityMode.FIXED_QUALITY ? choice.quality : 0,
    kilobitsPerSecond: mode === QualityMode.FIXED_BIT_RATE ? Math.round(1000 * choice.megabitsPerSecond) : 0,
    fullChroma: choice.fullChroma,
    noStill: !choice.still,
  };
}
