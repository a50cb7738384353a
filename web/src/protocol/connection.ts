// One WebSocket at a time to the server, opened again whenever it is lost. Knows bytes, not messages.

import { Backoff } from "./backoff";

export type ConnectionState =
  /** A first or further attempt is under way. */
  | "connecting"
  | "open"
  /** Waits before the next attempt. */
  | "waiting"
  /** Closed for good by `stop`. */
  | "stopped";

export interface ConnectionHandlers {
  onState(state: ConnectionState, detail: string): void;
  onOpen(): void;
  onMessage(bytes: Uint8Array): void;
  /** The other side has closed or was lost. A `stop` in here keeps the connection from being tried again. */
  onClosed?(code: number, reason: string): void;
}

/** The part of WebSocket that is used, so that tests can stand in for it. */
export interface Socket {
  binaryType: string;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: ((event: { code: number; reason: string }) => void) | null;
  send(data: Uint8Array): void;
  close(code?: number, reason?: string): void;
}

export const kSubprotocol = "sluice.v1";

/** A server that has not answered a new connection for this long is tried afresh. */
const kOpenTimeoutMilliseconds = 10_000;

export class Connection {
  private socket: Socket | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private current: ConnectionState = "stopped";

  constructor(
    private readonly makeSocket: () => Socket,
    private readonly handlers: ConnectionHandlers,
    private readonly backoff = new Backoff(),
  ) {}

  get state(): ConnectionState {
    return this.current;
  }

  start(): void {
    if (this.current === "stopped") this.attempt();
  }

  stop(): void {
    this.abandon("page closed");
    this.become("stopped", "");
  }

  /** Ends a wait early, as when the network has come back. */
  retryNow(): void {
    if (this.current === "waiting") this.attempt();
  }

  /** Gives a connection up that is open in name only, and connects anew. */
  drop(reason: string): void {
    if (this.current === "connecting" || this.current === "open") this.lose(reason);
  }

  /** The connection has proved to work: the next loss is met with short waits again. */
  confirm(): void {
    this.backoff.reset();
  }

  /** False where nothing is open; the message is then gone. */
  send(bytes: Uint8Array): boolean {
    if (this.current !== "open" || !this.socket) return false;
    this.socket.send(bytes);
    return true;
  }

  private attempt(): void {
    clearTimeout(this.timer);
    this.become("connecting", "");
    const socket = this.makeSocket();
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    // A socket that was given up may still report; only the newest is listened to.
    socket.onopen = () => {
      if (socket !== this.socket) return;
      clearTimeout(this.timer);
      this.become("open", "");
      this.handlers.onOpen();
    };
    socket.onmessage = ({ data }) => {
      if (socket === this.socket && data instanceof ArrayBuffer) this.handlers.onMessage(new Uint8Array(data));
    };
    socket.onclose = ({ code, reason }) => {
      if (socket !== this.socket) return;
      this.handlers.onClosed?.(code, reason);
      if (socket === this.socket) this.lose(reason || closeMeaning(code));
    };
    this.timer = setTimeout(() => this.lose("The server does not answer"), kOpenTimeoutMilliseconds);
  }

  private lose(reason: string): void {
    this.abandon(reason);
    this.become("waiting", reason);
    this.timer = setTimeout(() => this.attempt(), this.backoff.next());
  }

  private abandon(reason: string): void {
    clearTimeout(this.timer);
    const { socket } = this;
    this.socket = undefined;
    if (!socket) return;
    socket.onopen = socket.onmessage = socket.onclose = null;
    // 123 bytes is all that a close reason may hold.
    socket.close(1000, reason.slice(0, 100));
  }

  private become(state: ConnectionState, detail: string): void {
    this.current = state;
    this.handlers.onState(state, detail);
  }
}

function closeMeaning(code: number): string {
  switch (code) {
    case 1001:
      return "The server is shutting down";
    case 1002:
    case 1007:
      return "The server could not read what this page sent";
    case 1008:
      return "This page read too slowly for the server";
    case 1009:
      return "A message was too large";
    case 1013:
      return "The server has no room for another viewer";
    default:
      return "The connection was lost";
  }
}

/** Address of the stream beside the page: wss where the page came by https. */
export function streamAddress(page: { protocol: string; host: string }): string {
  return `${page.protocol === "https:" ? "wss" : "ws"}://${page.host}/stream`;
}

export function openSocket(address: string): Socket {
  return new WebSocket(address, kSubprotocol) as unknown as Socket;
}
