import { describe, expect, test } from "vitest";

import { fromHex, splitStrength, toHex } from "../src/params/colour";
import { formatNumber, nudgeOf, parseNumber } from "../src/params/control";
import { sliderScale } from "../src/params/slider_scale";

const annotation = { doc: "", unit: "", restart: false, logarithmic: false, allowed: [], words: [] };
const range = (min: number, max: number, logarithmic = false) => ({ ...annotation, min, max, logarithmic });

describe("sliderScale", () => {
  test("ends exactly at the range, whatever the curve", () => {
    for (const [given, standard] of [
      [range(0, 1), 0.5],
      [range(1e-7, 0.1, true), 0.005],
      [range(0, 100), 0.01],
    ] as const) {
      const scale = sliderScale(given, standard, false)!;
      expect(scale.toValue(0)).toBe(given.min);
      expect(scale.toValue(1)).toBe(given.max);
    }
  });

  test("goes there and back", () => {
    for (const scale of [
      sliderScale(range(-1, 1), 0, false)!,
      sliderScale(range(1e-4, 10, true), 0.05, false)!,
      sliderScale(range(0, 50), 1, false)!,
    ]) {
      for (const way of [0.1, 0.35, 0.6, 0.95]) expect(scale.toWay(scale.toValue(way))).toBeCloseTo(way, 2);
    }
  });

  test("moves in powers where the annotation says so", () => {
    expect(sliderScale(range(1, 10_000, true), 100, false)!.toValue(0.5)).toBeCloseTo(100, 6);
  });

  test("gives small values room where the default lies near zero", () => {
    expect(sliderScale(range(0, 100), 0.01, false)!.toWay(0.01)).toBeCloseTo(0.35, 6);
  });

  test("steps through a few whole numbers one by one", () => {
    const scale = sliderScale(range(1, 4), 2, true)!;
    expect(scale.step).toBeCloseTo(1 / 3, 12);
    expect(scale.toValue(1 / 3)).toBe(2);
  });

  test("is left out where a range is missing or too wide to feel", () => {
    expect(sliderScale(annotation as never, 1, false)).toBeUndefined();
    expect(sliderScale(range(-1e4, 1e4), 0, false)).toBeUndefined();
  });
});

describe("colours", () => {
  test("linear light becomes sRGB and comes back", () => {
    expect(toHex({ x: 0, y: 0.2158605, z: 1 })).toBe("#0080ff");
    for (const hex of ["#000000", "#123456", "#86cfe0", "#ffffff"]) expect(toHex(fromHex(hex))).toBe(hex);
  });

  test("what is brighter than white keeps its factor", () => {
    expect(splitStrength({ x: 1, y: 2, z: 4 })).toEqual({ base: { x: 0.25, y: 0.5, z: 1 }, strength: 4 });
    expect(splitStrength({ x: 0.1, y: 0.2, z: 0.3 }).strength).toBe(1);
  });
});

describe("typed numbers", () => {
  test("are read with comma, sign and exponent, and refused otherwise", () => {
    expect(parseNumber(" 1,5 ")).toBe(1.5);
    expect(parseNumber("1e-3")).toBe(0.001);
    expect(parseNumber("−2")).toBe(-2);
    for (const text of ["", "many", "1.2.3", "Infinity", "0x"]) expect(parseNumber(text)).toBeUndefined();
  });

  test("are shown with five digits at most, and read back", () => {
    expect(formatNumber(0.1 + 0.2)).toBe("0.3");
    expect(formatNumber(29952)).toBe("29952");
    expect(formatNumber(-0.02)).toBe("−0.02");
    expect(parseNumber(formatNumber(-1.234567))).toBe(-1.2346);
  });

  test("step in their second digit", () => {
    expect(nudgeOf(9.81, false)).toBeCloseTo(0.1, 12);
    expect(nudgeOf(0.05, false)).toBeCloseTo(0.001, 12);
    expect(nudgeOf(0, false)).toBeCloseTo(0.001, 12);
    expect(nudgeOf(300, true)).toBe(1);
  });
});
