// Which codecs this browser decodes, and how its decoder is set up.

import { Codec } from "../gen/sluice/v1/session_pb";

/** Video codecs, best first: what decodes fastest, then what takes fewest bytes. */
export const kVideoCodecs = [Codec.H264, Codec.VP9, Codec.AV1] as const;
/** Decoded by createImageBitmap, everywhere. */
export const kImageTypes: Partial<Record<Codec, string>> = {
  [Codec.JPEG]: "image/jpeg",
  [Codec.PNG]: "image/png",
};

/** Stands for the codec where a stream does not say more: 720p, 8 bits, 4:2:0. */
const kTypicalDecoder: Partial<Record<Codec, string>> = {
  [Codec.H264]: "avc1.42C01F",
  [Codec.VP9]: "vp09.00.31.08",
  [Codec.AV1]: "av01.0.05M.08",
};

export const kCodecNames: Partial<Record<Codec, string>> = {
  [Codec.H264]: "H.264",
  [Codec.VP9]: "VP9",
  [Codec.AV1]: "AV1",
  [Codec.JPEG]: "JPEG",
  [Codec.PNG]: "PNG",
};

export function codecName(codec: Codec): string {
  return kCodecNames[codec] ?? `codec ${codec}`;
}

export function isVideo(codec: Codec): boolean {
  return kVideoCodecs.some((video) => video === codec);
}

/**
 * The decoder of one stream. Without `optimizeForLatency` H.264 comes out a frame late and AV1 two; without a colour
 * space VP9 is taken for BT.601. The transfer function is that of the canvas: pictures arrive ready for the screen.
 */
export function decoderConfig(codec: Codec, decoder: string, width: number, height: number): VideoDecoderConfig {
  return {
    codec: decoder || (kTypicalDecoder[codec] ?? ""),
    codedWidth: width,
    codedHeight: height,
    optimizeForLatency: true,
    colorSpace: { primaries: "bt709", transfer: "iec61966-2-1", matrix: "bt709", fullRange: false },
  };
}

/**
 * What this browser decodes, best first. WebCodecs is there only in secure contexts (https, localhost); elsewhere
 * pictures come as JPEG or PNG.
 */
export async function decodableCodecs(): Promise<Codec[]> {
  const video = await Promise.all(kVideoCodecs.map(async (codec) => ((await isDecodable(codec)) ? [codec] : [])));
  return [...video.flat(), Codec.JPEG, Codec.PNG];
}

async function isDecodable(codec: Codec): Promise<boolean> {
  if (typeof VideoDecoder === "undefined") return false;
  try {
    const { supported } = await VideoDecoder.isConfigSupported(decoderConfig(codec, "", 1280, 720));
    return supported === true;
  } catch {
    // Browsers that know a codec by no name throw.
    return false;
  }
}
