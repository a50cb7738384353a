// The whole way: the real server, the built page, Debian's Chromium.

import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { create } from "@bufbuild/protobuf";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";

import { LiquidSchema, SmoothingSchema } from "../src/gen/sluice/v1/scene_pb";
import { Server } from "./server";
import { contrast, difference, Viewer } from "./viewer";

/** Pictures of the same thing differ visibly in less than this share of their area. */
const kSame = 0.002;
/** A change that a person sees. */
const kSeen = 0.02;

let server: Server;
let viewer: Viewer;

beforeAll(async () => {
  server = await Server.start();
  viewer = await Viewer.open(server.address);
});

afterAll(async () => {
  await viewer?.close();
  await server?.end();
});

beforeEach(async () => {
  await viewer.pause();
});

async function drag(from: [number, number], to: [number, number], button: "left" | "right" = "left"): Promise<void> {
  const { mouse } = viewer.page;
  await mouse.move(...from);
  await mouse.down({ button });
  await mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 4 });
  await mouse.move(...to, { steps: 4 });
  await mouse.up({ button });
}

const facts = () => viewer.page.evaluate(() => window.sluice.facts());

describe("the picture", () => {
  test("is there, is not blank, and has the canvas's pixels", async () => {
    expect(contrast(await viewer.pixels())).toBeGreaterThan(10);
    const canvas = await viewer.page.locator("#picture").boundingBox();
    const { frame } = await facts();
    expect(frame).toMatchObject({ width: canvas!.width, height: canvas!.height });
    expect(await viewer.page.locator("#status").isVisible()).toBe(false);
    expect(viewer.complaints).toEqual([]);
  });

  test("turns with a drag, and a double-click brings the first view back", async () => {
    const before = await viewer.pixels();
    const sequence = (await facts()).frame!.reflectsSequence;
    await drag([250, 300], [420, 260]);
    await viewer.page.waitForFunction((than) => window.sluice.facts().frame!.reflectsSequence > than, sequence);
    await viewer.rest();
    const turned = await viewer.pixels();
    expect(difference(before, turned)).toBeGreaterThan(kSeen);

    await viewer.page.mouse.dblclick(300, 300);
    await viewer.rest();
    expect(difference(before, await viewer.pixels())).toBeLessThan(kSame);
  });

  test("moves with a right drag and comes nearer with the wheel", async () => {
    const start = (await facts()).camera!;
    await drag([250, 300], [330, 330], "right");
    await viewer.rest();
    const moved = (await facts()).camera!;
    expect(moved.target).not.toEqual(start.target);
    await viewer.page.mouse.wheel(0, -300);
    await viewer.rest();
    const near = (await facts()).camera!;
    const distance = ({ eye, target }: typeof near) =>
      Math.hypot(eye.x - target.x, eye.y - target.y, eye.z - target.z);
    expect(distance(near)).toBeLessThan(0.8 * distance(moved));
    await viewer.page.keyboard.press("Home");
    await viewer.rest();
    expect((await facts()).camera).toEqual(start);
  });

  test("is exact when all is at rest, and says what stands under the cursor", async () => {
    await viewer.page.waitForFunction(() => window.sluice.facts().frame!.still);
    await viewer.page.keyboard.press("5");
    // Somewhere on a line across the picture there is fluid.
    let across = 0;
    await expect
      .poll(async () => {
        const box = (await viewer.page.locator("#picture").boundingBox())!;
        across = (across + 0.13) % 1;
        await viewer.page.mouse.move(box.x + across * box.width, box.y + 0.55 * box.height);
        await viewer.page.waitForTimeout(150);
        return viewer.page.locator("#pick").textContent();
      }, { timeout: 20_000 })
      .toMatch(/Position[\d−., ]+ m/);
    await viewer.page.keyboard.press("1");
    expect(await viewer.page.locator("#pick").isVisible()).toBe(false);
  });

  test("takes another size when its window does", async () => {
    await viewer.page.setViewportSize({ width: 1000, height: 520 });
    await viewer.page.waitForFunction(() => window.sluice.facts().frame!.height === 520);
    await viewer.page.setViewportSize({ width: 900, height: 600 });
    await viewer.page.waitForFunction(() => window.sluice.facts().frame!.height === 600);
    await viewer.rest();
  });
});

