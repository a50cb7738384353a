// Viewers among others, and hands in the fluid, against a stand-in for the server: roles, following, tokens, tools,
// picking, and a server that falls silent or goes.

import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";

import { Codec, Interact_Action as Action, Role } from "../src/gen/sluice/v1/session_pb";
import { FakeServer } from "./fake_server";
import { imageOf } from "./film";
import { Viewer } from "./viewer";

let server: FakeServer;
let viewer: Viewer;
let picture: Uint8Array;

beforeAll(async () => {
  server = await FakeServer.start();
  viewer = await Viewer.launch();
  picture = await imageOf(viewer.page, "image/png", [90, 120, 150]);
});

afterAll(async () => {
  await viewer?.close();
  await server?.end();
});

beforeEach(async () => {
  server.answers = true;
  server.token = "";
  server.welcome = { ...server.welcome, role: Role.DRIVER };
  await viewer.page.goto("about:blank");
  // What the last page said must not be taken for the next one's.
  server.heard = [];
  viewer.complaints.length = 0;
});

/** Opens the page and shows it a picture, in the canvas's shape. */
async function join(hash = ""): Promise<void> {
  await viewer.page.goto(`${server.address}/${hash}`);
  await expect.poll(() => server.last("setView")).toBeDefined();
  await show();
}

async function show(size: { width: number; height: number } = { width: 320, height: 338 }): Promise<void> {
  const before = await viewer.page.evaluate(() => window.sluice.facts().framesDrawn);
  server.frame({ codec: Codec.PNG, keyframe: true, payload: picture, ...size });
  await viewer.page.waitForFunction((than) => window.sluice.facts().framesDrawn > than, before);
}

const others = (...more: { viewerId: bigint; role?: Role; follows?: bigint }[]) =>
  server.say({
    case: "viewersChanged",
    value: {
      viewers: [
        { viewerId: 7n, client: "sluice-web", role: server.welcome.role!, width: 564, height: 600 },
        ...more.map((one) => ({ client: "other", role: Role.DRIVER, width: 1280, height: 720, ...one })),
      ],
    },
  });

describe("the token", () => {
  test("comes from the address, which forgets it, and is kept for the tab", async () => {
    server.token = "salt & water";
    await join("#token=salt%20%26%20water");
    expect(server.last("hello")?.token).toBe("salt & water");
    expect(viewer.page.url()).toBe(`${server.address}/`);
    await viewer.page.reload();
    await expect.poll(() => server.last("setView")).toBeDefined();
    expect(server.last("hello")?.token).toBe("salt & water");
    await viewer.page.evaluate(() => sessionStorage.clear());
  });

  test("is asked for where the server wants one, again when it is wrong, and no attempt is made meanwhile", async () => {
    server.token = "right";
    await viewer.page.goto(server.address);
    const prompt = viewer.page.locator("#token");
    await prompt.waitFor();
    expect(await prompt.getByRole("alert").isVisible()).toBe(false);
    await viewer.page.keyboard.type("wrong");
    await viewer.page.keyboard.press("Enter");
    await prompt.getByRole("alert").waitFor();
    expect(await prompt.getByRole("alert").textContent()).toContain("not the server's");
    const { length } = server.heard;
    await viewer.page.waitForTimeout(1500);
    expect(server.heard.length).toBe(length);

    await viewer.page.keyboard.type("right");
    await viewer.page.keyboard.press("Enter");
    await expect.poll(() => server.last("setView")).toBeDefined();
    expect(await prompt.isVisible()).toBe(false);
    await viewer.page.evaluate(() => sessionStorage.clear());
  });
});

describe("a spectator", () => {
  test("sees why the scene cannot be changed, keeps the camera, and may read the fluid", async () => {
    server.welcome = { ...server.welcome, role: Role.SPECTATOR };
    await join();
    await viewer.page.locator("#role").waitFor();
    const play = viewer.page.getByRole("button", { name: "Pause" });
    expect(await play.isDisabled()).toBe(true);
    expect(await play.getAttribute("title")).toContain("only drivers");
    expect(await viewer.page.locator("#scene").isDisabled()).toBe(true);
    expect(await viewer.page.locator("#parameters-note").textContent()).toContain("only drivers");
    expect(await viewer.row("look.smoothing.time").locator("input.number").isDisabled()).toBe(true);
    expect(await viewer.page.getByLabel("Push the fluid").isDisabled()).toBe(true);
    expect(await viewer.page.getByLabel("Read the fluid").isDisabled()).toBe(false);

    await viewer.page.locator("#picture").focus();
    await viewer.page.keyboard.press("Space");
    await viewer.page.keyboard.press("ArrowLeft");
    await expect.poll(() => server.all("setCamera").length).toBe(2);
    expect(server.all("control")).toEqual([]);
  });
});

