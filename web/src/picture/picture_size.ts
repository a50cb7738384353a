// What size of picture to ask for: the canvas in device pixels, times the chosen detail, within the server's limits.

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Smallest picture worth asking for; a window dragged to nothing still gets a valid request. */
const kMinEdge = 16;

/**
 * `devicePixels` is the canvas on the screen; `detail` in (0, 1] scales each edge. The aspect ratio is kept when a
 * limit cuts the size.
 */
export function pictureSize(devicePixels: Size, detail: number, limit: Size): Size {
  const width = Math.max(1, devicePixels.width * detail);
  const height = Math.max(1, devicePixels.height * detail);
  const cut = Math.min(1, limit.width / width, limit.height / height);
  const edge = (length: number, most: number) => Math.min(most, Math.max(kMinEdge, Math.round(length * cut)));
  return { width: edge(width, limit.width), height: edge(height, limit.height) };
}
