// Pictures of every codec on the page, against a stand-in for the server: colour, order, losses, acknowledgements.

import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";

import { Codec, QualityMode } from "../src/gen/sluice/v1/session_pb";
import { FakeServer } from "./fake_server";
import { type Colour, type Film, imageOf, kFilmSize, videoOf } from "./film";
import { Viewer } from "./viewer";

/** Of 255: 8-bit YCbCr, rounded twice, and Chromium's quick conversion, which is 7 off for blue. BT.601 would be 20 off. */
const kRounding = 8;

const kColours: readonly Colour[] = [
  [200, 60, 40],
  [40, 160, 90],
  [60, 80, 200],
  [220, 210, 60],
  [128, 128, 128],
];

let server: FakeServer;
let viewer: Viewer;
const films = new Map<Codec, Film>();

beforeAll(async () => {
  server = await FakeServer.start();
  viewer = await Viewer.launch();
  await viewer.page.goto(`${server.address}/blank`);
  for (const codec of [Codec.H264, Codec.VP9, Codec.AV1] as const) {
    films.set(codec, await videoOf(viewer.page, codec, kColours));
  }
});

afterAll(async () => {
  await viewer?.close();
  await server?.end();
});

beforeEach(async () => {
  await viewer.page.goto("about:blank");
  // What the last page said must not be taken for the next one's.
  server.heard = [];
  await viewer.page.goto(server.address);
  await expect.poll(() => server.last("setView")).toBeDefined();
  viewer.complaints.length = 0;
});

async function shown(): Promise<Colour> {
  const { values } = await viewer.pixels();
  const middle = 3 * (45 * 120 + 60);
  return [values[middle]!, values[middle + 1]!, values[middle + 2]!];
}

async function shows(colour: Colour): Promise<void> {
  const far = async () => {
    const now = await shown();
    return Math.max(...now.map((value, at) => Math.abs(value - colour[at]!)));
  };
  await expect.poll(far, { timeout: 10_000 }).toBeLessThanOrEqual(kRounding);
}

async function acknowledged(id: bigint): Promise<void> {
  await expect.poll(() => server.last("frameAck")?.frameId, { timeout: 10_000 }).toBe(id);
}

test("names what it decodes, best first, and asks for the canvas's own pixels", async () => {
  const canvas = await viewer.page.locator("#picture").boundingBox();
  expect(server.last("setView")).toMatchObject({
    codecs: [Codec.H264, Codec.VP9, Codec.AV1, Codec.JPEG, Codec.PNG],
    width: canvas!.width,
    height: canvas!.height,
    mode: QualityMode.AUTOMATIC,
    follow: 0n,
  });
});

describe.each([
  ["H.264", Codec.H264],
  ["VP9", Codec.VP9],
  ["AV1", Codec.AV1],
] as const)("%s", (_, codec) => {
  test("is shown frame by frame in its own colours, and acknowledged when it is", async () => {
    const film = films.get(codec)!;
    for (const [at, colour] of kColours.entries()) {
      // Each frame is shown before the next one comes: no decoder may hold one back.
      const id = server.filmFrame(film, at);
      await acknowledged(id);
      await shows(colour);
    }
    expect(server.all("keyframe")).toEqual([]);
    expect(viewer.complaints).toEqual([]);
  });

  test("goes on after a lossless picture between its frames", async () => {
    const film = films.get(codec)!;
    server.filmFrame(film, 0);
    const exact: Colour = [11, 222, 133];
    const payload = await imageOf(viewer.page, "image/png", exact);
    await acknowledged(server.frame({ codec: Codec.PNG, payload, still: true, keyframe: true }));
    expect(await shown()).toEqual(exact);
    await acknowledged(server.filmFrame(film, 1));
    await shows(kColours[1]!);
  });

  test("asks for a keyframe after a broken one, shows no delta before it has come, and keeps the window open", async () => {
    const film = films.get(codec)!;
    await acknowledged(server.filmFrame(film, 0));
    const broken = server.frame({ codec, keyframe: true, decoder: film.decoder, payload: new Uint8Array(64).fill(255) });
    await acknowledged(broken);
    await expect.poll(() => server.all("keyframe").length).toBe(1);
    const before = await viewer.page.evaluate(() => window.sluice.facts().framesDrawn);
    await acknowledged(server.filmFrame(film, 1));
    await acknowledged(server.filmFrame(film, 2));
    expect(await viewer.page.evaluate(() => window.sluice.facts().framesDrawn)).toBe(before);
    await shows(kColours[0]!);

    await acknowledged(server.filmFrame(film, 0));
    await acknowledged(server.filmFrame(film, 1));
    await shows(kColours[1]!);
    expect(server.all("keyframe").length).toBe(1);
  });
});

