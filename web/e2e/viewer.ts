// The page in a real browser, and what can be read off it.

import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { type BrowserContext, type BrowserContextOptions, chromium, type Page } from "playwright-core";

const kArguments = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** The picture, made small. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** Red, green, blue of every pixel, 0..255. */
  readonly values: readonly number[];
}

export class Viewer {
  readonly complaints: string[] = [];

  private constructor(
    private readonly context: BrowserContext,
    private readonly profile: string,
    readonly page: Page,
  ) {
    page.on("pageerror", (error) => this.complaints.push(error.stack ?? error.message));
  }

  /** A browser with an empty profile, and an empty page. */
  static async launch(options: BrowserContextOptions = {}, more: readonly string[] = []): Promise<Viewer> {
    const profile = await mkdtemp(join(tmpdir(), "sluice-e2e-"));
    const context = await chromium.launchPersistentContext(profile, {
      executablePath: process.env["SLUICE_CHROMIUM"] ?? "/usr/bin/chromium",
      headless: true,
      args: [...kArguments, ...more],
      viewport: { width: 900, height: 600 },
      ...options,
    });
    return new Viewer(context, profile, context.pages()[0] ?? (await context.newPage()));
  }

  /** The address is opened in a browser of its own and the first picture awaited. */
  static async open(address: string, options: BrowserContextOptions = {}): Promise<Viewer> {
    const viewer = await Viewer.launch(options);
    await viewer.page.goto(address);
    await viewer.page.waitForFunction(() => window.sluice.facts().framesDrawn > 0);
    return viewer;
  }

  async close(): Promise<void> {
    await this.context.close();
    await rm(this.profile, { recursive: true, force: true });
  }

  /** Pauses the simulation by the keyboard, and waits until the picture rests. */
  async pause(): Promise<void> {
    await this.page.locator("#picture").focus();
    if (!(await this.page.evaluate(() => window.sluice.facts().stats?.paused))) await this.page.keyboard.press("Space");
    await this.page.waitForFunction(() => window.sluice.facts().stats?.paused === true);
    await this.rest();
  }

  /** Waits until no new picture has come for a while. */
  async rest(): Promise<void> {
    let before = -1;
    for (;;) {
      const now = await this.page.evaluate(() => window.sluice.facts().framesDrawn);
      if (now === before) return;
      before = now;
      await this.page.waitForTimeout(600);
    }
  }

  /** Opens every group of the panel, so that each control can be reached. */
  async openGroups(): Promise<void> {
    await this.page.evaluate(() => {
      for (const group of document.querySelectorAll("#panel details")) group.setAttribute("open", "");
    });
  }

  row(path: string) {
    return this.page.locator(`#parameters .row[data-path="${path}"]`);
  }

  async pixels(): Promise<Pixels> {
    return this.page.evaluate(() => {
      const source = document.getElementById("picture") as HTMLCanvasElement;
      const small = new OffscreenCanvas(120, 90);
      const context = small.getContext("2d")!;
      context.drawImage(source, 0, 0, small.width, small.height);
      const { data, width, height } = context.getImageData(0, 0, small.width, small.height);
      return { width, height, values: [...data].filter((_, at) => at % 4 !== 3) };
    });
  }
}

/** A difference that compression does not leave. */
const kVisible = 12;

/** The share of two pictures, 0..1, in which they differ visibly. */
export function difference(a: Pixels, b: Pixels): number {
  const differing = a.values.filter((value, at) => Math.abs(value - (b.values[at] ?? 0)) > kVisible);
  return differing.length / a.values.length;
}

/** Standard deviation of a picture's values: 0 for a blank one. */
export function contrast({ values }: Pixels): number {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  return Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length);
}
