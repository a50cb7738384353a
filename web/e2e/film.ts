// Pictures for the stand-in server: flat colours, encoded by the browser that will decode them.

import type { Page } from "playwright-core";

import { Codec } from "../src/gen/sluice/v1/session_pb";

export interface FilmFrame {
  readonly keyframe: boolean;
  readonly payload: Uint8Array;
}

/** Red, green, blue, 0..255, of the whole picture. */
export type Colour = readonly [number, number, number];

export const kFilmSize = { width: 320, height: 192 };

export interface Film {
  readonly codec: Codec;
  readonly decoder: string;
  /** The first is a keyframe, all others are deltas. */
  readonly frames: readonly FilmFrame[];
}

const kEncoders = {
  [Codec.H264]: "avc1.42001f",
  [Codec.VP9]: "vp09.00.31.08",
  [Codec.AV1]: "av01.0.05M.08",
} as const;

export type VideoCodec = keyof typeof kEncoders;

/** A film that shows one colour after the other, as BT.709 in limited range. The page's context must be secure. */
export async function videoOf(page: Page, codec: VideoCodec, colours: readonly Colour[]): Promise<Film> {
  const name = kEncoders[codec];
  const chunks = await page.evaluate(
    async ({ name, colours, width, height }) => {
      const made: { keyframe: boolean; bytes: number[] }[] = [];
      let failure: unknown;
      const encoder = new VideoEncoder({
        output: (chunk) => {
          const bytes = new Uint8Array(chunk.byteLength);
          chunk.copyTo(bytes);
          made.push({ keyframe: chunk.type === "key", bytes: [...bytes] });
        },
        error: (reason) => {
          failure = reason;
        },
      });
      encoder.configure({
        codec: name,
        width,
        height,
        bitrate: 4_000_000,
        framerate: 30,
        latencyMode: "realtime",
        ...(name.startsWith("avc1") ? { avc: { format: "annexb" as const } } : {}),
      });
      colours.forEach(([r, g, b], at) => {
        // BT.709, limited range (ITU-R BT.709-6).
        const luma = (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255;
        const planes = [
          16 + 219 * luma,
          128 + (224 * (b / 255 - luma)) / 1.8556,
          128 + (224 * (r / 255 - luma)) / 1.5748,
        ];
        const area = width * height;
        const data = new Uint8Array((area * 3) / 2);
        data.fill(Math.round(planes[0]!), 0, area);
        data.fill(Math.round(planes[1]!), area, (area * 5) / 4);
        data.fill(Math.round(planes[2]!), (area * 5) / 4);
        const frame = new VideoFrame(data, {
          format: "I420",
          codedWidth: width,
          codedHeight: height,
          timestamp: at * 33_333,
          colorSpace: { primaries: "bt709", transfer: "bt709", matrix: "bt709", fullRange: false },
        });
        encoder.encode(frame, { keyFrame: at === 0 });
        frame.close();
      });
      await encoder.flush();
      encoder.close();
      if (failure) throw failure;
      return made;
    },
    { name, colours, ...kFilmSize },
  );
  const frames = chunks.map(({ keyframe, bytes }) => ({ keyframe, payload: Uint8Array.from(bytes) }));
  return { codec, decoder: name, frames };
}

/** One flat picture as PNG or JPEG. */
export async function imageOf(page: Page, type: "image/png" | "image/jpeg", colour: Colour): Promise<Uint8Array> {
  const bytes = await page.evaluate(
    async ({ type, colour, width, height }) => {
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext("2d")!;
      context.fillStyle = `rgb(${colour.join(" ")})`;
      context.fillRect(0, 0, width, height);
      const blob = await canvas.convertToBlob({ type, quality: 0.95 });
      return [...new Uint8Array(await blob.arrayBuffer())];
    },
    { type, colour, ...kFilmSize },
  );
  return Uint8Array.from(bytes);
}