describe("the parameters", () => {
  test("a slider changes the look, here and for another viewer; undo brings it back", async () => {
    const other = await Viewer.open(server.address);
    try {
      await viewer.page.keyboard.press("r");
      await viewer.page.waitForFunction(() => window.sluice.facts().stats?.simulationTime === 0);
      await viewer.rest();
      const path = "look.liquid.refractive_index";
      const standard = create(LiquidSchema).refractiveIndex;
      const index = (value: number) => window.sluice.facts().scene?.look?.liquid?.refractiveIndex === value;
      const before = await viewer.pixels();
      await viewer.row(path).locator("input[type=range]").focus();
      await viewer.page.keyboard.press("End");
      await other.page.waitForFunction(index, 3);
      await viewer.rest();
      expect(difference(before, await viewer.pixels())).toBeGreaterThan(kSeen);
      expect(await other.row(path).locator("input.number").inputValue()).toBe("3");

      await viewer.row(path).locator("button.undo").click();
      await other.page.waitForFunction(index, standard);
      await viewer.rest();
      expect(difference(before, await viewer.pixels())).toBeLessThan(kSame);
      expect(await viewer.row(path).locator("button.undo").isVisible()).toBe(false);
    } finally {
      await other.close();
    }
  });

  test("a choice brings the parameters of its member", async () => {
    const select = viewer.row("look.smoothing.method").locator("select");
    const first = await select.inputValue();
    const others = await select.locator("option:not(:checked)").evaluateAll((options) =>
      options.map((option) => (option as HTMLOptionElement).value),
    );
    const rowsOf = (member: string) => viewer.page.locator(`#parameters .row[data-path^="${member}."]`);
    expect(others.length).toBeGreaterThan(0);
    // Some members have no parameters: what a choice is sure to do is to take those of the one before away.
    let before = first;
    const withParameters: string[] = [];
    for (const member of [...others, first]) {
      const left = before;
      await select.selectOption(member);
      await expect.poll(() => rowsOf(left).count(), { timeout: 30_000 }).toBe(0);
      expect(await select.inputValue()).toBe(member);
      if ((await rowsOf(member).count()) > 0) withParameters.push(member);
      before = member;
    }
    expect(withParameters.length).toBeGreaterThan(2);
    expect(withParameters).toContain(first);
  });

  test("a value out of range is refused at its field, which keeps the server's value", async () => {
    const row = viewer.row("look.smoothing.time");
    const before = (await facts()).scene?.look?.smoothing?.time;
    await row.locator("input.number").fill("-3");
    await viewer.page.keyboard.press("Enter");
    await row.locator(".complaint").waitFor();
    expect(await row.locator(".complaint").textContent()).toContain("50");
    expect(await row.locator("input.number").inputValue()).toBe(String(before));
    expect((await facts()).scene?.look?.smoothing?.time).toBe(before);

    await row.locator("input.number").fill("7");
    await viewer.page.keyboard.press("Enter");
    await viewer.page.waitForFunction(() => window.sluice.facts().scene?.look?.smoothing?.time === 7);
    await row.locator(".complaint").waitFor({ state: "hidden" });
    await row.locator("button.undo").click();
    const standard = create(SmoothingSchema).time;
    await viewer.page.waitForFunction((time) => window.sluice.facts().scene?.look?.smoothing?.time === time, standard);
  });

  test("a value that needs a restart starts the particles again", async () => {
    await viewer.openGroups();
    const particles = (await facts()).stats!.particles;
    const row = viewer.row("simulation.fluids[0].blocks[0].count_x");
    expect(await row.locator(".restart").count()).toBe(1);
    const input = row.locator("input.number");
    const columns = Number(await input.inputValue());
    await input.fill(String(columns / 2));
    await viewer.page.keyboard.press("Enter");
    await viewer.page.waitForFunction(
      (expected) => window.sluice.facts().stats?.particles === expected,
      particles / 2n,
    );
    await input.fill(String(columns));
    await viewer.page.keyboard.press("Enter");
    await viewer.page.waitForFunction((expected) => window.sluice.facts().stats?.particles === expected, particles);
  });
});

