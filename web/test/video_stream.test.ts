import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { Codec } from "../src/gen/sluice/v1/session_pb";
import type { EncodedPicture } from "../src/picture/encoded";
import { VideoStream } from "../src/picture/video_stream";

interface Callbacks {
  output(frame: { timestamp: number; close(): void }): void;
  error(reason: Error): void;
}

class FakeDecoder {
  static made: FakeDecoder[] = [];
  state = "unconfigured";
  readonly configured: string[] = [];
  readonly decoded: { type: string; timestamp: number }[] = [];

  constructor(readonly callbacks: Callbacks) {
    FakeDecoder.made.push(this);
  }

  configure({ codec }: { codec: string }): void {
    this.state = "configured";
    this.configured.push(codec);
  }

  decode(chunk: { type: string; timestamp: number }): void {
    this.decoded.push(chunk);
  }

  close(): void {
    this.state = "closed";
  }

  // ---- what the browser does

  show(timestamp: number): void {
    this.callbacks.output({ timestamp, close: () => undefined });
  }

  fail(): void {
    this.state = "closed";
    this.callbacks.error(new Error("broken"));
  }
}

const newest = () => FakeDecoder.made.at(-1)!;

beforeEach(() => {
  FakeDecoder.made = [];
  vi.stubGlobal("VideoDecoder", FakeDecoder);
  vi.stubGlobal(
    "EncodedVideoChunk",
    class {
      constructor(init: object) {
        Object.assign(this, init);
      }
    },
  );
});
afterEach(() => vi.unstubAllGlobals());

function stream() {
  let time = 0;
  const events = { onDecoded: vi.fn(), onDropped: vi.fn(), onKeyframeNeeded: vi.fn(), onCodecFailing: vi.fn() };
  const video = new VideoStream(events, () => time);
  const pass = (milliseconds: number) => {
    time += milliseconds;
  };
  return { video, events, pass };
}

function picture(index: number, keyframe: boolean, more: Partial<EncodedPicture> = {}): EncodedPicture {
  const payload = new Uint8Array(1);
  return { index, keyframe, codec: Codec.H264, width: 640, height: 480, decoder: keyframe ? "avc1.42C01F" : "", payload, ...more };
}

test("is configured by its keyframes, and anew only when they say something else", () => {
  const { video, events } = stream();
  video.push(picture(1, true));
  video.push(picture(2, false));
  video.push(picture(3, true));
  expect(newest().configured).toEqual(["avc1.42C01F"]);
  expect(newest().decoded.map(({ type }) => type)).toEqual(["key", "delta", "key"]);
  video.push(picture(4, true, { width: 320, height: 240 }));
  expect(newest().configured.length).toBe(2);
  newest().show(1);
  expect(events.onDecoded).toHaveBeenCalledWith(1, expect.objectContaining({ timestamp: 1 }));
  expect(FakeDecoder.made.length).toBe(1);
});

test("deltas to a picture that never came are dropped, and one keyframe is asked for until patience ends", () => {
  const { video, events, pass } = stream();
  video.push(picture(1, false));
  video.push(picture(2, false));
  expect(events.onDropped.mock.calls).toEqual([[1], [2]]);
  expect(events.onKeyframeNeeded).toHaveBeenCalledTimes(1);
  pass(1100);
  video.push(picture(3, false));
  expect(events.onKeyframeNeeded).toHaveBeenCalledTimes(2);
  // A delta of another codec than the keyframe's is no better.
  video.push(picture(4, true));
  video.push(picture(5, false, { codec: Codec.VP9 }));
  expect(events.onDropped).toHaveBeenLastCalledWith(5);
});

test("after an error everything under way is dropped, and the next keyframe gets a new decoder", () => {
  const { video, events } = stream();
  video.push(picture(1, true));
  video.push(picture(2, false));
  newest().show(1);
  newest().fail();
  expect(events.onDropped.mock.calls).toEqual([[2, "broken"]]);
  expect(events.onKeyframeNeeded).toHaveBeenCalledTimes(1);
  video.push(picture(3, false));
  expect(events.onDropped).toHaveBeenLastCalledWith(3);
  video.push(picture(4, true));
  expect(FakeDecoder.made.length).toBe(2);
  newest().show(4);
  expect(events.onDecoded).toHaveBeenLastCalledWith(4, expect.anything());
  expect(events.onCodecFailing).not.toHaveBeenCalled();
});

test("three failures without a picture between them are the codec's fault, with one they are not", () => {
  const { video, events } = stream();
  for (const index of [1, 2]) {
    video.push(picture(index, true));
    newest().fail();
  }
  video.push(picture(3, true));
  newest().show(3);
  newest().fail();
  expect(events.onCodecFailing).not.toHaveBeenCalled();
  for (const index of [4, 5]) {
    video.push(picture(index, true));
    newest().fail();
  }
  expect(events.onCodecFailing).toHaveBeenCalledWith(Codec.H264, "broken");
});

test("what an abandoned decoder still says is not heard", () => {
  const { video, events } = stream();
  video.push(picture(1, true));
  const old = newest();
  video.reset();
  old.show(1);
  old.callbacks.error(new Error("late"));
  expect(events.onDecoded).not.toHaveBeenCalled();
  expect(events.onDropped).not.toHaveBeenCalled();
  expect(events.onKeyframeNeeded).not.toHaveBeenCalled();
});