describe("following", () => {
  test("shows another's pictures whole, moves no camera meanwhile, and goes back", async () => {
    await join();
    others({ viewerId: 9n });
    await viewer.openGroups();
    await viewer.page.getByRole("button", { name: "Follow" }).click();
    await expect.poll(() => server.last("setView")?.follow).toBe(9n);
    const banner = viewer.page.locator("#following");
    expect(await banner.textContent()).toContain("Following viewer 9");
    await show({ width: 1280, height: 720 });
    const fit = await viewer.page.locator("#picture").evaluate((canvas) => getComputedStyle(canvas).objectFit);
    expect(fit).toBe("contain");
    const cameras = server.all("setCamera").length;
    await viewer.page.mouse.move(200, 300);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(300, 300, { steps: 3 });
    await viewer.page.mouse.up();
    expect(server.all("setCamera").length).toBe(cameras);
    expect(await viewer.page.getByLabel("Pull the fluid").isDisabled()).toBe(true);

    await banner.getByRole("button", { name: "Back to my camera" }).click();
    await expect.poll(() => server.last("setView")?.follow).toBe(0n);
    await expect.poll(() => server.all("setCamera").length).toBe(cameras + 1);
    expect(await banner.isVisible()).toBe(false);
  });

  test("ends when the one that is followed leaves, and says so", async () => {
    await join();
    others({ viewerId: 9n });
    await viewer.openGroups();
    await viewer.page.getByRole("button", { name: "Follow" }).click();
    await expect.poll(() => server.last("setView")?.follow).toBe(9n);
    others();
    await expect.poll(() => server.last("setView")?.follow).toBe(0n);
    await viewer.page.locator(".notice", { hasText: "has left" }).waitFor();
  });

  test("is not offered for viewers who follow others", async () => {
    await join();
    others({ viewerId: 9n, follows: 7n });
    await viewer.openGroups();
    const button = viewer.page.getByRole("button", { name: "Follow" });
    expect(await button.isDisabled()).toBe(true);
    expect(await button.getAttribute("title")).toContain("follows you");
  });
});

