// Where a point of the page lies in the picture that the canvas shows.

import type { Size } from "../picture/picture_size";

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Box extends Size {
  readonly left: number;
  readonly top: number;
}

/** As CSS's object-fit: "cover" fills the box and crops the picture, "contain" leaves margins. */
export type Fit = "cover" | "contain";

/**
 * From the picture's left and top edge, as shares of its size; undefined beside the picture, which "contain" allows.
 * The picture stands in the middle of the box.
 */
export function pointInPicture(box: Box, picture: Size, fit: Fit, at: Point): Point | undefined {
  if (box.width <= 0 || box.height <= 0 || picture.width <= 0 || picture.height <= 0) return undefined;
  const across = box.width / picture.width;
  const down = box.height / picture.height;
  const scale = fit === "cover" ? Math.max(across, down) : Math.min(across, down);
  const x = 0.5 + (at.x - box.left - box.width / 2) / (picture.width * scale);
  const y = 0.5 + (at.y - box.top - box.height / 2) / (picture.height * scale);
  return x >= 0 && x <= 1 && y >= 0 && y <= 1 ? { x, y } : undefined;
}