test("a delta without any keyframe is not shown, and one is asked for", async () => {
  await acknowledged(server.filmFrame(films.get(Codec.H264)!, 1));
  expect(server.all("keyframe").length).toBe(1);
  expect(await viewer.page.evaluate(() => window.sluice.facts().framesDrawn)).toBe(0);
});

test("a codec that never decodes is given up for another", async () => {
  const { decoder } = films.get(Codec.H264)!;
  for (let at = 0; at < 3; at += 1) {
    const payload = new Uint8Array(64).fill(255);
    await acknowledged(server.frame({ codec: Codec.H264, keyframe: true, decoder, payload }));
  }
  await expect.poll(() => server.last("setView")?.codecs).toEqual([Codec.VP9, Codec.AV1, Codec.JPEG, Codec.PNG]);
});

test("JPEG and PNG are shown, and a smaller picture fills the canvas all the same", async () => {
  for (const [codec, type] of [
    [Codec.JPEG, "image/jpeg"],
    [Codec.PNG, "image/png"],
  ] as const) {
    const payload = await imageOf(viewer.page, type, kColours[2]!);
    await acknowledged(server.frame({ codec, payload, keyframe: true }));
    await shows(kColours[2]!);
  }
  expect(await viewer.page.evaluate(() => window.sluice.facts().frame)).toMatchObject(kFilmSize);
  const canvas = await viewer.page.locator("#picture").boundingBox();
  const stage = await viewer.page.locator("#stage").boundingBox();
  expect(canvas).toEqual(stage);
});

test("the quality that is chosen is the quality that is asked for", async () => {
  await viewer.openGroups();
  const choose = (label: string, value: string) => viewer.page.getByLabel(label, { exact: true }).selectOption(value);
  const asked = () => server.last("setView");

  await choose("Compression", "quality");
  await viewer.page.getByLabel("Level", { exact: true }).focus();
  await viewer.page.keyboard.press("End");
  await expect.poll(asked).toMatchObject({ mode: QualityMode.FIXED_QUALITY, quality: 100 });
  await choose("Codec", String(Codec.AV1));
  await expect.poll(() => asked()?.codecs[0]).toBe(Codec.AV1);

  await choose("Compression", "rate");
  await viewer.page.getByLabel("Bit rate", { exact: true }).focus();
  await viewer.page.keyboard.press("Home");
  await expect.poll(asked).toMatchObject({
    mode: QualityMode.FIXED_BIT_RATE,
    kilobitsPerSecond: 500,
    codecs: [Codec.AV1, Codec.H264, Codec.VP9],
  });

  await choose("Compression", "lossless");
  await expect.poll(asked).toMatchObject({ mode: QualityMode.LOSSLESS, codecs: [Codec.PNG], quality: 0 });
  // It is remembered over a reload.
  await viewer.page.reload();
  await expect.poll(asked).toMatchObject({ mode: QualityMode.LOSSLESS });
  await viewer.page.evaluate(() => localStorage.clear());
});

test("without a secure context there is no video, and pictures come all the same", async () => {
  // Chromium takes any name under localhost for secure, but no other.
  const lan = await Viewer.launch({}, ["--host-resolver-rules=MAP fluid.lan 127.0.0.1"]);
  try {
    await lan.page.goto(`http://fluid.lan:${server.port}`);
    await expect.poll(() => server.last("setView")?.codecs).toEqual([Codec.JPEG, Codec.PNG]);
    const payload = await imageOf(lan.page, "image/png", kColours[1]!);
    await acknowledged(server.frame({ codec: Codec.PNG, payload, keyframe: true }));
    expect(lan.complaints).toEqual([]);
  } finally {
    await lan.close();
  }
});
