import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { Codec, type Frame } from "../src/gen/sluice/v1/session_pb";
import { Session } from "../src/protocol/session";
import { FakeServer } from "./fake_socket";

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

const camera = {
  eye: { x: 1, y: 2, z: 3 },
  target: { x: 0, y: 0, z: 0 },
  up: { x: 0, y: 1, z: 0 },
  verticalFovDegrees: 45,
};

function join() {
  const server = new FakeServer();
  const handlers = {
    onState: vi.fn(),
    onWelcome: vi.fn(),
    onFrame: vi.fn((_frame: Frame) => undefined),
    onStats: vi.fn(),
    onScene: vi.fn(),
    onPlan: vi.fn(),
    onError: vi.fn(),
    onDone: vi.fn(),
    onRoundTrip: vi.fn(),
    onViewers: vi.fn(),
    onPicked: vi.fn(),
    onSilence: vi.fn(),
    onRefused: vi.fn(),
  };
  const session = new Session(server.make, handlers, { client: "test", token: () => "secret", now: () => Date.now() });
  session.start();
  return { server, handlers, session };
}

test("says hello first, and numbers its messages from 1", () => {
  const { server, session } = join();
  expect(session.setCamera(camera)).toBe(0);
  server.newest.accept();
  expect(session.setView({ width: 640, height: 480, codecs: [Codec.JPEG], quality: 0 })).toBe(2);
  expect(session.setCamera(camera)).toBe(3);
  const { sent } = server.newest;
  expect(sent.map((message) => [Number(message.sequence), message.message.case])).toEqual([
    [1, "hello"],
    [2, "setView"],
    [3, "setCamera"],
  ]);
  const view = sent[1]!.message;
  expect(view.case === "setView" && view.value.width).toBe(640);
  const moved = sent[2]!.message;
  expect(moved.case === "setCamera" && moved.value.camera?.eye?.z).toBe(3);
});

test("numbers start again with a new connection", () => {
  const { server, session } = join();
  server.newest.accept();
  session.setCamera(camera);
  server.newest.lose();
  vi.advanceTimersByTime(1000);
  server.newest.accept();
  expect(session.setCamera(camera)).toBe(2);
  expect(server.newest.sent[0]!.message.case).toBe("hello");
});

test("hands on what the server says, with what it answers", () => {
  const { server, handlers } = join();
  server.newest.accept();
  server.newest.say({ case: "welcome", value: { protocolVersion: 1 } }, 1n);
  server.newest.say({ case: "frame", value: { frameId: 7n, payload: new Uint8Array([1, 2]) } });
  server.newest.say({ case: "error", value: { fieldPath: "look.smoothing.time", message: "no" } }, 5n);
  server.newest.say({ case: "done", value: {} }, 6n);
  expect(handlers.onWelcome).toHaveBeenCalledOnce();
  expect(handlers.onFrame.mock.calls[0]![0].frameId).toBe(7n);
  expect(handlers.onError).toHaveBeenCalledWith(expect.objectContaining({ message: "no" }), 5);
  expect(handlers.onDone).toHaveBeenCalledWith(6);
});

test("measures the round trip by its own clock", () => {
  const { server, handlers } = join();
  server.newest.accept();
  vi.advanceTimersByTime(2000);
  const ping = server.newest.sent.at(-1)!.message;
  if (ping.case !== "ping") throw new Error("no ping was sent");
  vi.advanceTimersByTime(30);
  server.newest.say({ case: "pong", value: { clientTime: ping.value.clientTime } });
  expect(handlers.onRoundTrip).toHaveBeenCalledWith(30);
});

test("a server that answers no ping is left, one that is merely slow is not", () => {
  const { server, handlers } = join();
  server.newest.accept();
  vi.advanceTimersByTime(2000);
  const ping = server.newest.sent.at(-1)!.message;
  vi.advanceTimersByTime(10_000);
  expect(server.newest.closed).toBe(false);
  server.newest.say({ case: "pong", value: { clientTime: ping.case === "ping" ? ping.value.clientTime : 0 } });
  vi.advanceTimersByTime(2000 + 14_000);
  expect(server.newest.closed).toBe(false);
  vi.advanceTimersByTime(4000);
  expect(server.sockets[0]!.closed).toBe(true);
  expect(handlers.onState).toHaveBeenCalledWith("waiting", "The server has fallen silent");
});

test("no ping is left running after a stop", () => {
  const { server, session } = join();
  server.newest.accept();
  session.stop();
  vi.advanceTimersByTime(60_000);
  expect(server.newest.sent.length).toBe(1);
  expect(vi.getTimerCount()).toBe(0);
});

test("shows the token in its hello", () => {
  const { server } = join();
  server.newest.accept();
  const hello = server.newest.sent[0]!.message;
  expect(hello.case === "hello" && hello.value.token).toBe("secret");
});

test("a server that does not let this page in is not tried again until it is started", () => {
  const { server, handlers, session } = join();
  server.newest.accept();
  server.newest.lose(1008);
  expect(handlers.onRefused).toHaveBeenCalledOnce();
  vi.advanceTimersByTime(60_000);
  expect(server.sockets.length).toBe(1);
  session.start();
  expect(server.sockets.length).toBe(2);

  server.newest.accept();
  server.newest.say({ case: "error", value: { message: "no such token" } }, 1n);
  expect(handlers.onRefused).toHaveBeenLastCalledWith("no such token");
  expect(handlers.onError).not.toHaveBeenCalled();
});

test("a viewer that was let in and is closed with 1008 comes back", () => {
  const { server, handlers } = join();
  server.newest.accept();
  server.newest.say({ case: "welcome", value: { protocolVersion: 1 } }, 1n);
  server.newest.lose(1008);
  vi.advanceTimersByTime(1000);
  expect(server.sockets.length).toBe(2);
  expect(handlers.onRefused).not.toHaveBeenCalled();
});

test("silence is told while an answer is due, and its end too; traffic of any kind is no silence", () => {
  const { server, handlers } = join();
  server.newest.accept();
  vi.advanceTimersByTime(3000);
  server.newest.say({ case: "stats", value: {} });
  vi.advanceTimersByTime(3000);
  expect(handlers.onSilence).not.toHaveBeenCalled();
  vi.advanceTimersByTime(2000);
  expect(handlers.onSilence.mock.calls).toEqual([[true]]);
  server.newest.say({ case: "stats", value: {} });
  expect(handlers.onSilence.mock.calls).toEqual([[true], [false]]);
});