describe("tools", () => {
  test("push along the ray under the pointer for as long as it is held, and leave the camera alone", async () => {
    await join();
    const { x, y, width, height } = (await viewer.page.locator("#picture").boundingBox())!;
    await viewer.page.keyboard.press("2");
    expect(await viewer.page.getByLabel("Push the fluid").isChecked()).toBe(true);
    const cameras = server.all("setCamera").length;
    await viewer.page.mouse.move(x + width / 2, y + height / 2);
    await viewer.page.mouse.down();
    await expect.poll(() => server.all("interact").length).toBeGreaterThan(3);
    await viewer.page.mouse.move(x + width / 2, y + 1, { steps: 4 });
    await viewer.page.waitForTimeout(150);
    await viewer.page.mouse.up();
    await viewer.page.waitForTimeout(150);
    const touches = server.all("interact");
    expect(server.all("setCamera").length).toBe(cameras);
    await viewer.page.waitForTimeout(200);
    expect(server.all("interact").length).toBe(touches.length);

    const camera = await viewer.page.evaluate(() => window.sluice.facts().camera!);
    const first = touches[0]!;
    expect(first.action).toBe(Action.PUSH);
    expect(first.origin).toMatchObject(camera.eye);
    const along = (ray: typeof first) => {
      const view = { x: camera.target.x - camera.eye.x, y: camera.target.y - camera.eye.y, z: camera.target.z - camera.eye.z };
      const dot = view.x * ray.direction!.x + view.y * ray.direction!.y + view.z * ray.direction!.z;
      return (Math.acos(Math.min(1, dot / Math.hypot(view.x, view.y, view.z))) * 180) / Math.PI;
    };
    // The middle of the picture is the line of sight; its upper edge is half of the field of view away from it.
    expect(along(first)).toBeLessThan(0.3);
    expect(along(touches.at(-1)!)).toBeCloseTo(camera.verticalFovDegrees / 2, 0);
  });

  test("a refusal ends the touch and is said once", async () => {
    await join();
    await viewer.page.keyboard.press("4");
    server.answers = false;
    await viewer.page.mouse.move(300, 300);
    await viewer.page.mouse.down();
    await expect.poll(() => server.all("interact").length).toBe(1);
    expect(server.last("interact")?.action).toBe(Action.ADD);
    const { sequence } = server.heard.at(-1)!;
    server.say({ case: "error", value: { message: "the scene is full" } }, sequence);
    await viewer.page.locator(".notice", { hasText: "the scene is full" }).waitFor();
    await viewer.page.waitForTimeout(400);
    await viewer.page.mouse.up();
    expect(server.all("interact").length).toBe(1);
  });

  test("work from the keyboard: arrows point, Enter touches", async () => {
    await join();
    await viewer.page.locator("#picture").focus();
    await viewer.page.keyboard.press("3");
    await viewer.page.keyboard.press("ArrowRight");
    await viewer.page.locator("#crosshair").waitFor();
    await viewer.page.keyboard.down("Enter");
    await expect.poll(() => server.all("interact").length).toBeGreaterThan(2);
    await viewer.page.keyboard.up("Enter");
    expect(server.last("interact")?.action).toBe(Action.PULL);
    // Escape puts the cursor away; with the first tool arrows turn the camera again.
    await viewer.page.keyboard.press("Escape");
    expect(await viewer.page.locator("#crosshair").isVisible()).toBe(false);
  });

  test("a pick shows position, depth, thickness and velocity beside the cursor", async () => {
    await join();
    await viewer.page.keyboard.press("5");
    const { x, y, width, height } = (await viewer.page.locator("#picture").boundingBox())!;
    await viewer.page.mouse.move(x + 0.25 * width, y + 0.75 * height);
    await expect.poll(() => server.last("pick")).toBeDefined();
    const pick = server.last("pick")!;
    expect(pick.x).toBeCloseTo(0.25, 2);
    expect(pick.y).toBeCloseTo(0.75, 2);
    const value = {
      hit: true,
      position: { x: 0.4123, y: 0.1, z: -0.25 },
      depth: 2.345,
      thickness: 0.1234,
      velocity: { x: 3, y: -4, z: 0 },
      density: 1000.4,
    };
    server.say({ case: "picked", value }, server.heard.at(-1)!.sequence);
    const card = viewer.page.locator("#pick");
    await card.waitFor();
    const text = await card.locator("dd").allTextContents();
    expect(text).toEqual(["0.412, 0.100, −0.250 m", "2.35 m", "0.123 m", "5.00 m/s\n3.000, −4.000, 0.000", "1000 kg/m³"]);
    const box = (await card.boundingBox())!;
    expect(box.x).toBeGreaterThan(x + 0.25 * width);
    expect(box.y + box.height).toBeLessThanOrEqual(600);

    await viewer.page.mouse.move(x + 0.5 * width, y + 0.1 * height);
    await expect.poll(() => server.last("pick")?.y).toBeCloseTo(0.1, 2);
    server.say({ case: "picked", value: { hit: false } }, server.heard.at(-1)!.sequence);
    await expect.poll(() => card.textContent()).toContain("No fluid here");
  });
});

describe("the connection", () => {
  test("that falls silent darkens the picture and says so, until something comes again", async () => {
    await join();
    const stage = viewer.page.locator("#stage");
    expect(await stage.getAttribute("class")).not.toContain("stale");
    server.answers = false;
    await viewer.page.locator("#status", { hasText: "not answered" }).waitFor({ timeout: 15_000 });
    expect(await stage.getAttribute("class")).toContain("stale");
    server.answers = true;
    server.say({ case: "stats", value: { simulationTime: 1 } });
    await viewer.page.locator("#status").waitFor({ state: "hidden" });
    expect(await stage.getAttribute("class")).not.toContain("stale");
  });

  test("that is lost comes back by itself, with the own camera and no stale picture", async () => {
    await join();
    others({ viewerId: 9n });
    await viewer.openGroups();
    await viewer.page.getByRole("button", { name: "Follow" }).click();
    const { port } = server;
    await server.end();
    await viewer.page.locator("#status", { hasText: "Trying again" }).waitFor();
    server = await FakeServer.start(port);
    await expect.poll(() => server.last("setView")?.follow, { timeout: 15_000 }).toBe(0n);
    // Until a picture has come the old one does not pass for the present.
    expect(await viewer.page.locator("#stage").getAttribute("class")).toContain("stale");
    await show();
    expect(await viewer.page.locator("#stage").getAttribute("class")).not.toContain("stale");
    expect(viewer.complaints).toEqual([]);
  });
});
