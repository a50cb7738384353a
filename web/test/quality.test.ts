import { describe, expect, test } from "vitest";

import { Codec, QualityMode } from "../src/gen/sluice/v1/session_pb";
import { commonCodecs, type QualityChoice, viewFor } from "../src/picture/quality";

const kAll = [Codec.H264, Codec.VP9, Codec.AV1, Codec.JPEG, Codec.PNG];
const standard: QualityChoice = {
  mode: QualityMode.AUTOMATIC,
  codec: undefined,
  quality: 70,
  megabitsPerSecond: 8,
  fullChroma: false,
  still: true,
};

test("codecs that both sides know, in this browser's order", () => {
  expect(commonCodecs(kAll, [Codec.PNG, Codec.JPEG, Codec.AV1])).toEqual([Codec.AV1, Codec.JPEG, Codec.PNG]);
  expect(commonCodecs(kAll, [])).toEqual([Codec.JPEG]);
});

describe("the view asked for", () => {
  test("leaves quality and rate to the server in the automatic mode", () => {
    expect(viewFor(standard, kAll)).toMatchObject({ codecs: kAll, quality: 0, kilobitsPerSecond: 0, noStill: false });
  });

  test("has the chosen codec first, where it is possible", () => {
    expect(viewFor({ ...standard, codec: Codec.VP9 }, kAll).codecs?.slice(0, 2)).toEqual([Codec.VP9, Codec.H264]);
    expect(viewFor({ ...standard, codec: Codec.VP9 }, [Codec.JPEG]).codecs).toEqual([Codec.JPEG]);
  });

  test("names a bit rate for video alone, and none where there is no video", () => {
    const choice = { ...standard, mode: QualityMode.FIXED_BIT_RATE, megabitsPerSecond: 2.5 };
    expect(viewFor(choice, kAll)).toMatchObject({ codecs: [Codec.H264, Codec.VP9, Codec.AV1], kilobitsPerSecond: 2500 });
    expect(viewFor(choice, [Codec.JPEG, Codec.PNG])).toMatchObject({ mode: QualityMode.AUTOMATIC, kilobitsPerSecond: 0 });
  });

  test("is PNG where it is to be lossless, whatever codec was chosen", () => {
    const choice = { ...standard, mode: QualityMode.LOSSLESS, codec: Codec.AV1 };
    expect(viewFor(choice, kAll)).toMatchObject({ mode: QualityMode.LOSSLESS, codecs: [Codec.PNG] });
  });
});
