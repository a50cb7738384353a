import { expect, test } from "vitest";

import { pictureSize } from "../src/picture/picture_size";

const limit = { width: 3840, height: 2160 };

test("a picture has the pixels of the screen", () => {
  expect(pictureSize({ width: 2208, height: 1800 }, 1, limit)).toEqual({ width: 2208, height: 1800 });
});

test("detail scales each edge", () => {
  expect(pictureSize({ width: 1001, height: 800 }, 0.5, limit)).toEqual({ width: 501, height: 400 });
});

test("a limit cuts both edges alike", () => {
  expect(pictureSize({ width: 7680, height: 2160 }, 1, limit)).toEqual({ width: 3840, height: 1080 });
  const high = pictureSize({ width: 1000, height: 9000 }, 1, limit);
  expect(high).toEqual({ width: 240, height: 2160 });
});

test("a window of no size asks for a small picture, not for none", () => {
  expect(pictureSize({ width: 0, height: 0 }, 1, limit)).toEqual({ width: 16, height: 16 });
});
