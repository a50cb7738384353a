// The page on a phone: the panel waits below, one finger turns, two move and zoom.

import type { CDPSession } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";

import { Server } from "./server";
import { Viewer } from "./viewer";

let server: Server;
let viewer: Viewer;
let touch: CDPSession;

beforeAll(async () => {
  server = await Server.start();
  viewer = await Viewer.open(server.address, {
    viewport: { width: 390, height: 700 },
    deviceScaleFactor: 2,
    hasTouch: true,
    isMobile: true,
  });
  touch = await viewer.page.context().newCDPSession(viewer.page);
  await viewer.pause();
});

afterAll(async () => {
  await viewer?.close();
  await server?.end();
});

type Points = readonly (readonly [number, number])[];

async function fingers(...way: readonly Points[]): Promise<void> {
  for (const [at, points] of way.entries()) {
    const touchPoints = points.map(([x, y], id) => ({ x, y, id }));
    await touch.send("Input.dispatchTouchEvent", { type: at === 0 ? "touchStart" : "touchMove", touchPoints });
  }
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
}

const camera = () => viewer.page.evaluate(() => window.sluice.facts().camera!);

function distance({ eye, target }: Awaited<ReturnType<typeof camera>>): number {
  return Math.hypot(eye.x - target.x, eye.y - target.y, eye.z - target.z);
}

test("the picture has the screen's own pixels", async () => {
  const frame = await viewer.page.evaluate(() => window.sluice.facts().frame!);
  expect(frame).toMatchObject({ width: 780, height: 1400 });
});

test("one finger turns the camera", async () => {
  const before = await camera();
  await fingers([[150, 300]], [[190, 300]], [[230, 310]]);
  const after = await camera();
  expect(after.eye).not.toEqual(before.eye);
  expect(after.target).toEqual(before.target);
  expect(distance(after)).toBeCloseTo(distance(before), 6);
});

test("two fingers apart come nearer, two fingers together move", async () => {
  const before = await camera();
  await fingers(
    [[170, 300], [220, 300]],
    [[150, 300], [240, 300]],
    [[120, 300], [270, 300]],
  );
  const near = await camera();
  expect(distance(near)).toBeLessThan(0.6 * distance(before));
  await fingers(
    [[150, 250], [250, 250]],
    [[150, 300], [250, 300]],
    [[150, 350], [250, 350]],
  );
  const moved = await camera();
  expect(moved.target).not.toEqual(near.target);
  expect(distance(moved)).toBeCloseTo(distance(near), 1);
});

test("the panel comes when it is asked for, and leaves room for the picture", async () => {
  expect(await viewer.page.locator("#panel").isVisible()).toBe(false);
  // A touch soon after a swipe stops the swipe's momentum, and is no tap.
  await viewer.rest();
  await viewer.page.locator("#panel-toggle").tap();
  await viewer.page.waitForFunction(() => window.sluice.facts().frame!.height < 1000);
  expect(await viewer.page.locator("#panel").isVisible()).toBe(true);
  await viewer.row("look.smoothing.time").locator(".label").tap();
  await viewer.page.getByRole("tooltip").waitFor();
  expect(viewer.complaints).toEqual([]);
});