describe("the simulation", () => {
  test("steps, plays, pauses and goes back to the start", async () => {
    const time = async () => (await facts()).stats!.simulationTime;
    const before = await time();
    await viewer.page.getByRole("button", { name: "One step" }).click();
    await viewer.page.waitForFunction((than) => window.sluice.facts().stats!.simulationTime > than, before);
    expect((await facts()).stats!.paused).toBe(true);

    await viewer.page.getByRole("button", { name: "Play" }).click();
    const stepped = await time();
    await viewer.page.waitForFunction((than) => window.sluice.facts().stats!.simulationTime > than + 0.05, stepped);
    await viewer.page.getByRole("button", { name: "Pause" }).click();
    await viewer.page.waitForFunction(() => window.sluice.facts().stats!.paused);

    await viewer.page.locator("#picture").focus();
    await viewer.page.keyboard.press("r");
    await viewer.page.waitForFunction(() => window.sluice.facts().stats!.simulationTime === 0);
  });

  test("changes its scene by the menu", async () => {
    await viewer.page.locator("#scene").selectOption("double_dam_break");
    await viewer.page.waitForFunction(() => window.sluice.facts().stats?.particles === 29952n);
    expect((await facts()).sceneName).toBe("double_dam_break");
    await viewer.page.locator("#scene").selectOption("dam_break");
    await viewer.page.waitForFunction(() => window.sluice.facts().sceneName === "dam_break");
    // A scene that is loaded plays unless it says otherwise.
    await viewer.page.getByRole("button", { name: "Pause" }).click();
    await viewer.page.waitForFunction(() => window.sluice.facts().stats!.paused);
    await viewer.rest();
  });

  test("is read out: delay, particles, what is left out", async () => {
    await drag([250, 300], [300, 300]);
    await viewer.page.waitForFunction(() =>
      /^\d[\d.]* ms$/.test(document.querySelector('[data-figure="delay"] .value')?.textContent ?? ""),
    );
    await viewer.openGroups();
    const particles = await viewer.page.locator('[data-figure="particles"] .value').textContent();
    expect(Number(particles?.replace(/\D/g, ""))).toBe(Number((await facts()).stats!.particles));
    expect(await viewer.page.locator(".left-out li .reason").first().textContent()).not.toBe("");
    expect(await viewer.page.locator(".stages .stage.total .figure").first().textContent()).toMatch(/ ms$/);
  });

  test("gives a lossless picture to keep", async () => {
    const download = viewer.page.waitForEvent("download");
    await viewer.page.getByRole("button", { name: "Save a lossless picture" }).click();
    expect((await download).suggestedFilename()).toMatch(/^dam_break_[\d.]+s\.png$/);
  });
});

describe("viewers together", () => {
  test("one follows another's pictures, and goes back to its own", async () => {
    const other = await Viewer.open(server.address, { viewport: { width: 1000, height: 500 } });
    try {
      const { viewerId, frame: ownFrame } = await facts();
      await other.openGroups();
      await other.page.locator(".viewers li", { hasText: `Viewer ${viewerId}` }).getByRole("button").click();
      const { width, height } = ownFrame!;
      await other.page.waitForFunction(
        ([wide, high]) => window.sluice.facts().frame!.width === wide && window.sluice.facts().frame!.height === high,
        [width, height] as const,
      );
      const before = await other.pixels();
      await drag([250, 300], [420, 260]);
      await viewer.rest();
      await other.rest();
      expect(difference(before, await other.pixels())).toBeGreaterThan(kSeen);
      await other.page.getByRole("button", { name: "Back to my camera" }).click();
      await other.page.waitForFunction(() => window.sluice.facts().frame!.height === 500);
      expect(other.complaints).toEqual([]);
    } finally {
      await other.close();
      await viewer.page.keyboard.press("Home");
      await viewer.rest();
    }
  });

  test("a token is asked for and let in with", async () => {
    const folder = await mkdtemp(join(tmpdir(), "sluice-token-"));
    const secret = "open sesame, open sesame";
    await writeFile(join(folder, "token"), `${secret}\n`);
    const closed = await Server.start(0, "--token-file", join(folder, "token"));
    const other = await Viewer.launch();
    try {
      await other.page.goto(closed.address);
      await other.page.getByLabel("Token", { exact: true }).last().fill(secret);
      await other.page.keyboard.press("Enter");
      await other.page.waitForFunction(() => window.sluice.facts().framesDrawn > 0);
      await other.page.goto(`${closed.address}/#token=${encodeURIComponent("not this one, not this one")}`);
      await other.page.reload();
      await other.page.locator("#token .complaint", { hasText: "token" }).waitFor();
    } finally {
      await other.close();
      await closed.end();
      await rm(folder, { recursive: true });
    }
  });
});

describe("the connection", () => {
  test("comes back by itself after the server was killed, with the view that was left", async () => {
    await drag([250, 300], [330, 280]);
    await viewer.rest();
    const before = await facts();
    const { port } = server;

    await server.end("SIGKILL");
    await viewer.page.locator("#status").waitFor();
    expect(await viewer.page.locator("#stage").getAttribute("class")).toContain("stale");

    server = await Server.start(port);
    await viewer.page.waitForFunction((than) => window.sluice.facts().framesDrawn > than, before.framesDrawn);
    await viewer.page.locator("#status").waitFor({ state: "hidden" });
    expect(await viewer.page.locator("#stage").getAttribute("class")).not.toContain("stale");
    expect((await facts()).camera).toEqual(before.camera);
    expect(contrast(await viewer.pixels())).toBeGreaterThan(10);
    expect(viewer.complaints).toEqual([]);
  });
});
