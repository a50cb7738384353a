import { describe, expect, test, vi } from "vitest";

import { create } from "@bufbuild/protobuf";

import { PickedSchema } from "../src/gen/sluice/v1/session_pb";
import { pickedInWords } from "../src/touch/pick_card";
import { Picker } from "../src/touch/picker";
import { Stroke } from "../src/touch/stroke";
import type { Ray } from "../src/view/camera";
import { pointInPicture } from "../src/view/picture_area";

const ray = (x: number): Ray => ({ origin: { x, y: 0, z: 0 }, direction: { x: 0, y: 0, z: -1 } });

/** A clock, and the animation frames that it brings, 10 ms apart. */
function clock() {
  let now = 0;
  let waiting: (() => void)[] = [];
  return {
    now: () => now,
    nextFrame: (callback: () => void) => void waiting.push(callback),
    pass: (milliseconds: number) => {
      for (const end = now + milliseconds; now < end; ) {
        now += 10;
        const due = waiting;
        waiting = [];
        for (const callback of due) callback();
      }
    },
  };
}

describe("a stroke", () => {
  function begun() {
    const time = clock();
    let sequence = 0;
    const send = vi.fn((_tool: string, _ray: Ray) => ++sequence);
    const stroke = new Stroke(send, time.now, time.nextFrame);
    stroke.begin("push", ray(1));
    return { time, send, stroke };
  }

  test("is sent at once, and again only after its answer", () => {
    const { time, send, stroke } = begun();
    expect(send).toHaveBeenCalledTimes(1);
    time.pass(200);
    expect(send).toHaveBeenCalledTimes(1);
    stroke.aim(ray(2));
    expect(stroke.answered(1, false)).toBe(true);
    time.pass(10);
    expect(send).toHaveBeenCalledTimes(2);
    expect(send.mock.lastCall![1].origin.x).toBe(2);
  });

  test("does not wait for an answer for ever", () => {
    const { time, send } = begun();
    time.pass(450);
    expect(send).toHaveBeenCalledTimes(2);
  });

  test("adds fluid more slowly than it pushes", () => {
    const { time, send, stroke } = begun();
    stroke.end();
    stroke.begin("add", ray(1));
    stroke.answered(2, false);
    time.pass(100);
    expect(send).toHaveBeenCalledTimes(2);
    time.pass(30);
    expect(send).toHaveBeenCalledTimes(3);
  });

  test("ends with the finger, and with a refusal", () => {
    const { time, send, stroke } = begun();
    stroke.answered(1, true);
    expect(stroke.isHeld).toBe(false);
    time.pass(1000);
    expect(send).toHaveBeenCalledTimes(1);
  });

  test("touches nothing beside the picture", () => {
    const { time, send, stroke } = begun();
    stroke.aim(undefined);
    stroke.answered(1, false);
    time.pass(500);
    expect(send).toHaveBeenCalledTimes(1);
  });
});

test("a picker asks one question at a time, about the newest point, and again when the fluid has moved", () => {
  vi.useFakeTimers();
  try {
    let sequence = 0;
    const ask = vi.fn((_at: { x: number; y: number }) => ++sequence);
    const show = vi.fn();
    const picker = new Picker(ask, show, () => Date.now());
    picker.aim({ x: 0.1, y: 0.1 });
    picker.aim({ x: 0.2, y: 0.1 });
    picker.aim({ x: 0.3, y: 0.1 });
    vi.advanceTimersByTime(500);
    expect(ask).toHaveBeenCalledTimes(1);
    const picked = create(PickedSchema, { hit: true });
    expect(picker.answered(1, picked)).toBe(true);
    expect(show).toHaveBeenLastCalledWith(picked);
    vi.advanceTimersByTime(60);
    expect(ask.mock.lastCall![0].x).toBe(0.3);
    picker.answered(2, picked);
    vi.advanceTimersByTime(1000);
    expect(ask).toHaveBeenCalledTimes(2);
    picker.pictureChanged();
    vi.advanceTimersByTime(300);
    expect(ask).toHaveBeenCalledTimes(3);

    picker.leave();
    expect(show).toHaveBeenLastCalledWith(undefined);
    expect(picker.answered(3, picked)).toBe(false);
    expect(vi.getTimerCount()).toBe(0);
  } finally {
    vi.useRealTimers();
  }
});

test("what was picked is told in SI units", () => {
  const picked = create(PickedSchema, {
    hit: true,
    position: { x: -0.00004, y: 12.3456, z: -1 },
    depth: 123.456,
    thickness: 0.00456,
    velocity: { x: 0, y: 0, z: 2 },
    density: 998.21,
  });
  expect(pickedInWords(picked)).toEqual(["0.000, 12.346, −1.000 m", "123 m", "0.005 m", "2.00 m/s\n0.000, 0.000, 2.000", "998.2 kg/m³"]);
});

describe("a point of the picture", () => {
  const box = { left: 100, top: 50, width: 400, height: 200 };

  test("lies where the canvas shows it", () => {
    const square = { width: 300, height: 300 };
    // Cropped above and below: the box's upper edge is a quarter into the picture.
    expect(pointInPicture(box, square, "cover", { x: 100, y: 50 })).toEqual({ x: 0, y: 0.25 });
    expect(pointInPicture(box, square, "contain", { x: 200, y: 50 })).toEqual({ x: 0, y: 0 });
    expect(pointInPicture(box, square, "contain", { x: 300, y: 150 })).toEqual({ x: 0.5, y: 0.5 });
  });

  test("is none in the margin beside it", () => {
    expect(pointInPicture(box, { width: 300, height: 300 }, "contain", { x: 150, y: 150 })).toBeUndefined();
    expect(pointInPicture({ ...box, width: 0 }, { width: 3, height: 3 }, "cover", { x: 0, y: 0 })).toBeUndefined();
  });
});
