// How many pixels of the screen the canvas covers.

import type { Size } from "../picture/picture_size";

/** A window that is being dragged to size counts when it rests this long. */
const kResizeMilliseconds = 120;

export class CanvasSize {
  private pixels: Size;
  private resting: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    onResized: () => void,
  ) {
    this.pixels = nearly(canvas);
    const observer = new ResizeObserver(([entry]) => {
      const size = exactly(nearly(this.canvas), entry?.devicePixelContentBoxSize?.[0]);
      if (size.width === this.pixels.width && size.height === this.pixels.height) return;
      this.pixels = size;
      clearTimeout(this.resting);
      this.resting = setTimeout(onResized, kResizeMilliseconds);
    });
    try {
      observer.observe(canvas, { box: "device-pixel-content-box" });
    } catch {
      // Safari knows only CSS pixels.
      observer.observe(canvas);
    }
  }

  get devicePixels(): Size {
    return this.pixels;
  }

  get aspect(): number {
    return this.pixels.width / this.pixels.height;
  }
}

/** To within a pixel; the observer knows exactly. */
function nearly({ clientWidth, clientHeight }: HTMLCanvasElement): Size {
  return { width: clientWidth * devicePixelRatio, height: clientHeight * devicePixelRatio };
}

/** What the observer says, unless it has missed the density of the screen, as it does where tools emulate one. */
function exactly(near: Size, box: ResizeObserverSize | undefined): Size {
  if (!box) return near;
  const agrees = Math.abs(box.inlineSize - near.width) < 2 && Math.abs(box.blockSize - near.height) < 2;
  return agrees ? { width: box.inlineSize, height: box.blockSize } : near;
}
