import { describe, expect, test } from "vitest";

import { count, factor, milliseconds, percent } from "../src/readout/format";
import { DelayMeter, Window } from "../src/readout/meters";

describe("Window", () => {
  test("counts what came in the last second", () => {
    const window = new Window();
    for (let at = 0; at <= 2000; at += 50) window.add(at);
    expect(window.count(2000)).toBe(20);
    expect(window.count(2500)).toBe(10);
    expect(window.count(4000)).toBe(0);
  });

  test("takes the middle of its values", () => {
    const window = new Window();
    expect(window.median(0)).toBeUndefined();
    for (const value of [9, 1, 5]) window.add(0, value);
    expect(window.median(0)).toBe(5);
    window.add(0, 7);
    expect(window.median(0)).toBe(6);
  });
});

/** Drawn 2 ms after it was decoded; a server that says nothing of its own time. */
const at = (drawnAt: number, response = 0) => ({ decodedAt: drawnAt - 2, drawnAt, response });

describe("DelayMeter", () => {
  test("measures from the input to the first frame that reflects it or a later one", () => {
    const meter = new DelayMeter();
    meter.sent(5, 100);
    meter.sent(6, 110);
    meter.sent(7, 120);
    meter.drawn(4, at(130));
    expect(meter.median(130)).toBeUndefined();
    meter.drawn(6, at(150));
    expect(meter.median(150)).toBe(45);
    meter.drawn(6, at(400));
    expect(meter.median(400)).toBe(45);
  });

  test("splits the delay of the message that the frame names by where it was spent", () => {
    const meter = new DelayMeter();
    meter.sent(3, 100, 104);
    meter.sent(4, 110, 113);
    meter.drawn(4, at(140, 12));
    expect(meter.meanParts(140)).toEqual({ gather: 3, server: 12, travel: 13, draw: 2 });
    meter.sent(5, 200, 200);
    meter.drawn(5, at(220));
    expect(meter.median(1150)).toBe(20);
    // What was measured last stands until there is something newer.
    expect(meter.meanParts(5000)).toEqual({ gather: 3, server: 12, travel: 13, draw: 2 });
    meter.forget();
    expect(meter.meanParts(5000)).toBeUndefined();
  });

  test("does not wait for messages that were never sent or were refused", () => {
    const meter = new DelayMeter();
    meter.sent(0, 100);
    meter.sent(8, 100);
    meter.refused(8);
    meter.drawn(9, at(200));
    expect(meter.median(200)).toBeUndefined();
  });
});

test("figures have units, three digits or so, and a dash for what is not known", () => {
  expect(milliseconds(3.14159)).toBe("3.1 ms");
  expect(milliseconds(1234.5)).toBe("1235 ms");
  expect(milliseconds(undefined)).toBe("–");
  expect(percent(0.0005)).toBe("0.050 %");
  expect(percent(0.0123)).toBe("1.23 %");
  expect(factor(0.834)).toBe("0.83×");
  expect(count(29952n)).toBe("29\u202f952");
});
