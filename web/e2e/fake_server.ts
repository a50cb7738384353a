// A server of one's own making that speaks the protocol: it says what a test tells it to, and keeps what it hears.

import { readFile } from "node:fs/promises";
import { createServer, type Server as HttpServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

import { create, fromBinary, type MessageInitShape, toBinary } from "@bufbuild/protobuf";
import { type WebSocket, WebSocketServer } from "ws";

import {
  type ClientMessage,
  ClientMessageSchema,
  Codec,
  Error_Code,
  type FrameSchema,
  Role,
  ServerMessageSchema,
  type WelcomeSchema,
} from "../src/gen/sluice/v1/session_pb";
import { damBreak } from "../test/scene_fixture";
import { type Film, kFilmSize } from "./film";

const dist = process.env["SLUICE_WEB_DIST"] ?? fileURLToPath(new URL("../dist", import.meta.url));
const kTypes: Record<string, string> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".woff2": "font/woff2",
};

type Body = NonNullable<MessageInitShape<typeof ServerMessageSchema>["message"]>;
type Said = ClientMessage["message"];
export type Case = NonNullable<Said["case"]>;
export type Value<C extends Case> = Extract<Said, { case: C }>["value"];
export type FrameInit = MessageInitShape<typeof FrameSchema>;

export class FakeServer {
  /** What the newest viewer has said. */
  heard: ClientMessage[] = [];
  /** The secret to be let in; empty for none. */
  token = "";
  welcome: MessageInitShape<typeof WelcomeSchema> = {
    protocolVersion: 1,
    serverVersion: "stand-in",
    viewerId: 7n,
    codecs: [Codec.H264, Codec.VP9, Codec.AV1, Codec.JPEG, Codec.PNG],
    limits: { maxWidth: 3840, maxHeight: 2160, maxMessageBytes: 1 << 20, frameWindow: 2, maxRate: 60 },
    scenes: [{ name: "dam_break", title: "Dam break" }],
    scene: damBreak(),
    sceneName: "dam_break",
    renderer: "none",
    role: Role.DRIVER,
  };
  /** Answers every request, as a server in good health does. */
  answers = true;
  private viewer: WebSocket | undefined;
  private frameId = 0n;
  private readonly sockets: WebSocketServer;

  private constructor(private readonly http: HttpServer) {
    this.sockets = new WebSocketServer({ server: http, path: "/stream" });
    this.sockets.on("connection", (socket) => this.joined(socket));
  }

  static async start(port = 0): Promise<FakeServer> {
    const http = createServer(async ({ url }, response) => {
      const path = normalize(new URL(url ?? "/", "http://any").pathname);
      try {
        const body = path === "/blank" ? "" : await readFile(join(dist, path === "/" ? "index.html" : path));
        response.setHeader("Content-Type", kTypes[path === "/" || path === "/blank" ? ".html" : extname(path)] ?? "text/plain");
        response.end(body);
      } catch {
        response.statusCode = 404;
        response.end();
      }
    });
    await new Promise<void>((resolve) => http.listen(port, "127.0.0.1", resolve));
    return new FakeServer(http);
  }

  get port(): number {
    return (this.http.address() as AddressInfo).port;
  }

  get address(): string {
    return `http://127.0.0.1:${this.port}`;
  }

  async end(): Promise<void> {
    for (const socket of this.sockets.clients) socket.terminate();
    this.sockets.close();
    await new Promise((resolve) => this.http.close(resolve));
  }

  /** Every message of one kind, oldest first. */
  all<C extends Case>(kind: C): Value<C>[] {
    return this.heard.flatMap(({ message }) => (message.case === kind ? [message.value as Value<C>] : []));
  }

  last<C extends Case>(kind: C): Value<C> | undefined {
    return this.all(kind).at(-1);
  }

  say(message: Body, inReplyTo = 0n): void {
    this.viewer?.send(toBinary(ServerMessageSchema, create(ServerMessageSchema, { inReplyTo, message })));
  }

  /** Sends a frame and returns its id. */
  frame(frame: FrameInit): bigint {
    this.frameId += 1n;
    this.say({ case: "frame", value: { ...kFilmSize, frameId: this.frameId, ...frame } });
    return this.frameId;
  }

  filmFrame(film: Film, at: number, more: FrameInit = {}): bigint {
    const { keyframe, payload } = film.frames[at]!;
    const decoder = keyframe ? film.decoder : "";
    return this.frame({ codec: film.codec, keyframe, payload, decoder, quality: 80, ...more });
  }

  private joined(socket: WebSocket): void {
    this.viewer = socket;
    this.heard = [];
    socket.on("message", (data: Buffer) => {
      const said = fromBinary(ClientMessageSchema, new Uint8Array(data));
      this.heard.push(said);
      if (this.answers) this.answer(said, socket);
    });
  }

  private answer({ sequence, message }: ClientMessage, socket: WebSocket): void {
    switch (message.case) {
      case "hello":
        if (message.value.token === this.token) this.say({ case: "welcome", value: this.welcome }, sequence);
        else this.refuse(sequence, socket);
        break;
      case "ping":
        this.say({ case: "pong", value: { clientTime: message.value.clientTime } }, sequence);
        break;
      case "interact":
      case "control":
        this.say({ case: "done", value: {} }, sequence);
        break;
      default:
        break;
    }
  }

  private refuse(sequence: bigint, socket: WebSocket): void {
    const value = { code: Error_Code.REFUSED, fieldPath: "hello.token", message: "the token is not the server's" };
    this.say({ case: "error", value }, sequence);
    socket.close(1008, "the token is not the server's");
  }
}
