// What the page says to the server and hears from it: one message per WebSocket message, as session.proto has it.

import { create, fromBinary, type MessageInitShape, toBinary } from "@bufbuild/protobuf";

import { CameraSchema } from "../gen/sluice/v1/scene_pb";
import {
  ClientMessageSchema,
  type Codec,
  type Control_Action,
  type Error as ServerError,
  type Frame,
  type PlanChanged,
  type SceneChanged,
  type ServerMessage,
  ServerMessageSchema,
  type Stats,
  type UpdateSceneSchema,
  type Welcome,
} from "../gen/sluice/v1/session_pb";
import type { Camera } from "../view/camera";
import { Connection, type ConnectionState, type Socket } from "./connection";

type Body = NonNullable<MessageInitShape<typeof ClientMessageSchema>["message"]>;

export interface View {
  readonly width: number;
  readonly height: number;
  readonly codecs: readonly Codec[];
  /** 1..100; 0 leaves it to the server. */
  readonly quality: number;
}

export interface SessionHandlers {
  onState(state: ConnectionState, detail: string): void;
  /** The session starts, for the first time or again; the view and the camera are to be sent after it. */
  onWelcome(welcome: Welcome): void;
  onFrame(frame: Frame): void;
  onStats(stats: Stats): void;
  onScene(changed: SceneChanged): void;
  onPlan(plan: PlanChanged): void;
  /** Answers to a message of this page; `sequence` 0 answers none. */
  onError(error: ServerError, sequence: number): void;
  onDone(sequence: number): void;
  onRoundTrip(milliseconds: number): void;
}

const kPingMilliseconds = 2000;
/** Longer than a slow link needs for the frames that may stand before the answer. */
const kSilenceMilliseconds = 15_000;

export class Session {
  private readonly connection: Connection;
  private sequence = 0;
  private pinging: ReturnType<typeof setInterval> | undefined;
  /** When the oldest unanswered ping left; 0 where none is under way. */
  private pingedAt = 0;

  constructor(
    makeSocket: () => Socket,
    private readonly handlers: SessionHandlers,
    private readonly client = "sluice-web",
    private readonly now: () => number = () => performance.now(),
  ) {
    this.connection = new Connection(makeSocket, {
      onState: (state, detail) => this.stateChanged(state, detail),
      onOpen: () => this.opened(),
      onMessage: (bytes) => this.received(bytes),
    });
  }

  start(): void {
    this.connection.start();
  }

  stop(): void {
    this.connection.stop();
  }

  retryNow(): void {
    this.connection.retryNow();
  }

  // Each of these returns the sequence number that replies and frames will name, or 0 where nothing is connected.

  setView(view: View): number {
    return this.send({ case: "setView", value: { ...view, codecs: [...view.codecs] } });
  }

  setCamera(camera: Camera): number {
    return this.send({ case: "setCamera", value: { camera: create(CameraSchema, camera) } });
  }

  updateScene(update: MessageInitShape<typeof UpdateSceneSchema>): number {
    return this.send({ case: "updateScene", value: update });
  }

  control(action: Control_Action): number {
    return this.send({ case: "control", value: { action } });
  }

  loadScene(name: string): number {
    return this.send({ case: "loadScene", value: { scene: { case: "name", value: name } } });
  }

  loadSceneText(text: string): number {
    return this.send({ case: "loadScene", value: { scene: { case: "text", value: text } } });
  }

  snapshot(width: number, height: number): number {
    return this.send({ case: "snapshot", value: { width, height } });
  }

  acknowledge(frameId: bigint): number {
    return this.send({ case: "frameAck", value: { frameId } });
  }

  private send(message: Body): number {
    if (this.connection.state !== "open") return 0;
    this.sequence += 1;
    const envelope = create(ClientMessageSchema, { sequence: BigInt(this.sequence), message });
    return this.connection.send(toBinary(ClientMessageSchema, envelope)) ? this.sequence : 0;
  }

  private opened(): void {
    this.sequence = 0;
    this.pingedAt = 0;
    this.send({ case: "hello", value: { client: this.client } });
    this.pinging = setInterval(() => this.ping(), kPingMilliseconds);
  }

  private ping(): void {
    if (this.pingedAt === 0) {
      this.pingedAt = this.now();
      this.send({ case: "ping", value: { clientTime: this.pingedAt } });
    } else if (this.now() - this.pingedAt > kSilenceMilliseconds) {
      this.connection.drop("The server has fallen silent");
    }
  }

  private stateChanged(state: ConnectionState, detail: string): void {
    if (state !== "open") clearInterval(this.pinging);
    this.handlers.onState(state, detail);
  }

  private received(bytes: Uint8Array): void {
    const envelope = parsed(bytes);
    if (!envelope) {
      this.connection.drop("The server said what this page cannot read");
      return;
    }
    const sequence = Number(envelope.inReplyTo);
    const { message } = envelope;
    switch (message.case) {
      case "welcome":
        this.connection.confirm();
        this.handlers.onWelcome(message.value);
        break;
      case "frame":
        this.handlers.onFrame(message.value);
        break;
      case "stats":
        this.handlers.onStats(message.value);
        break;
      case "sceneChanged":
        this.handlers.onScene(message.value);
        break;
      case "planChanged":
        this.handlers.onPlan(message.value);
        break;
      case "error":
        this.handlers.onError(message.value, sequence);
        break;
      case "done":
        this.handlers.onDone(sequence);
        break;
      case "pong":
        this.pingedAt = 0;
        this.handlers.onRoundTrip(this.now() - message.value.clientTime);
        break;
      case undefined:
        // A newer server may say what this page does not know yet.
        break;
    }
  }
}

function parsed(bytes: Uint8Array): ServerMessage | undefined {
  try {
    return fromBinary(ServerMessageSchema, bytes);
  } catch {
    return undefined;
  }
}
