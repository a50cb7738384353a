// Mouse, fingers and keys on the picture while a tool other than the camera is chosen.

import type { Point } from "../view/picture_area";

export interface TouchHost {
  /** A tool has the picture, not the camera. */
  isActive(): boolean;
  /** The tool points at a place of the page, pressed or not; undefined where it points nowhere any more. */
  point(at: Point | undefined): void;
  press(at: Point): void;
  release(): void;
}

/** Of the picture's height. */
const kArrowWay = 0.025;

export class TouchControls {
  private readonly pointers = new Set<number>();
  private pressed: number | "key" | undefined;
  /** Where the keyboard's cursor stands, as shares of the canvas; undefined while it is not used. */
  private cursor: Point | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly crosshair: HTMLElement,
    private readonly host: TouchHost,
  ) {
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      canvas.addEventListener(type, (event) => this.up(event));
    }
    canvas.addEventListener("pointerleave", (event) => {
      if (this.pressed === undefined && event.pointerType === "mouse") host.point(undefined);
    });
    canvas.addEventListener("keydown", (event) => this.keyDown(event));
    canvas.addEventListener("keyup", (event) => {
      if (event.key === "Enter" && this.pressed === "key") this.letGo();
    });
    canvas.addEventListener("blur", () => this.hideCursor());
  }

  /** Another tool was chosen. */
  reset(): void {
    this.letGo();
    this.host.point(undefined);
    if (!this.host.isActive()) this.hideCursor();
    else if (this.cursor) this.host.point(this.cursorOnPage(this.cursor));
  }

  private down(event: PointerEvent): void {
    this.pointers.add(event.pointerId);
    // A second finger makes a gesture of the camera's.
    if (this.pointers.size > 1) {
      this.letGo();
      this.host.point(undefined);
      return;
    }
    if (!this.host.isActive() || event.button !== 0 || event.shiftKey) return;
    this.hideCursor();
    this.pressed = event.pointerId;
    this.host.press({ x: event.clientX, y: event.clientY });
  }

  private move(event: PointerEvent): void {
    if (!this.host.isActive() || this.pointers.size > 1) return;
    // Fingers point only while they touch; a drag with another button moves the camera.
    if (this.pressed !== event.pointerId && (event.pointerType !== "mouse" || event.buttons !== 0)) return;
    if (this.cursor) this.hideCursor();
    this.host.point({ x: event.clientX, y: event.clientY });
  }

  private up(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    if (this.pressed === event.pointerId) this.letGo();
  }

  private letGo(): void {
    if (this.pressed === undefined) return;
    this.pressed = undefined;
    this.host.release();
  }

  private keyDown(event: KeyboardEvent): void {
    if (!this.host.isActive() || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    const way = kArrows[event.key];
    if (way) this.moveCursor(way);
    else if (event.key === "Enter") this.keyPress(event.repeat);
    else if (event.key === "Escape" && this.cursor) this.hideCursor();
    else return;
    event.preventDefault();
  }

  private moveCursor({ x, y }: Point): void {
    const { clientWidth, clientHeight } = this.canvas;
    const from = this.cursor ?? { x: 0.5, y: 0.5 };
    const within = (value: number) => Math.min(1, Math.max(0, value));
    const across = (x * kArrowWay * clientHeight) / Math.max(1, clientWidth);
    this.showCursor({ x: within(from.x + across), y: within(from.y + y * kArrowWay) });
  }

  private keyPress(isRepeat: boolean): void {
    if (isRepeat || this.pressed !== undefined) return;
    if (!this.cursor) this.showCursor({ x: 0.5, y: 0.5 });
    this.pressed = "key";
    this.host.press(this.cursorOnPage(this.cursor!));
  }

  private showCursor(cursor: Point): void {
    this.cursor = cursor;
    this.crosshair.hidden = false;
    this.crosshair.style.left = `${100 * cursor.x}%`;
    this.crosshair.style.top = `${100 * cursor.y}%`;
    this.host.point(this.cursorOnPage(cursor));
  }

  private hideCursor(): void {
    if (!this.cursor) return;
    this.cursor = undefined;
    this.crosshair.hidden = true;
    if (this.pressed === "key") this.letGo();
    this.host.point(undefined);
  }

  private cursorOnPage(cursor: Point): Point {
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + cursor.x * box.width, y: box.top + cursor.y * box.height };
  }
}

const kArrows: Readonly<Record<string, Point>> = {
  ArrowLeft: { x: -1, y: 0 },
  ArrowRight: { x: 1, y: 0 },
  ArrowUp: { x: 0, y: -1 },
  ArrowDown: { x: 0, y: 1 },
};
