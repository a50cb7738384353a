// Scenes hold colours as linear light; the browser's picker speaks sRGB (IEC 61966-2-1) in hexadecimal.

import type { Vec3 } from "../view/camera";

function encode(linear: number): number {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}

function decode(encoded: number): number {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

/** What a picker can show of a colour brighter than 1, and the factor that is left. */
export function splitStrength(colour: Vec3): { base: Vec3; strength: number } {
  const strength = Math.max(1, colour.x, colour.y, colour.z);
  return { base: { x: colour.x / strength, y: colour.y / strength, z: colour.z / strength }, strength };
}

export function toHex({ x, y, z }: Vec3): string {
  const byte = (linear: number) =>
    Math.round(255 * Math.min(1, Math.max(0, encode(linear))))
      .toString(16)
      .padStart(2, "0");
  return `#${byte(x)}${byte(y)}${byte(z)}`;
}

/** Components to four decimals, finer than a byte tells apart. */
export function fromHex(hex: string): Vec3 {
  const component = (at: number) => Number(decode(parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(4));
  return { x: component(1), y: component(3), z: component(5) };
}
