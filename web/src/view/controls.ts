// Mouse, touch and arrow keys on the canvas become camera moves.

import { type Camera, orbit, pan, zoom } from "./camera";

export interface CameraHost {
  /** Undefined while there is no camera to move. */
  camera(): Camera | undefined;
  /** `inputTime` is when the person moved, on the clock of performance.now(). */
  moveCamera(camera: Camera, inputTime: number): void;
  resetCamera(inputTime: number): void;
  /** One finger, the left button and the plain arrow keys turn the camera, and serve no tool. */
  turns(): boolean;
}

interface Point {
  readonly x: number;
  readonly y: number;
}

/** A drag across the picture's height turns the camera half round. */
const kTurnPerHeight = Math.PI;
/** One notch of a common mouse wheel (100 px) changes the distance by a sixth. */
const kZoomPerPixel = Math.log(7 / 6) / 100;
/** A track-pad's pinch arrives as a wheel with ctrlKey and small steps. */
const kPinchWheelGain = 6;
const kPixelsPerLine = 33;
const kArrowTurn = Math.PI / 48;
const kArrowPan = 0.04;
const kKeyZoom = 7 / 6;

export class CameraControls {
  private readonly pointers = new Map<number, Point>();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly host: CameraHost,
  ) {
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      canvas.addEventListener(type, (event) => this.release(event));
    }
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("dblclick", (event) => {
      if (host.turns()) host.resetCamera(event.timeStamp);
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  private press(event: PointerEvent): void {
    // Two fingers make a gesture; a third one takes no part.
    if (this.pointers.size >= 2) return;
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.classList.add("dragging");
  }

  private release(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    if (this.pointers.size === 0) this.canvas.classList.remove("dragging");
  }

  private drag(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    const camera = this.host.camera();
    if (!before || !camera) return;
    const now = { x: event.clientX, y: event.clientY };
    this.pointers.set(event.pointerId, now);
    const height = Math.max(1, this.canvas.clientHeight);
    const dx = (now.x - before.x) / height;
    const dy = (now.y - before.y) / height;
    if (dx === 0 && dy === 0) return;

    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      // Each finger moves the middle by half of its own way; their distance sets the zoom.
      const apart = (a: Point) => Math.max(8, Math.hypot(a.x - other.x, a.y - other.y));
      const panned = pan(camera, -dx / 2, dy / 2);
      this.host.moveCamera(zoom(panned, apart(before) / apart(now)), event.timeStamp);
      return;
    }
    const panning = event.pointerType === "mouse" && (event.shiftKey || (event.buttons & 1) === 0);
    if (!panning && !this.host.turns()) return;
    const moved = panning ? pan(camera, -dx, dy) : orbit(camera, -dx * kTurnPerHeight, dy * kTurnPerHeight);
    this.host.moveCamera(moved, event.timeStamp);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const camera = this.host.camera();
    if (!camera) return;
    const unit =
      event.deltaMode === WheelEvent.DOM_DELTA_LINE
        ? kPixelsPerLine
        : event.deltaMode === WheelEvent.DOM_DELTA_PAGE
          ? this.canvas.clientHeight
          : 1;
    const pixels = event.deltaY * unit * (event.ctrlKey ? kPinchWheelGain : 1);
    this.host.moveCamera(zoom(camera, Math.exp(pixels * kZoomPerPixel)), event.timeStamp);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key.startsWith("Arrow") && !event.shiftKey && !this.host.turns()) return;
    const camera = this.host.camera();
    const moved = camera && keyMove(camera, event.key, event.shiftKey);
    if (!moved) return;
    event.preventDefault();
    this.host.moveCamera(moved, event.timeStamp);
  }
}

/** The camera after a key on the canvas, or undefined where the key moves nothing. */
export function keyMove(camera: Camera, key: string, shift: boolean): Camera | undefined {
  const arrows: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  const arrow = arrows[key];
  if (arrow) {
    const [x, y] = arrow;
    return shift ? pan(camera, x * kArrowPan, y * kArrowPan) : orbit(camera, x * kArrowTurn, y * kArrowTurn);
  }
  if (key === "+" || key === "=") return zoom(camera, 1 / kKeyZoom);
  if (key === "-" || key === "_") return zoom(camera, kKeyZoom);
  return undefined;
}
