// What the page says to the server and hears from it: one message per WebSocket message, as session.proto has it.

import { create, fromBinary, type MessageInitShape, toBinary } from "@bufbuild/protobuf";

import { CameraSchema } from "../gen/sluice/v1/scene_pb";
import {
  ClientMessageSchema,
  type Control_Action,
  type Error as ServerError,
  type Frame,
  type InteractSchema,
  type Picked,
  type PlanChanged,
  type SceneChanged,
  type ServerMessage,
  ServerMessageSchema,
  type SetViewSchema,
  type Stats,
  type UpdateSceneSchema,
  type ViewersChanged,
  type Welcome,
} from "../gen/sluice/v1/session_pb";
import type { Camera } from "../view/camera";
import { Connection, type ConnectionState, type Socket } from "./connection";

type Body = NonNullable<MessageInitShape<typeof ClientMessageSchema>["message"]>;

export type View = MessageInitShape<typeof SetViewSchema>;
export type Touch = MessageInitShape<typeof InteractSchema>;

export interface SessionHandlers {
  onState(state: ConnectionState, detail: string): void;
  /** The session starts, for the first time or again; the view and the camera are to be sent after it. */
  onWelcome(welcome: Welcome): void;
  onFrame(frame: Frame): void;
  onStats(stats: Stats): void;
  onScene(changed: SceneChanged): void;
  onPlan(plan: PlanChanged): void;
  onViewers(viewers: ViewersChanged): void;
  onPicked(picked: Picked, sequence: number): void;
  /** Answers to a message of this page; `sequence` 0 answers none. */
  onError(error: ServerError, sequence: number): void;
  onDone(sequence: number): void;
  onRoundTrip(milliseconds: number): void;
  /** Nothing has come for a while although an answer is due (true), or something has come again (false). */
  onSilence(silent: boolean): void;
  /** The server does not let this page in, most likely for want of a token. It is not tried again until `start`. */
  onRefused(reason: string): void;
}

export interface SessionOptions {
  /** Who connects, for the server's log. */
  readonly client?: string;
  /** The secret to say with each hello; empty where there is none. */
  readonly token?: () => string;
  readonly now?: () => number;
}

const kPingMilliseconds = 2000;
/** After this long without a word a picture may be out of date, and its viewer is told. */
const kQuietMilliseconds = 4000;
/** Longer than a slow link needs for the frames that may stand before the answer. */
const kSilenceMilliseconds = 15_000;
/** WebSocket close code of a server that does not allow what it was sent (RFC 6455, 7.4.1). */
const kPolicyViolation = 1008;
/** Hello is the first message. */
const kHelloSequence = 1;

export class Session {
  private readonly connection: Connection;
  private sequence = 0;
  private pinging: ReturnType<typeof setInterval> | undefined;
  /** When the oldest unanswered ping left; 0 where none is under way. */
  private pingedAt = 0;
  private heardAt = 0;
  private silent = false;
  private welcomed = false;
  private readonly now: () => number;

  constructor(
    makeSocket: () => Socket,
    private readonly handlers: SessionHandlers,
    private readonly options: SessionOptions = {},
  ) {
    this.now = options.now ?? (() => performance.now());
    this.connection = new Connection(makeSocket, {
      onState: (state, detail) => this.stateChanged(state, detail),
      onOpen: () => this.opened(),
      onMessage: (bytes) => this.received(bytes),
      onClosed: (code, reason) => {
        if (!this.welcomed && code === kPolicyViolation) this.refused(reason);
      },
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
    return this.send({ case: "setView", value: view });
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

  interact(touch: Touch): number {
    return this.send({ case: "interact", value: touch });
  }

  /** `x` and `y` from the left and the top of the picture, as shares of its size; `camera` is the picture's. */
  pick(x: number, y: number, camera: Camera): number {
    return this.send({ case: "pick", value: { x, y, camera: create(CameraSchema, camera) } });
  }

  acknowledge(frameId: bigint): number {
    return this.send({ case: "frameAck", value: { frameId } });
  }

  askForKeyframe(): number {
    return this.send({ case: "keyframe", value: {} });
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
    this.heardAt = this.now();
    this.silent = false;
    this.welcomed = false;
    const { client = "sluice-web", token } = this.options;
    this.send({ case: "hello", value: { client, token: token?.() ?? "" } });
    this.pinging = setInterval(() => this.ping(), kPingMilliseconds);
  }

  private ping(): void {
    if (this.pingedAt === 0) {
      this.pingedAt = this.now();
      this.send({ case: "ping", value: { clientTime: this.pingedAt } });
      return;
    }
    if (this.now() - this.pingedAt > kSilenceMilliseconds) {
      this.connection.drop("The server has fallen silent");
    } else if (!this.silent && this.now() - this.heardAt >= kQuietMilliseconds) {
      this.silent = true;
      this.handlers.onSilence(true);
    }
  }

  private heard(): void {
    this.heardAt = this.now();
    if (!this.silent) return;
    this.silent = false;
    this.handlers.onSilence(false);
  }

  private refused(reason: string): void {
    this.connection.stop();
    this.handlers.onRefused(reason);
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
    this.heard();
    const sequence = Number(envelope.inReplyTo);
    const { message } = envelope;
    switch (message.case) {
      case "welcome":
        this.welcomed = true;
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
      case "viewersChanged":
        this.handlers.onViewers(message.value);
        break;
      case "picked":
        this.handlers.onPicked(message.value, sequence);
        break;
      case "error":
        if (!this.welcomed && sequence === kHelloSequence) this.refused(message.value.message);
        else this.handlers.onError(message.value, sequence);
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
