// The real server as a child process.

import { type ChildProcess, spawn } from "node:child_process";
import { once } from "node:events";
import { fileURLToPath } from "node:url";

const kStartMilliseconds = 30_000;
const dist = process.env["SLUICE_WEB_DIST"] ?? fileURLToPath(new URL("../dist", import.meta.url));

export class Server {
  private constructor(
    private readonly process: ChildProcess,
    readonly address: string,
  ) {}

  /** Starts the program that SLUICE_SERVER names, on any free port unless one is given, with further options. */
  static async start(port = 0, ...options: string[]): Promise<Server> {
    const program = process.env["SLUICE_SERVER"];
    if (!program) throw new Error("SLUICE_SERVER must name the sluice-server to test");
    const args = ["serve", "dam_break", "--listen", `127.0.0.1:${port}`, "--web", dist, ...options];
    const child = spawn(program, args, { stdio: ["ignore", "pipe", "pipe"] });
    let output = "";
    child.stderr.on("data", (text: Buffer) => {
      output += text.toString();
    });
    const address = await new Promise<string>((resolve, reject) => {
      const fail = (why: string) => reject(new Error(`${program} ${args.join(" ")}: ${why}\n${output}`));
      const timer = setTimeout(() => fail(`said no address within ${kStartMilliseconds / 1000} s`), kStartMilliseconds);
      child.on("error", (error) => fail(error.message));
      child.on("exit", (code) => fail(`ended with ${code}`));
      child.stdout.on("data", (text: Buffer) => {
        output += text.toString();
        const match = /listening on (http:\/\/\S+)/.exec(output);
        if (!match) return;
        clearTimeout(timer);
        resolve(match[1]!);
      });
    });
    return new Server(child, address);
  }

  get port(): number {
    return Number(new URL(this.address).port);
  }

  /** As a crash would end it, unless asked kindly. */
  async end(signal: "SIGKILL" | "SIGTERM" = "SIGTERM"): Promise<void> {
    if (this.process.exitCode !== null || this.process.signalCode !== null) return;
    const ended = once(this.process, "exit");
    this.process.kill(signal);
    await ended;
  }
}
