// A server of one's own making: sockets whose other end the test holds.

import { create, fromBinary, type MessageInitShape, toBinary } from "@bufbuild/protobuf";

import { type ClientMessage, ClientMessageSchema, ServerMessageSchema } from "../src/gen/sluice/v1/session_pb";
import type { Socket } from "../src/protocol/connection";

export class FakeSocket implements Socket {
  binaryType = "";
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: ((event: { code: number; reason: string }) => void) | null = null;
  readonly sent: ClientMessage[] = [];
  closed = false;

  send(data: Uint8Array): void {
    this.sent.push(fromBinary(ClientMessageSchema, data));
  }

  close(): void {
    this.closed = true;
  }

  // ---- the server's end

  accept(): void {
    this.onopen?.();
  }

  say(message: MessageInitShape<typeof ServerMessageSchema>["message"], inReplyTo = 0n): void {
    const bytes = toBinary(ServerMessageSchema, create(ServerMessageSchema, { inReplyTo, message: message! }));
    this.onmessage?.({ data: bytes.slice().buffer });
  }

  lose(code = 1006): void {
    this.onclose?.({ code, reason: "" });
  }
}

/** Makes sockets and keeps them, the newest last. */
export class FakeServer {
  readonly sockets: FakeSocket[] = [];
  readonly make = (): FakeSocket => {
    const socket = new FakeSocket();
    this.sockets.push(socket);
    return socket;
  };

  get newest(): FakeSocket {
    return this.sockets[this.sockets.length - 1]!;
  }
}
